/** Changes of the boundary between the frames of a `Solver`. */

import { type Indices, indices, indicesIn } from "./arrays.js";
import { point, type Point } from "./holes.js";
import type { Scope, Values } from "./library.js";
import { known, oneOf, real, whole } from "./options.js";

/** Turns the boundary normals of a loop about the boundary; "twist": on one side of `vertex`, and the opposite on the other. */
export interface Tilt {
    kind: "tilt" | "twist";
    /** A boundary vertex of the region; its loop is meant. */
    vertex: number;
    /** In radians. With a positive one the surface leaves the boundary steeper to the side that normals point to. */
    angle: number;
    /** How far along the loop from `vertex` it reaches, falling off smoothly; 0 (default): the whole loop. */
    falloff?: number | undefined;
}

/** Bulges the whole region by one number, outward if it is positive; see `Solver.bulgeRange`. */
export interface Bulge {
    kind: "bulge";
    amount: number;
}

/** Moves fixed vertices rigidly; their normals follow, given or fitted. */
export interface Move {
    kind: "move";
    vertices: Indices;
    /** The axis, times the angle in radians. */
    rotation?: Point | undefined;
    /** A point on the axis. */
    centre?: Point | undefined;
    /** After the rotation. */
    translation?: Point | undefined;
    /** How far along the mesh other fixed vertices follow in part; 0 (default): none does. */
    falloff?: number | undefined;
}

/** A change of what is asked at the boundary. */
export type Edit = Tilt | Bulge | Move;

/** What a frame may cost. */
export interface Budget {
    /** Evaluations of the equations at most. Default: no limit. */
    evaluations?: number | undefined;
    /** Seconds, about; has no effect in WebAssembly, which has no clock. */
    seconds?: number | undefined;
    /** The step norm at which a frame is settled, in diagonals. Default 1e-6. */
    tolerance?: number | undefined;
}

/** How the surface of a frame stands. */
export interface Frame {
    /** Its step norm, in diagonals of the bounding box: how far from the end it is, about; NaN before there is one. */
    step: number;
    /** Evaluations of the equations that it has cost. */
    evaluations: number;
    /** Whether its step norm is within the tolerance; if not, further updates go on from here. */
    isSettled: boolean;
}

const FIELDS = {
    tilt: ["kind", "vertex", "angle", "falloff"],
    twist: ["kind", "vertex", "angle", "falloff"],
    bulge: ["kind", "amount"],
    move: ["kind", "vertices", "rotation", "centre", "translation", "falloff"],
};

function editIn(scope: Scope, edit: Edit): Values {
    const kind = oneOf("editKind", edit.kind, "kind") as keyof typeof FIELDS;
    known(edit, FIELDS[kind]);
    if (edit.kind === "bulge") return { kind, amount: real(edit.amount, "amount") };
    const falloff = real(edit.falloff ?? 0, "falloff");
    if (edit.kind !== "move") return { kind, vertex: indices([edit.vertex], "vertex")[0], amount: real(edit.angle, "angle"), falloff };
    const made: Record<string, unknown> = { kind, vertices: indicesIn(scope, indices(edit.vertices, "vertices")), falloff };
    if (edit.rotation !== undefined) made["rotation"] = point(edit.rotation, "rotation");
    if (edit.centre !== undefined) made["centre"] = point(edit.centre, "centre");
    if (edit.translation !== undefined) made["translation"] = point(edit.translation, "translation");
    return made as Values;
}

/** Edits as the C interface takes them: their address and count. */
export function editsIn(scope: Scope, edits: readonly Edit[]): [number, number] {
    if (!Array.isArray(edits)) throw new TypeError("edits: an array is needed");
    const values = edits.map((edit: Edit) => editIn(scope, edit));
    return [values.length === 0 ? 0 : scope.structs("edit", values), values.length];
}

/** A budget as the C interface takes it. */
export function budgetIn(scope: Scope, budget: Budget): number {
    known(budget, ["evaluations", "seconds", "tolerance"]);
    return scope.struct("budget", {
        evaluations: BigInt(whole(budget.evaluations ?? 0, "evaluations")),
        seconds: real(budget.seconds ?? 0, "seconds"),
        tolerance: real(budget.tolerance ?? 0, "tolerance"),
    });
}
