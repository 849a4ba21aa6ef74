/** Boundary loops, filling of holes, bridges, and which loops to join. */

import * as abi from "./abi.js";
import { type Floats, type Indices, indices, indicesIn, type Mesh, MeshIn, numbers, shown } from "./arrays.js";
import { bytesOf, type Host, isSingle, watched } from "./fairing.js";
import { plainFields, type Scope, type Values, within, write } from "./library.js";
import { FAIRING, type FairingOptions, fairingIn, fieldOf, known, real, whole, withDefaults, writeRows } from "./options.js";
import { type LoopReport, type Report, type ResultHandle, resultOf } from "./reports.js";

/** A boundary loop of a mesh. Angles are in degrees. */
export interface Loop extends abi.Loop {
    /** The vertices in the direction of triangles that fill it. */
    vertices: Uint32Array;
    /** Vertices that belong to another loop, too. */
    touching: Uint32Array;
}

/** Three numbers. */
export type Point = readonly [number, number, number] | readonly number[] | Float32Array | Float64Array;

/** Which holes are filled, or looked at: those that meet every bound. */
export interface LoopChoice {
    /** These loops only, as `boundaryLoops` numbers them, outer boundaries included; bounds are not read then. "all": all holes. */
    loops?: Indices | "all" | undefined;
    /** Holes of more edges stay open, longer ones, those of a larger area, and with a longer diagonal of the bounding box. */
    maxEdges?: number | undefined;
    maxLength?: number | undefined;
    maxArea?: number | undefined;
    maxDiagonal?: number | undefined;
    /** All but so many holes, the longest. Default 0. */
    exceptLongest?: number | undefined;
    /** Only holes of these components of the mesh, as `components` numbers them. */
    ofComponents?: Indices | undefined;
    /** Only holes whose vertices all lie in a ball or a box. */
    within?: { centre: Point; radius: number } | { low: Point; high: Point } | undefined;
}

/** How patches are made. */
export type PatchOptions = Omit<abi.PlainFillOptions, "onlyListed" | (typeof OF_HOLES)[number]>;

/** Options of `fillHoles`. */
export interface FillOptions extends FairingOptions, LoopChoice, Omit<abi.PlainFillOptions, "onlyListed" | "relaxRim">, abi.RowsFillOptions {
    /** Rings of vertices around a hole that may move, for boundaries that are noise; "auto": as many as are advised. Default: 0. */
    relaxRim?: "auto" | number | undefined;
    /** Which loops get one patch together: "none" (default); groups of them; or "auto", as `suggestJoins` finds them. */
    join?: "none" | "auto" | readonly Indices[] | undefined;
}

/** Options of `bridge`. */
export interface BridgeOptions extends FairingOptions, PatchOptions, abi.PlainBridgeOptions {}

/** A mesh with new vertices at the end of its arrays. */
export interface NewMesh<P extends Floats = Floats> {
    positions: P;
    triangles: Uint32Array;
    /** The last so many of the vertices, and of the triangles, are new. */
    newVertexCount: number;
    newTriangleCount: number;
    /** Whether there is nothing to be said of the result: what was to be faired converged without reservation, holes that were to be filled
     *  are, and not all loops were passed over as outer boundaries. */
    isSuccess: boolean;
    /** Per new vertex the three vertices of the mesh given that it comes from, and their weights, whose sum is 1. */
    parents: Uint32Array;
    parentWeights: Float64Array;
}

/** A mesh with filled holes. Vertices and triangles given keep their numbers and bits (but for `relaxRim`); new ones follow. */
export interface FillResult<P extends Floats = Floats> extends NewMesh<P> {
    /** What became of each loop. */
    loops: LoopReport[];
}

/** A mesh with a bridge. */
export interface BridgeResult<P extends Floats = Floats> extends NewMesh<P>, abi.BridgeReport {
    /** What became of the strip, and of the holes beside it, if they were to be filled. */
    strip: LoopReport;
    rest: LoopReport[];
    /** The fairing of all new vertices together, if holes were filled. */
    whole: Report | null;
    /** The vertices that the strip begins and ends at, in the direction in which its triangles run through them. */
    chains: [Uint32Array, Uint32Array];
    /** The new vertices on its two sides: from the first chain to the second, and back. */
    sides: [Uint32Array, Uint32Array];
}

/** Loops whose joint patch bends less than patches of their own would. */
export interface JoinSuggestion extends abi.JoinSuggestion {
    /** As `boundaryLoops` numbers them, ascending. */
    loops: Uint32Array;
}

