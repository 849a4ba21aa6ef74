/** The third box: arrows and sliders that turn and move the boundary while the surface follows. */

import { Vector2, Vector3 } from "three";
import type { Edit } from "../../src/index.js";
import { dragged } from "./choosing.js";
import { gripped, Handles, SIZE } from "./handles.js";
import { DEGREE, isAlike, type Live, type Model, withEdit } from "./model.js";
import { chosen, element, input, label, onChoice, options, say, select, told } from "./page.js";
import type { LoopVertex } from "./surface.js";
import type { Viewer } from "./viewer.js";
import { isBusy, work } from "./work.js";

/** Milliseconds. */
const REST = 150;
const AXES = ["x", "y", "z"] as const;

interface Drag {
    grip: LoopVertex;
    foot: Vector3;
    from: Vector2;
    /** What the arrow had before. */
    angle: number;
    translation: number[];
}

export class Dragging {
    readonly #model: Model;
    readonly #viewer: Viewer;
    readonly handles: Handles;
    /** Whether curvature is to be seen while dragging. */
    readonly #look: () => { meanCurvature: boolean };
    /** An arrow has been taken by hand. */
    taken: () => void = () => undefined;
    #shown: Live | null = null;
    #drag: Drag | null = null;
    /** While the last digits are found the boundary can be taken again. */
    #isSettling = false;
    #isSettledAgain = false;
    #soon: ReturnType<typeof setTimeout> | undefined;
    #settling: Promise<void> = Promise.resolve();

    constructor(model: Model, viewer: Viewer, look: () => { meanCurvature: boolean }) {
        [this.#model, this.#viewer, this.#look] = [model, viewer, look];
        this.handles = new Handles(viewer);
        input("bulge").addEventListener("input", () => this.#set({ kind: "bulge", amount: Number(input("bulge").value) }));
        input("angle").addEventListener("input", () => this.#set(this.#turned(this.#grip(), Number(input("angle").value) * DEGREE)));
        for (const axis of AXES) input(`move-${axis}`).addEventListener("input", () => this.#set(this.#moved(this.#slid())));
        for (const id of ["falloff", "handle"]) input(id).addEventListener("input", () => this.refresh());
        select("loop").addEventListener("change", () => this.refresh());
        onChoice("edit", () => this.refresh());
        element("reset").addEventListener("click", () => this.#apply([], true));
        for (const id of ["bulge", "angle", ...AXES.map((axis) => `move-${axis}`)]) input(id).addEventListener("change", () => this.#settleSoon());
        element("range").addEventListener("click", () => void this.#askRange());
    }

    get #live(): Live {
        return this.#model.live!;
    }

    get #loop(): number {
        return Number(select("loop").value);
    }

    #grip(): LoopVertex {
        return gripped(this.#live.loops[this.#loop]!)[Number(input("handle").value) - 1]!;
    }

    /** In the unit of lengths; 0: all of the loop. */
    get #falloff(): number {
        const part = Number(input("falloff").value) / 100;
        return chosen("edit") === "move" ? part * this.#model.surface.diagonal : part * this.#live.lengths[this.#loop]!;
    }

    #turned(grip: LoopVertex, angle: number): Edit {
        // Twisted, all of a loop would turn alike but for the jump at the far end: half of it each way.
        const kind = chosen("edit") === "twist" ? "twist" : "tilt";
        const falloff = this.#falloff || (kind === "twist" ? this.#live.lengths[this.#loop]! / 2 : 0);
        return { kind, vertex: grip.vertex, angle, falloff };
    }

    #moved(translation: number[]): Edit {
        const vertices = this.#live.loops[this.#loop]!.map(({ vertex }) => vertex);
        return { kind: "move", vertices, translation, falloff: this.#falloff };
    }

    #slid(): number[] {
        return AXES.map((axis) => (Number(input(`move-${axis}`).value) / 100) * this.#model.surface.diagonal);
    }

    /** What is in force at the place that the sliders mean. */
    #inForce(edit: Edit): Edit | undefined {
        return this.#live.edits.find((each) => isAlike(each, edit));
    }

    #set(edit: Edit): void {
        this.#apply(withEdit(this.#live.edits, edit), false);
    }

    get #isBlocked(): boolean {
        return isBusy() && !this.#isSettling;
    }

