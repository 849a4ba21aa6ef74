/** Triangles chosen by place, distance and shape, as masks. */

import type * as abi from "./abi.js";
import { chosenTriangles, indices, indicesIn, type Indices, type Mesh, MeshIn, type Selection } from "./arrays.js";
import { type Host, watched } from "./fairing.js";
import { point, type Point, withMesh } from "./holes.js";
import type { Scope, Values } from "./library.js";
import { known, oneOf, real, WATCHING, whole } from "./options.js";
import type { Watching } from "./progress.js";
import { resultOf } from "./reports.js";

/** A vertex by its number, or the point of the surface that is nearest to this one. */
export type Seed = number | Point;

/** One step of `selectRegion`: what it names, or does. */
export interface RegionStep {
    kind: abi.RegionKind;
    /** How what it names is combined with the region so far. Default: "add". */
    combine?: abi.Combine | undefined;
    seed?: Seed | undefined;
    /** The centre of a ball, the smallest coordinates of a box, a point of a plane. */
    point?: Point | undefined;
    /** The largest coordinates of a box, the normal of a plane. */
    vector?: Point | undefined;
    /** A radius, an angle in degrees, or about how far a bump reaches. */
    value?: number | undefined;
    /** How many rings to grow or shrink by. */
    rings?: number | undefined;
    /** Triangles or vertices. */
    list?: Indices | undefined;
}

/** Triangles chosen step by step. */
export interface RegionResult {
    /** One entry for each triangle: 1 is chosen. */
    mask: Uint8Array;
    /** The triangles, ascending. */
    triangles: Uint32Array;
    /** Per step how many triangles it named by itself, or, of "grow", "shrink" and "invert", how many there were after it. */
    counts: Uint32Array;
    /** What was taken for bumps, one for each step "bump". */
    bumps: abi.Bump[];
}

const STEP = ["kind", "combine", "seed", "point", "vector", "value", "rings", "list"];

function stepIn(scope: Scope, step: RegionStep): Values {
    known(step, STEP);
    const made: Record<string, unknown> = { kind: oneOf("regionKind", step.kind, "kind") };
    if (step.combine !== undefined) made["combine"] = oneOf("combine", step.combine, "combine");
    if (typeof step.seed === "number") {
        Object.assign(made, { seedKind: "vertex", seedVertex: indices([step.seed], "seed")[0] });
    } else if (step.seed !== undefined) {
        made["point"] = point(step.seed, "seed");
    }
    if (step.point !== undefined) made["point"] = point(step.point, "point");
    if (step.vector !== undefined) made["vector"] = point(step.vector, "vector");
    if (step.value !== undefined) made["value"] = real(step.value, "value");
    if (step.rings !== undefined) made["rings"] = whole(step.rings, "rings");
    if (step.list !== undefined) made["list"] = indicesIn(scope, indices(step.list, "list"));
    return made;
}

/** See `Fairmesh.selectRegion`. */
export function selectRegion(host: Host, given: Mesh, steps: readonly RegionStep[], options: Watching = {}): RegionResult {
    known(options, WATCHING);
    const mesh = new MeshIn(given);
    if (!Array.isArray(steps)) throw new TypeError("steps: an array is needed");
    return watched(host, options, ({ progress, userData }) =>
        withMesh(host, mesh, (address, scope) => {
            const values = steps.map((step) => stepIn(scope, step));
            const at = values.length === 0 ? 0 : scope.structs("regionStep", values);
            return resultOf(host.library, "fairmesh_select_region", [address, at, values.length, progress, userData], (result) => {
                const triangles = result.list("region_triangles");
                const mask = new Uint8Array(mesh.triangleCount);
                for (const triangle of triangles) mask[triangle] = 1;
                const bumps = steps.filter(({ kind }) => kind === "bump").map((_, k) => result.struct<abi.Bump>("fairmesh_result_bump", "bump", k));
                return { mask, triangles, counts: result.list("region_counts"), bumps };
            });
        }),
    );
}

/** A region, given as a mask or indices, and one more step. */
export function spread(host: Host, given: Mesh, region: Selection, kind: "grow" | "shrink", rings: number): Uint8Array {
    const list = chosenTriangles(new MeshIn(given), region, "region");
    return selectRegion(host, given, [{ kind: "triangles", list }, { kind, rings: whole(rings, "rings") }]).mask;
}