/** A new mesh, out of a result. */
export function newMesh(result: ResultHandle, mesh: MeshIn): NewMesh {
    const info = result.info();
    return {
        positions: result.positions(mesh.newPositions(info.vertexCount)),
        triangles: result.triangles(info.triangleCount),
        newVertexCount: info.newVertexCount,
        newTriangleCount: info.newTriangleCount,
        isSuccess: Boolean(info.isSuccess),
        parents: result.list("parents"),
        parentWeights: result.vectors("parent_weights", info.newVertexCount),
    };
}

/** Three numbers of a point. */
export function point(given: unknown, name: string): number[] {
    const values = numbers(given, name);
    if (values.length !== 3) throw new RangeError(`${name}: three numbers are needed, not ${values.length}`);
    return [...values];
}

const CHOICE = ["loops", "maxEdges", "maxLength", "maxArea", "maxDiagonal", "exceptLongest", "ofComponents", "within"];
/** Options of hole filling that say which holes, or are about the mesh around them. */
const OF_HOLES = ["maxEdges", "relaxRim", "relaxWithin"] as const;
const FILL: readonly string[] = plainFields("fillOptions").filter((name) => name !== "onlyListed");
/** The names of the options of patches. */
export const PATCH: readonly string[] = FILL.filter((name) => !(OF_HOLES as readonly string[]).includes(name));

/** The names of all options of filling. */
const FILLING: readonly string[] = [...FAIRING, ...CHOICE, ...FILL, ...Object.keys(abi.rows.fillOptions), "join"];

/** For the library, 0 is no bound; here it is one that nothing meets. */
function bound(given: unknown, name: string): number {
    return real(given, name) || Number.MIN_VALUE;
}

function place(given: NonNullable<LoopChoice["within"]>): Values {
    if (typeof given === "object" && given !== null && "centre" in given) {
        return { kind: "ball", centre: point(given.centre, "within"), radius: real(given.radius, "within") };
    }
    if (typeof given !== "object" || given === null || !("low" in given)) {
        throw new TypeError("within: a ball { centre, radius } or a box { low, high } is needed");
    }
    return { kind: "box", low: point(given.low, "within"), high: point(given.high, "within") };
}

function joinIn(scope: Scope, given: NonNullable<FillOptions["join"]>): Values {
    if (given === "none" || given === "auto") return { kind: given };
    if (!Array.isArray(given)) throw new TypeError(`join: ${shown(given)} is neither "none" nor "auto" nor groups of loops`);
    const groups = (given as readonly Indices[]).map((group) => indices(group, "join"));
    const starts = new Uint32Array(groups.length);
    groups.slice(0, -1).forEach((group, k) => (starts[k + 1] = starts[k]! + group.length));
    const loops = Uint32Array.from(groups.flatMap((group) => [...group]));
    return { kind: "groups", loops: indicesIn(scope, loops), starts: indicesIn(scope, starts) };
}

/** Which loops; and with them the plain options of filling. */
function fillIn(scope: Scope, given: LoopChoice & Omit<FillOptions, keyof FairingOptions>): number {
    const at = withDefaults(scope, "fillOptions", "fairmesh_fill_options_init", given);
    const set = (values: Values) => write(scope.library, at, "fillOptions", values);
    if (given.join !== undefined) set({ join: joinIn(scope, given.join) });
    const isGrouped = Array.isArray(given.join);
    if (given.loops === undefined) {
        set({ onlyListed: Number(isGrouped) });
    } else if (given.loops !== "all") {
        const listed = indices(given.loops, "loops");
        if (listed.length === 0 && !isGrouped) throw new RangeError("loops: no loop is named; without it all holes are filled");
        set({ onlyListed: 1, loops: indicesIn(scope, listed) });
    }
    const filter: Record<string, unknown> = {};
    for (const name of ["maxLength", "maxArea", "maxDiagonal"] as const) if (given[name] !== undefined) filter[name] = bound(given[name], name);
    if (given.exceptLongest !== undefined) filter["exceptLongest"] = whole(given.exceptLongest, "exceptLongest");
    if (given.ofComponents !== undefined) {
        const named = indices(given.ofComponents, "ofComponents");
        if (named.length === 0) throw new RangeError("ofComponents: no component is named");
        filter["components"] = indicesIn(scope, named);
    }
    if (given.within !== undefined) filter["within"] = place(given.within);
    write(scope.library, fieldOf(at, "fillOptions", "filter"), "loopFilter", filter);
    writeRows(scope, at, "fillOptions", given);
    return at;
}

/** How patches are made, for functions that do not choose loops. */
export function patchesIn(scope: Scope, given: PatchOptions): number {
    return fillIn(scope, Object.fromEntries(PATCH.map((name) => [name, given[name as keyof PatchOptions]])));
}

