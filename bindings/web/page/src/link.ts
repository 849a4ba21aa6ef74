/** The state of the page as text behind the # of its address. */

import type { Edit } from "../../src/index.js";
import type { Shading } from "./shading.js";
import type { ShapeName } from "./embedded.js";
import type { View } from "./viewer.js";

/** What was done, in its order: with these a shape becomes what is seen. */
export type Step =
    | { kind: "fair"; region: Runs; edits: Edit[] }
    | { kind: "fill" }
    | { kind: "join"; loops: [number, number] }
    | { kind: "refill" | "remesh"; region: Runs }
    | { kind: "round"; region: Runs; width: number };

/** Lengths of runs of triangles that are not chosen, chosen, not chosen, ... */
export type Runs = number[];

/** Everything that a link tells. */
export interface State {
    shape: ShapeName;
    steps: Step[];
    region: Runs;
    view: View;
    shading: Shading;
    wires: boolean;
}

export function runsOf(mask: Uint8Array): Runs {
    const runs: Runs = [];
    let last = 0;
    for (let t = 0, start = 0; t <= mask.length; t++) {
        if (t < mask.length && mask[t] === last) continue;
        runs.push(t - start);
        start = t;
        last = 1 - last;
    }
    return runs;
}

export function maskOf(runs: Runs, count: number): Uint8Array {
    const mask = new Uint8Array(count);
    let at = 0;
    runs.forEach((run, k) => {
        if (k % 2 === 1) mask.fill(1, at, at + run);
        at += run;
    });
    return mask;
}

async function through(bytes: Uint8Array, by: CompressionStream | DecompressionStream): Promise<Uint8Array> {
    const stream = new Blob([bytes as Uint8Array<ArrayBuffer>]).stream().pipeThrough(by as ReadableWritablePair<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>);
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Numbers need no more digits than are seen; those of edits keep theirs. */
export async function toText(state: State): Promise<string> {
    const view = state.view.map((x) => Number(x.toPrecision(5)));
    const packed = await through(new TextEncoder().encode(JSON.stringify({ ...state, view })), new CompressionStream("deflate-raw"));
    return btoa(String.fromCharCode(...packed)).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

/** Null where the text is no state: a link may have been cut off. */
export async function fromText(text: string): Promise<State | null> {
    try {
        const letters = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
        const unpacked = await through(Uint8Array.from(letters, (letter) => letter.charCodeAt(0)), new DecompressionStream("deflate-raw"));
        const state = JSON.parse(new TextDecoder().decode(unpacked)) as State;
        return Array.isArray(state.steps) && Array.isArray(state.region) && state.view.length === 6 ? state : null;
    } catch {
        return null;
    }
}
