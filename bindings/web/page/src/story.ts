/** The first ten seconds: one arrow turns by itself, the surface follows, and the arrow is handed over. It ends at the first touch. */

import type { Dragging } from "./dragging.js";
import { element } from "./page.js";

/** Seconds after which the arrow begins to turn, and has come back; at half of them the eye does not follow, at double nobody waits. */
const [BEGINS, ENDS] = [1.2, 6];
/** How far it turns out, in radians: at half the surface hardly moves, at double it bulges into itself. */
const FAR = 0.75;

const SAYS = {
    first: "This surface is as smooth as its edges allow.",
    turning: "Turn an arrow, and all of it follows.",
    yours: "Now you: drag the arrow.",
};

export class Story {
    readonly #dragging: Dragging;
    #start: number | null = null;
    #isInviting = false;
    /** Whoever has touched the page before has begun without it. */
    #isTouched = false;

    constructor(dragging: Dragging) {
        this.#dragging = dragging;
        const end = () => this.end();
        for (const kind of ["keydown", "wheel", "click", "input", "drop"]) window.addEventListener(kind, end, { capture: true, passive: true });
        // Behind the view, which may have taken the arrow.
        window.addEventListener("pointerdown", end);
    }

    /** Tells it of the surface that has just been faired. Who wants no motion gets the last line at once. */
    begin(): void {
        if (this.#isTouched || !this.#dragging.invite()) return;
        this.#isInviting = true;
        if (matchMedia("(prefers-reduced-motion: reduce)").matches) return this.#say(SAYS.yours);
        this.#start = performance.now();
        this.#say(SAYS.first);
        requestAnimationFrame(() => this.#tick());
    }

    #tick(): void {
        if (this.#start === null) return;
        const part = ((performance.now() - this.#start) / 1000 - BEGINS) / (ENDS - BEGINS);
        if (part >= 1) {
            this.#start = null;
            this.#dragging.turn(0);
            return this.#say(SAYS.yours);
        }
        if (part > 0) {
            // Out, back through the middle to the other side, and home, slow at both ends.
            this.#say(SAYS.turning);
            this.#dragging.turn(FAR * Math.sin(2 * Math.PI * part) * Math.sin(Math.PI * part));
        }
        requestAnimationFrame(() => this.#tick());
    }

    #say(text: string): void {
        element("story").hidden = false;
        element("story").textContent = text;
    }

    /** Ends it. Whoever has taken the arrow goes on from where it is; otherwise it goes back. */
    end(isTaken = false): void {
        this.#isTouched = true;
        if (!this.#isInviting) return;
        this.#isInviting = false;
        element("story").hidden = true;
        if (this.#start !== null && !isTaken) this.#dragging.turn(0);
        this.#start = null;
        this.#dragging.invited();
    }
}
