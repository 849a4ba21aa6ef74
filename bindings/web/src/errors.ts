/** What is thrown when a call was refused. */

import type { Element, Status } from "./abi.js";

/** Which vertex, triangle, edge or loop is to blame. */
export interface ElementOfError {
    /** What `element` counts; "none" if nothing. */
    elementKind: Element;
    element: number | null;
    /** A second index where the status has one: the vertex that a triangle names wrongly, the other end of an edge. */
    other: number | null;
}

/** All that an error tells besides its message. */
export interface ErrorDetails extends ElementOfError {
    /** Why. */
    status: Status;
    /** The name of the option or the property to blame, or null. */
    argument: string | null;
    /** What can be done about it: English, begins in lower case; empty if there is nothing to do. */
    remedy: string;
}

/** The library refused a call. Nothing was written. */
export class FairmeshError extends Error implements ErrorDetails {
    override name = "FairmeshError";
    readonly status: Status;
    readonly elementKind: Element;
    readonly element: number | null;
    readonly other: number | null;
    readonly argument: string | null;
    readonly remedy: string;

    constructor(message: string, details: Partial<ErrorDetails> & { status: Status }) {
        super(message);
        this.status = details.status;
        this.elementKind = details.elementKind ?? "none";
        this.element = details.element ?? null;
        this.other = details.other ?? null;
        this.argument = details.argument ?? null;
        this.remedy = details.remedy ?? "";
    }
}

/** The mesh, the selection, a normal or an option is wrong. */
export class InputError extends FairmeshError {
    override name = "InputError";
}

/** Memory ran out; everything that the call had allocated is free again. */
export class OutOfMemoryError extends FairmeshError {
    override name = "OutOfMemoryError";
}

/** The module has trapped: a bug of fairmesh, or no memory. Nothing can be called any more; `load` makes another copy. */
export class TrapError extends Error {
    override name = "TrapError";

    constructor(cause: unknown) {
        const why = cause instanceof Error ? cause.message : String(cause);
        super(`the WebAssembly module has stopped (${why}) and cannot be used any more; load() makes a new one`, { cause });
    }
}

const INPUT: ReadonlySet<Status> = new Set<Status>([
    "bad_option",
    "bad_enum",
    "count_mismatch",
    "too_large",
    "not_finite",
    "index_out_of_range",
    "repeated_index",
    "duplicate_triangle",
    "non_manifold_edge",
    "non_manifold_vertex",
    "inconsistent_orientation",
    "free_vertex_on_boundary",
    "free_vertex_without_triangle",
    "nothing_fixed",
    "empty_region",
    "selection_out_of_range",
    "bad_normal",
    "no_normal",
    "coordinate_too_large",
    "valence_too_large",
    "not_on_loop",
    "bad_guide",
    "guides_cross",
    "bad_chain",
    "not_an_edge",
    "no_crease",
    "no_bump",
    "bad_edit",
    "not_orientable",
]);

/** The error for a status. */
export function refusal(message: string, details: Partial<ErrorDetails> & { status: Status }): FairmeshError {
    if (details.status === "out_of_memory") return new OutOfMemoryError(message, details);
    return INPUT.has(details.status) ? new InputError(message, details) : new FairmeshError(message, details);
}

/** An error as a message can carry it from a worker. */
export interface SentError {
    kind: "refusal" | "trap" | "type" | "range" | "other";
    message: string;
    details?: ErrorDetails;
}

/** Packs an error. */
export function sent(why: unknown): SentError {
    const message = why instanceof Error ? why.message : String(why);
    if (why instanceof FairmeshError) {
        const { status, elementKind, element, other, argument, remedy } = why;
        return { kind: "refusal", message, details: { status, elementKind, element, other, argument, remedy } };
    }
    if (why instanceof TrapError) return { kind: "trap", message: why.cause instanceof Error ? why.cause.message : "a trap" };
    return { kind: why instanceof TypeError ? "type" : why instanceof RangeError ? "range" : "other", message };
}

/** Unpacks it. */
export function received({ kind, message, details }: SentError): Error {
    if (kind === "refusal" && details !== undefined) return refusal(message, details);
    if (kind === "trap") return new TrapError(message);
    return kind === "type" ? new TypeError(message) : kind === "range" ? new RangeError(message) : new Error(message);
}
