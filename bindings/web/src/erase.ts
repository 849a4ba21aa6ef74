/** Triangles taken away, new triangulations, and what was there carried over; components and intersections. */

import type { PlainRemeshOptions } from "./abi.js";
import { chosenTriangles, type Floats, type Indices, indices, indicesIn, type Mesh, MeshIn, numbersIn, type Points, points, type Region } from "./arrays.js";
import { type Selection, selectionIn } from "./arrays.js";
import { type Host, isSingle, watched } from "./fairing.js";
import { newMesh, type NewMesh, PATCH, type PatchOptions, patchesIn, withMesh } from "./holes.js";
import { plainFields, type Scope, write } from "./library.js";
import { FAIRING, type FairingOptions, fairingIn, known, real, WATCHING, whole, withDefaults } from "./options.js";
import type { Watching } from "./progress.js";
import { type ResultHandle, resultOf } from "./reports.js";

/** A mesh without some of its triangles. Its vertices are those given, used or not. */
export interface Left {
    /** The triangles that are left. */
    triangles: Uint32Array;
    /** Their numbers before, ascending. */
    keptTriangles: Uint32Array;
    /** How many were dropped besides those named, or at all. */
    droppedCount: number;
}

/** A mesh without triangles that were named. */
export interface EraseResult extends Left {
    /** The loops that the deleted triangles leave, as `boundaryLoops` numbers those of the mesh that is left. */
    loops: Uint32Array;
    /** How many triangles were dropped because they would spoil the boundary of a patch. */
    cleanedCount: number;
}

/** A mesh without the triangles that would spoil patches. */
export interface TrimResult extends Left {
    /** The area of those that were dropped. */
    droppedArea: number;
}

/** Where points lie on the triangles of a mesh. */
export interface Carried {
    /** The nearest triangle of each point; -1 where there is none. */
    triangles: Int32Array;
    /** Its corners, three for each point; -1 where there is none. */
    corners: Int32Array;
    /** Their weights at the nearest place. */
    weights: Float64Array;
}

/** A mesh with a new triangulation of a region. */
export interface RemeshResult<P extends Floats = Floats> extends NewMesh<P> {
    /** The free vertices of the new mesh: give them to `fair`. */
    freeVertices: Uint32Array;
    /** Per vertex, and per triangle, that is left its number before. */
    keptVertices: Uint32Array;
    keptTriangles: Uint32Array;
}

/** Options of `remesh`. */
export interface RemeshOptions extends Region, PlainRemeshOptions, Watching {}

/** Options of `refill`. */
export interface RefillOptions extends FairingOptions, PatchOptions, Region {}

/** The triangles with these numbers. */
function kept(mesh: MeshIn, numbers: Uint32Array): Uint32Array {
    const made = new Uint32Array(3 * numbers.length);
    numbers.forEach((from, to) => made.set(mesh.triangles.subarray(3 * from, 3 * from + 3), 3 * to));
    return made;
}

/** A list as an argument: null if there is none. */
function listIn(scope: Scope, values: Uint32Array | null): number {
    return values === null ? 0 : scope.struct("indices", indicesIn(scope, values));
}

/** See `Fairmesh.erase`. */
export function erase(host: Host, given: Mesh, erased: Selection, options: { clean?: number } = {}): EraseResult {
    known(options, ["clean"]);
    const mesh = new MeshIn(given);
    const listed = chosenTriangles(mesh, erased, "erased");
    const most = BigInt(whole(options.clean ?? 0, "clean"));
    return withMesh(host, mesh, (address, scope) =>
        resultOf(host.library, "fairmesh_erase", [address, listIn(scope, listed), most], (result) => {
            const { droppedCount, cleanedCount } = result.info();
            const keptTriangles = result.list("kept_triangles");
            return { triangles: kept(mesh, keptTriangles), keptTriangles, droppedCount, cleanedCount, loops: result.list("erased_loops") };
        }),
    );
}

