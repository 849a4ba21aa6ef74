/** The pointer and the keyboard on the view: turning, painting, the lasso, arrows. */

import { Vector2 } from "three";
import { brushed, lassoed } from "./choosing.js";
import type { Dragging } from "./dragging.js";
import type { Model } from "./model.js";
import { chosen, element, input, onChoice } from "./page.js";
import type { Viewer } from "./viewer.js";
import { isBusy } from "./work.js";

const TURN = 0.08;
const KEYS: Record<string, [right: number, up: number, nearer: number]> = {
    ...{ ArrowLeft: [-TURN, 0, 1], ArrowRight: [TURN, 0, 1], ArrowUp: [0, TURN, 1], ArrowDown: [0, -TURN, 1] },
    ...{ "+": [0, 0, 1.12], "=": [0, 0, 1.12], "-": [0, 0, 1 / 1.12] },
};

export class Pointer {
    readonly #model: Model;
    readonly #viewer: Viewer;
    readonly #dragging: Dragging;
    /** The region while it is painted. */
    #painted: Uint8Array | null = null;
    #lasso: Vector2[] | null = null;

    constructor(model: Model, viewer: Viewer, dragging: Dragging) {
        [this.#model, this.#viewer, this.#dragging] = [model, viewer, dragging];
        const { canvas } = viewer;
        // Before the view's own listeners, which turn it.
        canvas.addEventListener("pointerdown", (event) => this.#down(event), { capture: true });
        canvas.addEventListener("pointermove", (event) => this.#moved(event));
        for (const end of ["pointerup", "pointercancel"] as const) canvas.addEventListener(end, () => this.#up());
        canvas.addEventListener("keydown", (event) => this.#key(event));
        onChoice("tool", () => this.#chose());
        this.#chose();
    }

    #chose(): void {
        const tool = chosen("tool");
        element("scene").classList.toggle("painting", tool === "paint" || tool === "erase");
        this.#viewer.controls.enabled = tool === "look";
        this.mark();
    }

    /** The region is seen while it is chosen; afterwards the surface is what matters. */
    mark(): void {
        this.#viewer.mark(this.#model.live === null || chosen("tool") !== "look" ? 0.55 : 0.12);
    }

    #down(event: PointerEvent): void {
        if (!event.isPrimary || event.button !== 0) return;
        const place = new Vector2(event.clientX, event.clientY);
        const tool = chosen("tool");
        // Arrows come first, with every tool.
        if (this.#dragging.take(place, event.pointerType === "touch")) {
            this.#viewer.controls.enabled = false;
        } else if (tool === "look" || (isBusy() && !this.#dragging.isPending)) {
            return;
        } else if (tool === "lasso") {
            this.#lasso = [place];
        } else {
            this.#painted = this.#model.region.slice();
            this.#paint(place);
        }
        this.#viewer.canvas.setPointerCapture(event.pointerId);
    }

    #moved(event: PointerEvent): void {
        if (!event.isPrimary) return;
        const place = new Vector2(event.clientX, event.clientY);
        if (this.#painted !== null) this.#paint(place);
        else if (this.#lasso !== null) this.#draw(place);
        else if (!this.#dragging.drag(place)) this.#viewer.canvas.classList.toggle("grab", this.#dragging.isAt(place));
    }

    #up(): void {
        if (this.#painted !== null) void this.#choose(this.#painted);
        this.#painted = null;
        if (this.#lasso !== null) this.#close(this.#lasso);
        this.#lasso = null;
        this.#dragging.drop();
        this.#viewer.controls.enabled = chosen("tool") === "look";
    }

    /** Takes a region when what was dragged before is done. */
    async #choose(region: Uint8Array): Promise<void> {
        await this.#dragging.rest();
        this.#model.choose(region);
    }

    /** Adds what is under the brush, or takes it away. */
    #paint(place: Vector2): void {
        const { surface } = this.#model;
        const hit = surface.hit(this.#viewer.ray(place.x, place.y).ray);
        if (hit === null) return;
        const value = chosen("tool") === "paint" ? 1 : 0;
        for (const triangle of brushed(surface, hit, (Number(input("brush").value) / 100) * surface.diagonal)) this.#painted![triangle] = value;
        this.#show(this.#painted!);
    }

    /** Colours a region that is not chosen yet. */
    #show(mask: Uint8Array): void {
        this.#model.colour(mask);
        this.#viewer.draw();
    }

    #draw(place: Vector2): void {
        this.#lasso!.push(place);
        this.#polygon(this.#lasso!);
    }

    #polygon(places: readonly Vector2[]): void {
        const { left, top } = this.#viewer.canvas.getBoundingClientRect();
        document.querySelector("#lasso polygon")!.setAttribute("points", places.map(({ x, y }) => `${x - left},${y - top}`).join(" "));
    }

    #close(places: readonly Vector2[]): void {
        this.#polygon([]);
        const region = this.#model.region.slice();
        for (const triangle of lassoed(this.#model.surface, this.#viewer, places)) region[triangle] = 1;
        void this.#choose(region);
    }

    #key(event: KeyboardEvent): void {
        const way = KEYS[event.key];
        if (way !== undefined) {
            this.#viewer.turn(...way);
            event.preventDefault();
        } else if ((event.key === " " || event.key === "Enter") && ["paint", "erase"].includes(chosen("tool")) && !isBusy()) {
            const { left, top, width, height } = this.#viewer.canvas.getBoundingClientRect();
            this.#painted = this.#model.region.slice();
            this.#paint(new Vector2(left + width / 2, top + height / 2));
            this.#up();
            event.preventDefault();
        }
    }
}
