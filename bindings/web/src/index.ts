/** Fair surfaces on triangle meshes: regions get the smoothest shape that goes on from what is around them. */

import { VERSION_MAJOR, VERSION_MINOR, VERSION_PATCH } from "./abi.js";
import type { Indices, Mesh, Out, Points, Selection } from "./arrays.js";
import { compile, type Source } from "./compile.js";
import * as erasing from "./erase.js";
import { fair, type FairOptions, type FairResult, meanCurvature, memoryNeeded, Solver } from "./fairing.js";
import * as holes from "./holes.js";
import { Library, type StructName, within } from "./library.js";
import { defaults } from "./options.js";
import { Relays, type Watching } from "./progress.js";
import * as region from "./region.js";
import { type Telling, telling, type Told } from "./reports.js";
import * as rounding from "./round.js";
import type { PlainFillOptions, PlainOptions, PlainRemeshOptions, PlainRoundOptions } from "./abi.js";

export type * from "./abi.js";
export { compile, type CompiledModule, type Source } from "./compile.js";
export type { Floats, Indices, Mask, Mesh, Out, Points, Region, Selection, Triangles } from "./arrays.js";
export type { Carried, EraseResult, Left, RefillOptions, RemeshOptions, RemeshResult, TrimResult } from "./erase.js";
export { type ErrorDetails, FairmeshError, InputError, OutOfMemoryError, TrapError } from "./errors.js";
export { type FairOptions, type FairResult, Solver } from "./fairing.js";
export type { BridgeOptions, BridgeResult, FillOptions, FillResult, JoinSuggestion, Loop, LoopChoice, NewMesh, PatchOptions, Point } from "./holes.js";
export type { Budget, Bulge, Edit, Frame, Move, Tilt } from "./edits.js";
export type { ByVertex, FairingOptions, HowFar, Sharp } from "./options.js";
export type { ProgressCallback, Watching } from "./progress.js";
export type { RegionResult, RegionStep, Seed } from "./region.js";
export type { Crease, RoundOptions, RoundResult } from "./round.js";
export type { Component, LoopReport, Report, SharpEdge, Telling, Told } from "./reports.js";
export { createWorker, FairmeshWorker, type Handed, type WebWorker, type WorkerOptions } from "./client.js";
export { type Look, type ShownFrame, type Watched, WorkerSolver } from "./worker_solver.js";

/** The version of this package, which is that of the library in it. */
export const version = `${VERSION_MAJOR}.${VERSION_MINOR}.${VERSION_PATCH}`;

/** Loads the library. Each call makes a copy with a memory of its own; a module that is handed in is not compiled again. */
export async function load(source?: Source): Promise<Fairmesh> {
    const instance = await WebAssembly.instantiate((await compile(source)) as WebAssembly.Module);
    if (!("fairmesh_version_string" in instance.exports)) throw new Error("this is not the module of fairmesh");
    const library = new Library(instance);
    const told = library.string(library.invoke("fairmesh_version_string") >>> 0);
    if (told !== version) throw new Error(`the module is of version ${told}, this package is of version ${version}`);
    return new Fairmesh(library);
}

/** A copy of the library. Calls return when they are done: in pages, call from a worker, or let `createWorker` do so. */
export class Fairmesh {
    readonly #library: Library;
    readonly #relays: Relays;

    /** Made by `load`. @internal */
    constructor(library: Library) {
        this.#library = library;
        this.#relays = new Relays(library);
    }

    get #host() {
        return { library: this.#library, relays: this.#relays };
    }

    /** How many bytes its memory has: it grows, and never shrinks. */
    get memoryBytes(): number {
        return this.#library.buffer.byteLength;
    }

    /** Whether it has stopped for good, after a TrapError. */
    get isBroken(): boolean {
        return this.#library.isBroken;
    }