/** See `Fairmesh.boundaryLoops`. */
export function boundaryLoops(host: Host, given: Mesh, options: { roughness?: boolean } = {}): Loop[] {
    known(options, ["roughness"]);
    const mesh = new MeshIn(given);
    const name = options.roughness ? "fairmesh_rim_roughness" : "fairmesh_boundary_loops";
    return withMesh(host, mesh, (address) =>
        resultOf(host.library, name, [address], (result) =>
            Array.from({ length: result.info().loopCount }, (_, k) => ({
                ...result.struct<abi.Loop>("fairmesh_result_loop", "loop", k),
                vertices: result.list("loop_vertices", k),
                touching: result.list("loop_touching", k),
            })),
        ),
    );
}

/** See `Fairmesh.suggestJoins`. */
export function suggestJoins(host: Host, given: Mesh, choice: LoopChoice = {}): JoinSuggestion[] {
    known(choice, CHOICE);
    const mesh = new MeshIn(given);
    return withMesh(host, mesh, (address, scope) =>
        resultOf(host.library, "fairmesh_suggest_joins", [address, fillIn(scope, choice)], (result) =>
            Array.from({ length: result.info().loopCount }, (_, k) => ({
                ...result.struct<abi.JoinSuggestion>("fairmesh_result_suggestion", "joinSuggestion", k),
                loops: result.list("joined_loops", k),
            })),
        ),
    );
}

/** See `Fairmesh.memoryNeededToFill`. */
export function memoryNeededToFill(host: Host, given: Mesh, options: FillOptions = {}): number {
    known(options, FILLING);
    const mesh = new MeshIn(given);
    return withMesh(host, mesh, (address, scope) => {
        const fairing = fairingIn(scope, options, isSingle(mesh), mesh.vertexCount, { progress: 0, userData: 0 });
        return bytesOf(host, scope, [address, 0, fillIn(scope, options), fairing]);
    });
}

/** See `Fairmesh.fillHoles`. */
export function fillHoles(host: Host, given: Mesh, options: FillOptions = {}): FillResult {
    known(options, FILLING);
    const mesh = new MeshIn(given);
    return watched(host, options, (told) =>
        withMesh(host, mesh, (address, scope) => {
            const fairing = fairingIn(scope, options, isSingle(mesh), mesh.vertexCount, told);
            return resultOf(host.library, "fairmesh_fill_holes", [address, fillIn(scope, options), fairing], (result) => ({
                ...newMesh(result, mesh),
                loops: Array.from({ length: result.info().loopCount }, (_, k) => result.loopReport(k)),
            }));
        }),
    );
}

/** See `Fairmesh.bridge`. */
export function bridge(host: Host, given: Mesh, start: Indices, end: Indices, options: BridgeOptions = {}): BridgeResult {
    known(options, [...FAIRING, ...PATCH, ...plainFields("bridgeOptions")]);
    if (options.width === 0) throw new RangeError("width: it has to be positive");
    const mesh = new MeshIn(given);
    const ends = [indices(start, "start"), indices(end, "end")];
    return watched(host, options, (told) =>
        withMesh(host, mesh, (address, scope) => {
            const chains = ends.map((each) => scope.struct("indices", indicesIn(scope, each)));
            const how = withDefaults(scope, "bridgeOptions", "fairmesh_bridge_options_init", options);
            const fairing = fairingIn(scope, options, isSingle(mesh), mesh.vertexCount, told);
            return resultOf(host.library, "fairmesh_bridge", [address, ...chains, how, patchesIn(scope, options), fairing], (result) =>
                bridged(result, mesh),
            );
        }),
    );
}

function bridged(result: ResultHandle, mesh: MeshIn): BridgeResult {
    const report = result.struct<abi.BridgeReport>("fairmesh_result_bridge", "bridgeReport");
    return {
        ...newMesh(result, mesh),
        ...report,
        strip: result.loopReport(0),
        rest: Array.from({ length: report.restCount }, (_, k) => result.loopReport(1 + k)),
        whole: report.hasWhole ? result.report(1 + report.restCount) : null,
        chains: [result.list("bridge_chain", 0), result.list("bridge_chain", 1)],
        sides: [result.list("bridge_side", 0), result.list("bridge_side", 1)],
    };
}

/** Something with a mesh in the library's memory. */
export function withMesh<T>(host: Host, mesh: MeshIn, work: (address: number, scope: Scope) => T): T {
    return within(host.library, (scope) => work(mesh.struct(scope), scope));
}
