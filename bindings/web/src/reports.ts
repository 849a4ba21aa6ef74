/** Results in the library's memory, read into plain objects. */

import * as abi from "./abi.js";
import type { Floats } from "./arrays.js";
import { scalarOf } from "./arrays.js";
import { type Argument, type FunctionName, type Library, numberOf, read, type StructName, within } from "./library.js";

/** How a fairing went. Where the region has several components, the whole has their worst outcome and largest figures. */
export interface Report extends abi.Report {
    /** Whether the tolerance is met and the surface is sound, without reservation: the outcome is "converged". */
    isSuccess: boolean;
    /** What the outcome means, or its reason: English, begins in lower case, ends without a full stop. */
    text: string;
    /** What can be done about it, written like the text; empty if there is nothing to do. */
    remedy: string;
    /** The components of the region, by their smallest free vertices; at least one. */
    components: Component[];
    /** What became of the sharp edges that reach the boundary, where the option `sharp` asks for them. */
    sharpEdges: SharpEdge[];
}

/** Ends of sharp edges that belong together, and what became of them. */
export interface SharpEdge extends abi.SharpEdge {
    /** Where it arrives at the boundary: one, two, or as many as meet in corners. */
    ends: abi.CreaseEnd[];
    /** The vertices along it, from end to end, or from each end to the corner one after the other; empty where it does not go on. */
    vertices: Uint32Array;
}

/** What came of one component of the region: an independent problem. */
export interface Component extends abi.Component {
    /** What was tried, in its order. */
    attempts: abi.Attempt[];
    /** What came of the option `continuity` along each boundary loop. */
    continuity: abi.Continuity[];
}

/** What became of a loop that was to be filled, or of several that are joined. */
export interface LoopReport extends abi.FillReport {
    /** The reason, if there is one, otherwise the outcome, in a sentence. */
    text: string;
    /** What can be done about it; empty if there is nothing to do. */
    remedy: string;
    /** All the loops that the patch is for, ascending: more than one if they are joined. */
    loopIndices: Uint32Array;
    /** New vertices that lie far outside the loop's bounding box. */
    outsideVertices: Uint32Array;
    /** Pairs of triangles that intersect, one after the other; at least one of each is of this patch. */
    intersections: Uint32Array;
    /** The report of the fairing, if there was one. */
    report: Report | null;
}

/** What a name of one of the library's answers means, and what can be done about it. */
export interface Telling {
    text: string;
    remedy: string;
}

/** Enumerations whose values the library has texts for. */
export type Told = "status" | "outcome" | "looseReason" | "attemptEnd" | "fillOutcome" | "fillReason" | "sharpFate";

const ANSWERS = {
    status: "status",
    outcome: "outcome",
    looseReason: "loose_reason",
    attemptEnd: "attempt_end",
    fillOutcome: "fill_outcome",
    fillReason: "fill_reason",
    sharpFate: "sharp_fate",
} as const;

/** What a value means. */
export function telling(library: Library, kind: Told, name: string): Telling {
    const number = numberOf(kind, name);
    if (number === undefined) throw new TypeError(`there is no ${kind} "${name}"`);
    const answer = ANSWERS[kind];
    return { text: library.text(answer, number, "meaning"), remedy: library.text(answer, number, "remedy") };
}

/** Reads a struct that a function fills in. */
export function filledIn(library: Library, name: StructName, call: (at: number) => void): Record<string, unknown> {
    return within(library, (scope) => {
        const at = scope.struct(name, {});
        call(at);
        return read(library, at, name);
    });
}

/** A `fairmesh_result`, as long as it lives. */
export class ResultHandle {
    readonly library: Library;
    readonly address: number;

    constructor(library: Library, address: number) {
        this.library = library;
        this.address = address;
    }

    /** A struct of it, by its number if it has several. */
    struct<T>(function_: FunctionName, name: StructName, ...numbers: number[]): T {
        return filledIn(this.library, name, (at) => this.library.call(function_, this.address, ...numbers.map(BigInt), at)) as T;
    }

    info(): abi.Info {
        return this.struct<abi.Info>("fairmesh_result_info", "info");
    }