    /** Moves the free vertices until the surface between the fixed ones solves Delta_B H = 0, or what `target` asks. Without `free`, all that are not on the boundary. */
    fair<M extends Mesh>(mesh: M, free?: Selection | null, options?: FairOptions): FairResult<Out<M>> {
        return fair(this.#host, mesh, free, options) as FairResult<Out<M>>;
    }

    /** How much memory `fair` takes at most with these arguments, about, in bytes; at most 256 MB more are set aside. The module's memory is 4 GB. */
    memoryNeeded(mesh: Mesh, free?: Selection | null, options?: FairOptions): number {
        return memoryNeeded(this.#host, mesh, free, options);
    }

    /** The same of `fillHoles`. */
    memoryNeededToFill(mesh: Mesh, options?: holes.FillOptions): number {
        return holes.memoryNeededToFill(this.#host, mesh, options);
    }

    /** Fairing in steps. */
    solver(mesh: Mesh, free?: Selection | null, options?: FairOptions): Solver {
        return new Solver(this.#host, mesh, free, options);
    }

    /** The boundary loops of a mesh: holes and outer boundaries. With `roughness` each tells how rough the mesh is along it. */
    boundaryLoops(mesh: Mesh, options?: { roughness?: boolean }): holes.Loop[] {
        return holes.boundaryLoops(this.#host, mesh, options);
    }

    /** Fills holes: triangulates, refines and fairs each, or several together. Outer boundaries are filled only if they are named. */
    fillHoles<M extends Mesh>(mesh: M, options?: holes.FillOptions): holes.FillResult<Out<M>> {
        return holes.fillHoles(this.#host, mesh, options) as holes.FillResult<Out<M>>;
    }

    /** The loops that `fillHoles` with `join: "auto"` would give one patch, and why. */
    suggestJoins(mesh: Mesh, choice?: holes.LoopChoice): holes.JoinSuggestion[] {
        return holes.suggestJoins(this.#host, mesh, choice);
    }

    /** Connects two runs of boundary edges, each given by its vertices, by a strip that is tangent to the mesh at both, and faired. */
    bridge<M extends Mesh>(mesh: M, start: Indices, end: Indices, options?: holes.BridgeOptions): holes.BridgeResult<Out<M>> {
        return holes.bridge(this.#host, mesh, start, end, options) as holes.BridgeResult<Out<M>>;
    }

    /** Deletes triangles, and what would hang loose where they were; up to `clean` more that would spoil the boundary of a patch. */
    erase(mesh: Mesh, erased: Selection, options?: { clean?: number }): erasing.EraseResult {
        return erasing.erase(this.#host, mesh, erased, options);
    }

    /** Takes away no more than so many triangles at holes that would spoil a patch: slender ones, spikes, fins. */
    trimBoundary(mesh: Mesh, most: number, options?: { loops?: Indices; maxArea?: number }): erasing.TrimResult {
        return erasing.trimBoundary(this.#host, mesh, most, options);
    }

    /** Finds the nearest triangle of a mesh for each point: colours of what was erased go to what took its place. */
    carryOver(mesh: Mesh, points: Points, among?: Selection | null, options?: Watching): erasing.Carried {
        return erasing.carryOver(this.#host, mesh, points, among, options);
    }

    /** Per triangle the number of its component: triangles that hang together by edges. */
    components(mesh: Mesh): Uint32Array {
        return erasing.components(this.#host, mesh);
    }

    /** Triangulates a region anew, by edge lengths as beside it, without moving the surface. */
    remesh<M extends Mesh>(mesh: M, free?: Selection | null, options?: erasing.RemeshOptions): erasing.RemeshResult<Out<M>> {
        return erasing.remesh(this.#host, mesh, free, options) as erasing.RemeshResult<Out<M>>;
    }

    /** Deletes a region and fills what is left open, each component of it with one patch, which is fair already. */
    refill<M extends Mesh>(mesh: M, free?: Selection | null, options?: erasing.RefillOptions): erasing.RemeshResult<Out<M>> {
        return erasing.refill(this.#host, mesh, free, options) as erasing.RemeshResult<Out<M>>;
    }

    /** Rounds the sharp edges of a mesh: in place of each there is a blend, tangent to the faces beside it. Outside of the blends the surface stays where it is. */
    roundEdges<M extends Mesh>(mesh: M, options: rounding.RoundOptions): rounding.RoundResult<Out<M>> {
        return rounding.roundEdges(this.#host, mesh, options) as rounding.RoundResult<Out<M>>;
    }

    /** Mean curvature at every vertex, in 1 / length; NaN at vertices without triangles. */
    meanCurvature(mesh: Mesh): Float64Array {
        return meanCurvature(this.#host, mesh);
    }

    /** Pairs of triangles that intersect, one after the other, the smaller index first. */
    selfIntersections(mesh: Mesh, among?: Selection | null, options?: Watching): Uint32Array {
        return erasing.selfIntersections(this.#host, mesh, among, options);
    }

    /** Chooses triangles by place, distance and shape, step by step, beginning with none. */
    selectRegion(mesh: Mesh, steps: readonly region.RegionStep[], options?: Watching): region.RegionResult {
        return region.selectRegion(this.#host, mesh, steps, options);
    }

    /** Triangles that lie in a ball with all corners, as a mask; so are those below. */
    selectBall(mesh: Mesh, centre: holes.Point, radius: number): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "ball", point: centre, value: radius }]).mask;
    }

    /** Triangles that lie in a box with all corners. */
    selectBox(mesh: Mesh, low: holes.Point, high: holes.Point): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "box", point: low, vector: high }]).mask;
    }

    /** Triangles on the side of a plane that the normal points to. */
    selectHalfspace(mesh: Mesh, point: holes.Point, normal: holes.Point): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "half_space", point, vector: normal }]).mask;
    }

    /** Triangles all of whose corners are no further from a place than this along the surface. */
    selectGeodesic(mesh: Mesh, seed: region.Seed, radius: number): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "geodesic", seed, value: radius }]).mask;
    }

    /** Triangles that hang together with a place by edges. */
    selectComponent(mesh: Mesh, seed: region.Seed): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "component", seed }]).mask;
    }

    /** Triangles around a place up to edges at which the surface bends by more than an angle, in degrees. */
    selectPatch(mesh: Mesh, seed: region.Seed, angle = 30): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "patch", seed, value: angle }]).mask;
    }

    /** All of the bump or dent at a place: the one that reaches about as far as `size` along the surface, or at 0 the smallest. */
    selectBump(mesh: Mesh, seed: region.Seed, size = 0): Uint8Array {
        return this.selectRegion(mesh, [{ kind: "bump", seed, value: size }]).mask;
    }

    /** A region with the triangles that have a vertex in common with it, so often. */
    grow(mesh: Mesh, selection: Selection, rings = 1): Uint8Array {
        return region.spread(this.#host, mesh, selection, "grow", rings);
    }

    /** A region without the triangles that have a vertex in common with the rest, so often. */
    shrink(mesh: Mesh, selection: Selection, rings = 1): Uint8Array {
        return region.spread(this.#host, mesh, selection, "shrink", rings);
    }

    /** The fairing options that are numbers and names, with their defaults, for user interfaces; likewise those below. */
    defaultOptions(): Required<PlainOptions> {
        return this.#defaults<Required<PlainOptions>>("options", "fairmesh_options_init");
    }

    defaultFillOptions(): Required<PlainFillOptions> {
        return this.#defaults<Required<PlainFillOptions>>("fillOptions", "fairmesh_fill_options_init");
    }

    defaultRemeshOptions(): Required<PlainRemeshOptions> {
        return this.#defaults<Required<PlainRemeshOptions>>("remeshOptions", "fairmesh_remesh_options_init");
    }

    defaultRoundOptions(): Required<PlainRoundOptions> {
        return this.#defaults<Required<PlainRoundOptions>>("roundOptions", "fairmesh_round_options_init");
    }

    /** What one of the library's answers means: English, begins in lower case. */
    describe(kind: Told, name: string): Telling {
        return telling(this.#library, kind, name);
    }

    #defaults<T>(struct: StructName, init: string): T {
        return within(this.#library, (scope) => defaults(this.#library, scope, struct, init)) as T;
    }
}