    #apply(edits: Edit[], isLast: boolean): void {
        if (this.#isBlocked) return;
        if (this.#soon !== undefined) this.#settleSoon();
        this.#model.edit(edits, this.#look()).then(
            () => isLast && this.#settleSoon(),
            (why: unknown) => say(told(why), true),
        );
        this.refresh();
    }

    /** Whether the surface is not yet what it will be when nothing else is done. */
    get isPending(): boolean {
        return this.#soon !== undefined || this.#isSettling;
    }

    /** When the hand rests: a key that is held down asks for frames. */
    #settleSoon(): void {
        clearTimeout(this.#soon);
        this.#soon = setTimeout(() => {
            this.#soon = undefined;
            void this.settle();
        }, REST);
    }

    /** What was dragged, to the last digit, before something else is done with it. */
    async rest(): Promise<void> {
        if (this.#soon === undefined) return this.#settling;
        clearTimeout(this.#soon);
        this.#soon = undefined;
        return this.settle();
    }

    /** After the hand has let go: the surface to the last digit; once more, if it was let go again meanwhile. */
    async settle(): Promise<void> {
        if (this.#isSettling) this.#isSettledAgain = true;
        if (this.#model.live === null || isBusy()) return this.#settling;
        return (this.#settling = this.#settle());
    }

    async #settle(): Promise<void> {
        this.#isSettling = true;
        do {
            this.#isSettledAgain = false;
            await work(this.#live.edits.length === 0 ? "Fair surface" : "Edited surface", (watched) => this.#model.finish(watched));
        } while (this.#isSettledAgain && this.#model.live !== null);
        this.#isSettling = false;
    }

    async #askRange(): Promise<void> {
        if (this.#model.live === null) return;
        await work("How far it can bulge", async (watched) => {
            const { low, high } = await this.#model.bulgeRange(watched);
            Object.assign(input("bulge"), { min: String(low), max: String(high), step: String((high - low) / 200) });
            return `from ${(low / DEGREE).toFixed(0)}° to ${(high / DEGREE).toFixed(0)}°`;
        });
    }

    /** Shows what is in force: arrows and sliders. */
    refresh(): void {
        const { live } = this.#model;
        element<HTMLFieldSetElement>("live").disabled = live === null || live.loops.length === 0;
        element("live-hint").hidden = live !== null;
        if (live === null || live.loops.length === 0) {
            this.#shown = null;
            return this.handles.clear();
        }
        if (this.#shown !== live) this.#introduce(live);
        const isMove = chosen("edit") === "move";
        element("angles").hidden = isMove;
        element("moves").hidden = !isMove;
        input("handle").max = String(gripped(live.loops[this.#loop]!).length);
        this.#fillIn(live);
        this.handles.draw(live.loops, this.#model.surface, this.#loop, isMove ? -1 : Number(input("handle").value) - 1, (loop, grip) => this.#angleAt(loop, grip));
    }

    /** A solver that was not shown before. */
    #introduce(live: Live): void {
        this.#shown = live;
        options("loop", live.loops.map((loop, k) => [String(k), `${k + 1} of ${live.loops.length}: ${loop.length} vertices`]));
        Object.assign(input("bulge"), { min: "-0.5", max: "0.5", step: "0.005" });
    }

    #fillIn(live: Live): void {
        const bulge = live.edits.find((edit) => edit.kind === "bulge");
        const amount = bulge?.kind === "bulge" ? bulge.amount : 0;
        input("bulge").value = String(amount);
        label("bulge", `${(amount / DEGREE).toFixed(0)}°`);
        const part = Number(input("falloff").value);
        label("falloff", part === 0 ? (chosen("edit") === "move" ? "none" : "all") : `${part} %`);
        label("handle", input("handle").value);
        label("brush", `${input("brush").value} %`);
        const turned = this.#inForce(this.#turned(this.#grip(), 0));
        const degrees = turned !== undefined && "angle" in turned ? turned.angle / DEGREE : 0;
        input("angle").value = String(degrees);
        label("angle", `${degrees.toFixed(0)}°`);
        const moved = this.#inForce(this.#moved([0, 0, 0]));
        const way = moved?.kind === "move" ? (moved.translation ?? [0, 0, 0]) : [0, 0, 0];
        AXES.forEach((axis, k) => {
            const percent = (100 * way[k]!) / this.#model.surface.diagonal;
            input(`move-${axis}`).value = String(percent);
            label(`move-${axis}`, `${percent.toFixed(0)} %`);
        });
    }

    /** How far an arrow is turned: by the whole loop, and by itself. What the falloff does between them is seen at the surface. */
    #angleAt(loop: number, grip: LoopVertex): number {
        let angle = 0;
        for (const edit of this.#live.edits) {
            if (edit.kind === "bulge") angle += edit.amount;
            if (edit.kind !== "tilt") continue;
            const isWhole = !edit.falloff && this.#live.loops[loop]!.some(({ vertex }) => vertex === edit.vertex);
            if (isWhole || edit.vertex === grip.vertex) angle += edit.angle;
        }
        return angle;
    }

    /** Whether there is an arrow under the pointer. */
    isAt(place: Vector2): boolean {
        return this.#model.live !== null && this.handles.at(place, 12) !== null;
    }

    /** Whether the pointer has taken an arrow; it does so before it turns the view, or paints. */
    take(place: Vector2, isTouch: boolean): boolean {
        if (this.#model.live === null || this.#isBlocked) return false;
        const found = this.handles.at(place, isTouch ? 26 : 12);
        if (found === null) return false;
        select("loop").value = String(found.loop);
        input("handle").value = String(found.number + 1);
        const turned = this.#inForce(this.#turned(found.grip, 0));
        const moved = this.#inForce(this.#moved([0, 0, 0]));
        this.#drag = {
            ...{ grip: found.grip, foot: found.foot, from: place },
            angle: turned !== undefined && "angle" in turned ? turned.angle : 0,
            translation: moved?.kind === "move" ? [...(moved.translation ?? [0, 0, 0])] : [0, 0, 0],
        };
        this.taken();
        this.refresh();
        return true;
    }

    /** Shows the one arrow that is seen best, and the others quietly; false where there is none. */
    invite(): boolean {
        const best = this.handles.best(this.#model.surface);
        if (best === null) return false;
        select("loop").value = String(best.loop);
        input("handle").value = String(best.number + 1);
        this.handles.isInviting = true;
        this.refresh();
        return true;
    }

    /** All arrows are alike again. */
    invited(): void {
        this.handles.isInviting = false;
        this.refresh();
    }

    /** Turns the arrow that the sliders mean. */
    turn(angle: number): void {
        if (this.#model.live !== null) this.#set(this.#turned(this.#grip(), angle));
    }

    /** The pointer has moved. */
    drag(place: Vector2): boolean {
        const drag = this.#drag;
        if (drag === null) return false;
        if (chosen("edit") === "move") {
            const way = dragged(this.#viewer, drag.foot, drag.from, place).toArray();
            this.#set(this.#moved(drag.translation.map((x, k) => x + way[k]!)));
        } else {
            const size = SIZE * this.#model.surface.diagonal;
            this.#set(this.#turned(drag.grip, this.handles.angle(drag.grip, drag.foot, size, drag.angle, drag.from, place)));
        }
        return true;
    }

    /** The pointer has let go. */
    drop(): boolean {
        if (this.#drag === null) return false;
        this.#drag = null;
        this.#settleSoon();
        return true;
    }
}
