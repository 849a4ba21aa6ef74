/** The place on the surface under the pointer: a cross, its coordinates in the file's own unit, and copies of it that the command line takes. */

import { Vector2, Vector3 } from "three";
import type { Dragging } from "./dragging.js";
import type { Model } from "./model.js";
import { copied, element, input, say } from "./page.js";
import type { Hit, Surface } from "./surface.js";
import type { Viewer } from "./viewer.js";

/** A pointer that has moved by no more pixels has clicked: at half hands that tremble cannot, at double short drags are clicks. */
const STILL = 4;
/** What is told of coordinates, in diagonals of the surface: a fifth of a pixel. */
const FINE = 1e-4;

/** What the command line calls a region at a place; by key. */
const FLAGS = { b: "ball", u: "bump", g: "geodesic" } as const;
type Flag = (typeof FLAGS)[keyof typeof FLAGS];

export class Spot {
    readonly #model: Model;
    readonly #viewer: Viewer;
    readonly #dragging: Dragging;
    #point: Vector3 | null = null;
    #triangle = 0;
    /** A click has fixed it, so that the pointer can go to the buttons. */
    #isFixed = false;
    #down: Vector2 | null = null;

    constructor(model: Model, viewer: Viewer, dragging: Dragging) {
        [this.#model, this.#viewer, this.#dragging] = [model, viewer, dragging];
        const { canvas } = viewer;
        const at = ({ clientX, clientY }: PointerEvent) => new Vector2(clientX, clientY);
        canvas.addEventListener("pointermove", (event) => this.#moved(at(event), event.buttons > 0 || event.pointerType === "touch"));
        canvas.addEventListener("pointerleave", () => this.#isFixed || this.#show(null));
        canvas.addEventListener("pointerdown", (event) => (this.#down = this.#dragging.isAt(at(event)) ? null : at(event)), { capture: true });
        canvas.addEventListener("pointerup", (event) => this.#up(at(event)));
        viewer.overlays.push(() => this.#place());
        input("brush").addEventListener("input", () => this.#tell());
        for (const flag of Object.values(FLAGS)) element(`copy-${flag}`).addEventListener("click", () => void this.#copy(flag));
        document.addEventListener("keydown", (event) => this.#key(event));
    }

    /** Another surface is shown: the place may no longer be on it. */
    forget(): void {
        this.#isFixed = false;
        this.#show(null);
    }

    #moved(place: Vector2, isHeld: boolean): void {
        if (this.#isFixed) return;
        this.#show(isHeld || this.#dragging.isAt(place) ? null : this.#hitAt(place));
    }

    #up(place: Vector2): void {
        if (this.#down === null || this.#down.distanceTo(place) > STILL) return;
        const hit = this.#hitAt(place);
        this.#isFixed = hit !== null;
        this.#show(hit);
    }

    #hitAt(place: Vector2): Hit | null {
        return this.#model.surface.hit(this.#viewer.ray(place.x, place.y).ray);
    }

    #show(hit: Hit | null): void {
        this.#triangle = hit?.triangle ?? 0;
        this.#point = hit && exactly(this.#model.surface, hit);
        element("spot").hidden = element("mark").hidden = hit === null;
        element("mark").classList.toggle("fixed", this.#isFixed);
        this.#tell();
        this.#place();
    }

    /** In the unit of the file. */
    get #radius(): number {
        return (Number(input("brush").value) / 100) * this.#model.surface.diagonal;
    }

    #numbers(): { place: string[]; radius: string } {
        const decimals = Math.min(12, Math.max(0, Math.ceil(-Math.log10(FINE * this.#model.surface.diagonal))));
        const short = (x: number) => String(Number(x.toFixed(decimals)) + 0);
        return { place: this.#point!.toArray().map(short), radius: short(this.#radius) };
    }

    #tell(): void {
        if (this.#point === null) return;
        const { place, radius } = this.#numbers();
        ["x", "y", "z"].forEach((axis, k) => (element(`spot-${axis}`).textContent = place[k]!));
        element("spot-r").textContent = radius;
        element("spot-h").textContent = this.#model.surface.curvature(this.#triangle).toPrecision(3);
    }

    /** The cross stays at its place when the view turns; the circle is as large as the brush there. */
    #place(): void {
        if (this.#point === null) return;
        const { left, top } = this.#viewer.canvas.getBoundingClientRect();
        const { x, y } = this.#viewer.project(this.#point);
        const side = this.#viewer.eye.right.multiplyScalar(this.#radius).add(this.#point);
        const size = 2 * this.#viewer.project(side).distanceTo(new Vector2(x, y));
        Object.assign(element("mark").style, { translate: `${x - left}px ${y - top}px`, width: `${size}px`, height: `${size}px` });
    }

    #key(event: KeyboardEvent): void {
        const flag = FLAGS[event.key as keyof typeof FLAGS];
        const isTyping = event.target instanceof Element && event.target.matches("select, input:not([type=range], [type=radio], [type=checkbox])");
        if (flag === undefined || event.ctrlKey || event.metaKey || event.altKey || isTyping) return;
        if (this.#point === null && event.target === this.#viewer.canvas) this.#show(this.#middle());
        void this.#copy(flag);
    }

    #middle(): Hit | null {
        const { left, top, width, height } = this.#viewer.canvas.getBoundingClientRect();
        return this.#hitAt(new Vector2(left + width / 2, top + height / 2));
    }

    async #copy(flag: Flag): Promise<void> {
        if (this.#point === null) return say("Point at the surface: its place is copied.", true);
        const { place, radius } = this.#numbers();
        const text = `--${flag} ${[...place, ...(flag === "bump" ? [] : [radius])].join(",")}`;
        say((await copied(text)) ? `Copied: ${text}` : `Copy it from here: ${text}`);
    }
}

/** The place that was hit, by the corners as the file has them: what is drawn has fewer digits. */
function exactly(surface: Surface, { point, triangle }: Hit): Vector3 {
    const [a, b, c] = [0, 1, 2].map((k) => surface.vertex(surface.triangles[3 * triangle + k]!)) as [Vector3, Vector3, Vector3];
    const [u, v, w] = [b.sub(a), c.sub(a), point.clone().sub(a)];
    const [uu, uv, vv, uw, vw] = [u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w)];
    const area = uu * vv - uv * uv;
    if (area === 0) return point;
    return a.addScaledVector(u, (vv * uw - uv * vw) / area).addScaledVector(v, (uu * vw - uv * uw) / area);
}