/** See `Fairmesh.trimBoundary`. */
export function trimBoundary(host: Host, given: Mesh, most: number, options: { loops?: Indices; maxArea?: number } = {}): TrimResult {
    known(options, ["loops", "maxArea"]);
    const mesh = new MeshIn(given);
    const loops = options.loops === undefined ? null : indices(options.loops, "loops");
    if (options.maxArea !== undefined && !(real(options.maxArea, "maxArea") > 0)) throw new RangeError("maxArea: it has to be positive");
    const count = BigInt(whole(most, "most"));
    return withMesh(host, mesh, (address, scope) =>
        resultOf(host.library, "fairmesh_trim_boundary", [address, listIn(scope, loops), count, options.maxArea ?? 0], (result) => {
            const { droppedCount, droppedArea } = result.info();
            const keptTriangles = result.list("kept_triangles");
            return { triangles: kept(mesh, keptTriangles), keptTriangles, droppedCount, droppedArea };
        }),
    );
}

/** See `Fairmesh.carryOver`. */
export function carryOver(host: Host, given: Mesh, to: Points, among?: Selection | null, options: Watching = {}): Carried {
    known(options, WATCHING);
    const mesh = new MeshIn(given);
    const listed = among == null ? null : chosenTriangles(mesh, among, "among");
    const asked = points(to, "points");
    return watched(host, options, ({ progress, userData }) =>
        withMesh(host, mesh, (address, scope) => {
            const views = [listIn(scope, listed), scope.struct("points", numbersIn(scope, asked, 3))];
            return resultOf(host.library, "fairmesh_carry_over", [address, ...views, progress, userData], (result) => ({
                // UINT32_MAX, which says that there is none, becomes -1.
                triangles: Int32Array.from(result.list("carried_triangles")),
                corners: Int32Array.from(result.list("parents")),
                weights: result.vectors("parent_weights", asked.length / 3),
            }));
        }),
    );
}

/** See `Fairmesh.components`. */
export function components(host: Host, given: Mesh): Uint32Array {
    return withMesh(host, new MeshIn(given), (address) =>
        resultOf(host.library, "fairmesh_components", [address], (result) => result.list("triangle_components")),
    );
}

/** See `Fairmesh.selfIntersections`. */
export function selfIntersections(host: Host, given: Mesh, among?: Selection | null, options: Watching = {}): Uint32Array {
    known(options, WATCHING);
    const mesh = new MeshIn(given);
    const listed = among == null ? null : chosenTriangles(mesh, among, "among");
    return watched(host, options, ({ progress, userData }) =>
        withMesh(host, mesh, (address, scope) => {
            const given = [address, listIn(scope, listed), progress, userData];
            return resultOf(host.library, "fairmesh_self_intersections", given, (result) => result.list("intersections"));
        }),
    );
}

function remeshed(result: ResultHandle, mesh: MeshIn): RemeshResult {
    return {
        ...newMesh(result, mesh),
        freeVertices: result.list("free_vertices"),
        keptVertices: result.list("kept_vertices"),
        keptTriangles: result.list("kept_triangles"),
    };
}

/** See `Fairmesh.remesh`. */
export function remesh(host: Host, given: Mesh, free?: Selection | null, options: RemeshOptions = {}): RemeshResult {
    known(options, ["fixed", "freeTriangles", ...plainFields("remeshOptions"), ...WATCHING]);
    const mesh = new MeshIn(given);
    return watched(host, options, (told) =>
        withMesh(host, mesh, (address, scope) => {
            const how = withDefaults(scope, "remeshOptions", "fairmesh_remesh_options_init", options);
            write(scope.library, how, "remeshOptions", told);
            return resultOf(host.library, "fairmesh_remesh", [address, selectionIn(scope, mesh, free, options), how], (result) => remeshed(result, mesh));
        }),
    );
}

/** See `Fairmesh.refill`. */
export function refill(host: Host, given: Mesh, free?: Selection | null, options: RefillOptions = {}): RemeshResult {
    known(options, [...FAIRING, ...PATCH, "fixed", "freeTriangles"]);
    const mesh = new MeshIn(given);
    return watched(host, options, (told) =>
        withMesh(host, mesh, (address, scope) => {
            const region = selectionIn(scope, mesh, free, options);
            const fairing = fairingIn(scope, options, isSingle(mesh), mesh.vertexCount, told);
            return resultOf(host.library, "fairmesh_refill", [address, region, patchesIn(scope, options), fairing], (result) => remeshed(result, mesh));
        }),
    );
}