    report(index = 0): Report {
        const figures = this.struct<abi.Report>("fairmesh_result_report", "report", index);
        const components = Array.from({ length: figures.componentCount }, (_, number) => this.#component(index, number));
        const along = figures.sharpEdgeCount === 0 ? new Uint32Array(0) : this.list("sharp_vertices", index);
        const sharpEdges = Array.from({ length: figures.sharpEdgeCount }, (_, number) => this.#sharpEdge(index, number, along));
        const { outcome, looseReason } = figures;
        const loosely = outcome === "converged_loosely";
        const told = loosely ? telling(this.library, "looseReason", looseReason) : telling(this.library, "outcome", outcome);
        return { ...figures, isSuccess: outcome === "converged", ...told, components, sharpEdges };
    }

    #component(index: number, number: number): Component {
        const own = this.struct<abi.Component>("fairmesh_result_component", "component", index, number);
        const attempt = (_: unknown, k: number) => this.struct<abi.Attempt>("fairmesh_result_attempt", "attempt", index, number, k);
        const loop = (_: unknown, k: number) => this.struct<abi.Continuity>("fairmesh_result_continuity", "continuity", index, number, k);
        return {
            ...own,
            attempts: Array.from({ length: own.attemptCount }, attempt),
            continuity: Array.from({ length: own.continuityCount }, loop),
        };
    }

    #sharpEdge(index: number, number: number, along: Uint32Array): SharpEdge {
        const own = this.struct<abi.SharpEdge>("fairmesh_result_sharp_edge", "sharpEdge", index, number);
        const end = (_: unknown, k: number) => this.struct<abi.CreaseEnd>("fairmesh_result_crease_end", "creaseEnd", index, number, k);
        const vertices = along.slice(own.firstVertex, own.firstVertex + own.vertexCount);
        return { ...own, ends: Array.from({ length: own.endCount }, end), vertices };
    }

    loopReport(index: number): LoopReport {
        const told = this.struct<abi.FillReport>("fairmesh_result_fill_report", "fillReport", index);
        const says =
            told.reason === "none" ? telling(this.library, "fillOutcome", told.outcome) : telling(this.library, "fillReason", told.reason);
        return {
            ...told,
            ...says,
            loopIndices: this.list("joined_loops", index),
            outsideVertices: this.list("outside_vertices", index),
            intersections: this.list("intersections", index),
            report: told.hasReport ? this.report(index) : null,
        };
    }

    /** A list of indices. */
    list(which: abi.List, index = 0): Uint32Array {
        const function_ = "fairmesh_result_list";
        return within(this.library, (scope) => {
            const number = abi.enums.list[which];
            const size = scope.bytes(4);
            this.library.call(function_, this.address, number, BigInt(index), 0, 0, size);
            const count = this.library.view.getUint32(size, true);
            if (count === 0) return new Uint32Array(0);
            const out = scope.bytes(4 * count);
            this.library.call(function_, this.address, number, BigInt(index), out, count, size);
            return new Uint32Array(this.library.buffer, out, count).slice();
        });
    }

    /** All positions, into an array of the precision wanted. */
    positions<T extends Floats>(into: T): T {
        return readInto(this.library, into, 3, "pointsOut", (out) => this.library.call("fairmesh_result_positions", this.address, out));
    }

    triangles(count: number): Uint32Array {
        return within(this.library, (scope) => {
            const data = count === 0 ? 0 : scope.bytes(12 * count);
            this.library.call("fairmesh_result_triangles", this.address, scope.struct("indicesOut", { data, count, stride: 0 }));
            return new Uint32Array(this.library.buffer, data, 3 * count).slice();
        });
    }

    /** Numbers per vertex. */
    scalars(which: abi.Scalars, count: number): Float64Array {
        const number = abi.enums.scalars[which];
        return readInto(this.library, new Float64Array(count), 1, "scalarsOut", (out) =>
            this.library.call("fairmesh_result_scalars", this.address, number, out),
        );
    }

    /** Vectors. */
    vectors(which: abi.Vectors, count: number): Float64Array {
        const number = abi.enums.vectors[which];
        return readInto(this.library, new Float64Array(3 * count), 3, "pointsOut", (out) =>
            this.library.call("fairmesh_result_vectors", this.address, number, out),
        );
    }
}

/** Lets the library write numbers, and copies them. */
export function readInto<T extends Floats>(library: Library, into: T, each: 1 | 3, struct: "pointsOut" | "scalarsOut", call: (out: number) => void): T {
    return within(library, (scope) => {
        const data = into.length === 0 ? 0 : scope.bytes(into.byteLength);
        call(scope.struct(struct, { data, count: into.length / each, stride: 0, scalar: scalarOf(into) }));
        const bytes = new Uint8Array(library.buffer, data, into.byteLength);
        new Uint8Array(into.buffer, into.byteOffset, into.byteLength).set(bytes);
        return into;
    });
}

/** Calls a function that makes a result, reads it, and frees it. The function's last argument is where the result's address is put. */
export function resultOf<T>(library: Library, name: FunctionName, given: readonly Argument[], use: (result: ResultHandle) => T): T {
    const address = within(library, (scope) => {
        const slot = scope.bytes(4);
        library.call(name, ...given, slot);
        return library.view.getUint32(slot, true);
    });
    try {
        return use(new ResultHandle(library, address));
    } finally {
        if (!library.isBroken) library.invoke("fairmesh_result_free", address);
    }
}

