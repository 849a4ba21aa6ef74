/** Arrows on the boundary of the region: they stand on it as the tangent planes do, and are dragged. */

import { ConeGeometry, CylinderGeometry, type Group, Mesh, MeshLambertMaterial, Quaternion, SphereGeometry, Vector2, Vector3 } from "three";
import { element } from "./page.js";
import type { LoopVertex, Surface } from "./surface.js";
import type { Viewer } from "./viewer.js";

/** Their length, in diagonals of the surface. */
export const SIZE = 0.09;
/** The sine of the largest angle: no surface follows further. */
const MOST = 0.98;
/** The size of the others while one invites. */
const QUIET = 0.5;
/** How many arrows a loop has, at most. */
export const ARROWS = 8;

/** The vertices of a loop that have arrows. */
export function gripped(loop: readonly LoopVertex[]): LoopVertex[] {
    const count = Math.min(ARROWS, loop.length);
    return Array.from({ length: count }, (_, k) => loop[Math.floor((k * loop.length) / count)]!);
}

interface Arrow {
    loop: number;
    grip: LoopVertex;
    foot: Vector3;
    tip: Vector3;
}

const UP = new Vector3(0, 1, 0);
const SHAFT = new CylinderGeometry(0.018, 0.018, 1, 8).translate(0, 0.5, 0);
const HEAD = new ConeGeometry(0.075, 0.25, 16).translate(0, 1, 0);
const BALL = new SphereGeometry(0.055, 16, 12);

/** Finds and draws the arrows. */
export class Handles {
    readonly #viewer: Viewer;
    readonly #idle = new MeshLambertMaterial({ color: 0x7c868f });
    readonly #active = new MeshLambertMaterial({ color: 0xd98a3d });
    readonly #held = new MeshLambertMaterial({ color: 0xe05a00, emissive: 0x6b2000 });
    #arrows: Arrow[] = [];
    /** Whether the one arrow that the sliders mean stands out, with a ring around its tip. */
    isInviting = false;
    #invited: Arrow | null = null;

    constructor(viewer: Viewer) {
        this.#viewer = viewer;
        viewer.overlays.push(() => this.#ring());
    }

    #ring(): void {
        element("invite").hidden = this.#invited === null;
        if (this.#invited === null) return;
        const { left, top } = this.#viewer.canvas.getBoundingClientRect();
        const { x, y } = this.#viewer.project(this.#invited.tip);
        element("invite").style.translate = `${x - left}px ${y - top}px`;
    }

    /** Draws them; `held` is the number of the arrow of the active loop that the sliders mean. */
    draw(loops: readonly LoopVertex[][], surface: Surface, active: number, held: number, angleAt: (loop: number, grip: LoopVertex) => number): void {
        const group: Group = this.#viewer.handles;
        group.clear();
        const size = SIZE * surface.diagonal;
        this.#arrows = [];
        this.#invited = null;
        loops.forEach((loop, number) =>
            gripped(loop).forEach((grip, k) => {
                const foot = surface.vertex(grip.vertex);
                const angle = angleAt(number, grip);
                const direction = grip.normal.clone().multiplyScalar(Math.cos(angle)).addScaledVector(grip.inward, -Math.sin(angle));
                const arrow = { loop: number, grip, foot, tip: foot.clone().addScaledVector(direction, size) };
                this.#arrows.push(arrow);
                const isMeant = number === active && k === held;
                if (this.isInviting && isMeant) this.#invited = arrow;
                const paint = number !== active || (this.isInviting && !isMeant) ? this.#idle : k === held ? this.#held : this.#active;
                const turn = new Quaternion().setFromUnitVectors(UP, direction.normalize());
                for (const shape of [SHAFT, HEAD, BALL]) {
                    const mesh = new Mesh(shape, paint);
                    mesh.position.copy(foot);
                    mesh.quaternion.copy(turn);
                    mesh.scale.setScalar(this.isInviting && !isMeant ? QUIET * size : size);
                    group.add(mesh);
                }
            }),
        );
        this.#viewer.draw();
    }

    clear(): void {
        this.#arrows = [];
        this.#invited = null;
        this.#viewer.handles.clear();
        this.#viewer.draw();
    }

    /** The arrow whose tip, or shaft, is nearest to a place of the window, within so many pixels; of those on top of each other the nearer one. */
    at(place: Vector2, within: number): { loop: number; number: number; grip: LoopVertex; foot: Vector3 } | null {
        let best = null;
        let least = within;
        for (const arrow of this.#arrows) {
            const [tip, foot] = [this.#viewer.project(arrow.tip), this.#viewer.project(arrow.foot)];
            const along = tip.clone().sub(foot);
            const part = Math.max(0, Math.min(1, place.clone().sub(foot).dot(along) / (along.lengthSq() || 1)));
            const distance = place.distanceTo(foot.addScaledVector(along, part));
            if (distance < least) [least, best] = [distance, arrow];
        }
        if (best === null) return null;
        const number = this.#arrows.filter(({ loop }) => loop === best.loop).indexOf(best);
        return { loop: best.loop, number, grip: best.grip, foot: best.foot };
    }

    /** The arrow that is seen best: nothing stands before it, and a drag outward is longest in the picture. */
    best(surface: Surface): { loop: number; number: number } | null {
        const size = SIZE * surface.diagonal;
        let [best, longest]: [Arrow | null, number] = [null, 0];
        for (const arrow of this.#arrows) {
            const tip = this.#viewer.project(arrow.tip);
            const hit = surface.hit(this.#viewer.ray(tip.x, tip.y).ray);
            const eye = this.#viewer.eye.place;
            if (hit !== null && hit.point.distanceTo(eye) < arrow.tip.distanceTo(eye) - 0.1 * size) continue;
            const outward = this.#viewer.project(arrow.foot.clone().addScaledVector(arrow.grip.inward, -size));
            // Against the ground it is seen twice as well as in front of the surface.
            const length = outward.distanceTo(this.#viewer.project(arrow.foot)) * (hit === null ? 2 : 1);
            if (length > longest) [best, longest] = [arrow, length];
        }
        return best && { loop: best.loop, number: this.#arrows.filter(({ loop }) => loop === best.loop).indexOf(best) };
    }

    /** Where the tips are in the window, for tests. */
    places(): { loop: number; x: number; y: number }[] {
        return this.#arrows.map(({ loop, tip }) => ({ loop, ...this.#viewer.project(tip) }));
    }

    /** What a drag makes of an arrow's angle, in radians: its tip follows the pointer, as far as it can. */
    angle(grip: LoopVertex, foot: Vector3, size: number, before: number, from: Vector2, to: Vector2): number {
        const outward = this.#viewer.project(foot.clone().addScaledVector(grip.inward, -size)).sub(this.#viewer.project(foot));
        const length = outward.length();
        const moved = to.clone().sub(from);
        // Where it would point at the eye, up is steeper.
        const sine = Math.sin(before) + (length < 12 ? -moved.y / 60 : moved.dot(outward) / (length * length));
        return Math.asin(Math.max(-MOST, Math.min(MOST, sine)));
    }
}
