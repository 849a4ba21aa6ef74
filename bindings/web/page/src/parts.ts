/** What has become of each part: of every hole that was filled, of every piece of the region that was faired. */

import type { Component, LoopReport, Report } from "../../src/index.js";
import { worded } from "./words.js";

export interface Part {
    name: string;
    /** What is said of it, with what can be done. */
    says: string;
    isGood: boolean;
    /** Its triangles; none where a hole stayed open. */
    triangles: Uint8Array | null;
}

/** A report in the words of the page. */
export function saysOf({ outcome, looseReason, text }: Report): string {
    return worded(outcome === "converged_loosely" ? looseReason : outcome, text);
}

function saysOfLoop({ outcome, reason, text, report }: LoopReport): string {
    if (report !== null && (outcome === "faired" || outcome === "least_bending" || reason === "unsound")) return saysOf(report);
    return worded(reason === "none" ? outcome : reason, text);
}

/** One for each hole that was looked at, of a mesh of so many triangles with the patches. */
export function partsOfHoles(loops: readonly LoopReport[], count: number): Part[] {
    return loops.map((loop) => {
        const first = loop.firstTriangle;
        const triangles = loop.triangleCount === 0 ? null : new Uint8Array(count).fill(1, first, first + loop.triangleCount);
        const numbers = Array.from(loop.loopIndices, (index) => index + 1);
        const name = `${numbers.length > 1 ? "Holes" : "Hole"} ${numbers.join(" and ")} (${loop.edgeCount} edges)`;
        return { name, says: saysOfLoop(loop), isGood: loop.isSuccess && triangles !== null, triangles };
    });
}

/** One for each piece of the region by itself; `told` has the meaning of each outcome. */
export function partsOfRegion(components: readonly Component[], free: Uint8Array, corners: Uint32Array, told: (of: Component) => string): Part[] {
    const pieces = pieceOf(free, corners);
    return components.map((of, k) => {
        const triangles = new Uint8Array(corners.length / 3);
        corners.forEach((v, c) => free[v] && pieces(v) === pieces(of.vertex) && (triangles[Math.floor(c / 3)] = 1));
        const name = `Part ${k + 1} (${of.freeVertices.toLocaleString("en")} vertices)`;
        return { name, says: told(of), isGood: of.outcome === "converged", triangles };
    });
}

/** Which piece a vertex that may move belongs to: a vertex of it, the same for all. */
function pieceOf(free: Uint8Array, corners: Uint32Array): (vertex: number) => number {
    const parent = Uint32Array.from(free, (_, v) => v);
    const root = (v: number): number => {
        while (parent[v] !== v) v = parent[v] = parent[parent[v]!]!;
        return v;
    };
    for (let k = 0; k < corners.length; k++) {
        const [a, b] = [corners[k]!, corners[k % 3 === 2 ? k - 2 : k + 1]!];
        if (free[a] && free[b]) parent[root(a)] = root(b);
    }
    return root;
}

/** All of them in one sentence: the one by itself, or how many have come out well. */
export function summed(parts: readonly Part[]): string {
    if (parts.length === 1) return parts[0]!.says;
    const good = parts.filter(({ isGood }) => isGood).length;
    if (good === parts.length) return `all ${good}: ${parts[0]!.says}`;
    const open = parts.filter(({ triangles }) => triangles === null).length;
    const told = [good && `${good} fair and sound`, parts.length - good - open && `${parts.length - good - open} with something to say`, open && `${open} left open`];
    return `${told.filter(Boolean).join(", ")}: the list tells of each`;
}
