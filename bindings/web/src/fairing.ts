/** Fairing: whole, and in steps. */

import type * as abi from "./abi.js";
import { enums } from "./abi.js";
import { type Floats, type Mesh, MeshIn, type Region, type Selection, selectionIn } from "./arrays.js";
import { type Argument, type FunctionName, type Library, NO_ELEMENT, type Scope, type Values, within } from "./library.js";
import { curvatureIn, FAIRING, type FairingOptions, fairingIn, type HowFar, howFar, known, loopsIn, normalsIn, targetIn, whole } from "./options.js";
import type { Relays, Watching } from "./progress.js";
import { filledIn, readInto, type Report, type ResultHandle, resultOf } from "./reports.js";
import { type Budget, budgetIn, type Edit, editsIn, type Frame } from "./edits.js";
import { FairmeshError } from "./errors.js";

/** What all calls need: a copy of the module, and its callbacks. */
export interface Host {
    readonly library: Library;
    readonly relays: Relays;
}

/** Options of `fair` and `Solver`. */
export interface FairOptions extends FairingOptions, Region {}

/** A faired mesh. */
export interface FairResult<P extends Floats = Floats> {
    /** All positions, in the precision given; fixed vertices keep their bits. Usable with every outcome. */
    positions: P;
    /** How it ended; the same as `report.outcome`. */
    outcome: abi.Outcome;
    report: Report;
    /** Mean curvature per vertex, in 1 / length: negative on a sphere with outward normals. NaN outside the region. */
    meanCurvature: Float64Array;
    /** Gaussian curvature per vertex, in 1 / length^2. NaN where no vertex is free. */
    gaussianCurvature: Float64Array;
    /** The fixed vertices around and in the region, ascending, and the unit normals that were used there. */
    boundaryVertices: Uint32Array;
    boundaryNormals: Float64Array;
    /** Triangles that are flipped or have an angle below one degree, where the outcome is about them. */
    poorTriangles: Uint32Array;
    flippedTriangles: Uint32Array;
    needles: Uint32Array;
    /** Boundary vertices whose normal contradicts the surface or its neighbours'. */
    suspiciousNormals: Uint32Array;
    /** Boundary vertices where the surface has a crease, where the outcome is about them. */
    creasedVertices: Uint32Array;
    /** Pairs of triangles that intersect, one after the other, the smaller index first. */
    intersections: Uint32Array;
}

/** Runs something whose callback may throw; what it threw comes first. */
export function watched<T>(host: Host, given: Watching, run: (told: { progress: number; userData: number }) => T): T {
    const told = host.relays.add(given);
    try {
        const made = run(told);
        host.relays.end(told.userData);
        return made;
    } catch (why) {
        host.relays.end(told.userData);
        throw why;
    } finally {
        host.relays.remove(told.userData);
    }
}

/** The precision that a mesh is given in. */
export function isSingle(mesh: MeshIn): boolean {
    return mesh.positions instanceof Float32Array;
}

function faired(result: ResultHandle, mesh: MeshIn): FairResult {
    const report = result.report();
    const boundaryVertices = result.list("boundary_vertices");
    const count = mesh.vertexCount;
    return {
        positions: result.positions(mesh.newPositions()),
        outcome: report.outcome,
        report,
        meanCurvature: result.scalars("mean_curvature", count),
        gaussianCurvature: result.scalars("gaussian_curvature", count),
        boundaryVertices,
        boundaryNormals: result.vectors("boundary_normals", boundaryVertices.length),
        poorTriangles: result.list("poor_triangles"),
        flippedTriangles: result.list("flipped_triangles"),
        needles: result.list("needles"),
        suspiciousNormals: result.list("suspicious_normals"),
        creasedVertices: result.list("creased_vertices"),
        intersections: result.list("intersections"),
    };
}

const OPTIONS = [...FAIRING, "fixed", "freeTriangles"];

/** The arguments that `fair` and `Solver` begin with. */
function asked(scope: Scope, mesh: MeshIn, free: Selection | null | undefined, options: FairOptions, told: { progress: number; userData: number }): Argument[] {
    return [
        mesh.struct(scope),
        selectionIn(scope, mesh, free, options),
        fairingIn(scope, options, isSingle(mesh), mesh.vertexCount, told),
    ];
}

/** See `Fairmesh.fair`. */
export function fair(host: Host, given: Mesh, free: Selection | null | undefined, options: FairOptions = {}): FairResult {
    known(options, OPTIONS);
    const mesh = new MeshIn(given);
    return watched(host, options, (told) =>
        within(host.library, (scope) =>
            resultOf(host.library, "fairmesh_fair", [...asked(scope, mesh, free, options, told), 0, 0], (result) => faired(result, mesh)),
        ),
    );
}

/** See `Fairmesh.memoryNeeded`. */
export function memoryNeeded(host: Host, given: Mesh, free: Selection | null | undefined, options: FairOptions = {}): number {
    known(options, OPTIONS);
    const mesh = new MeshIn(given);
    return within(host.library, (scope) => {
        const [at, selection, fairing] = asked(scope, mesh, free, options, { progress: 0, userData: 0 });
        return bytesOf(host, scope, [at!, selection!, 0, fairing!]);
    });
}

/** What `fairmesh_memory_needed` answers. */
export function bytesOf(host: Host, scope: Scope, given: readonly Argument[]): number {
    const bytes = scope.bytes(8);
    host.library.call("fairmesh_memory_needed", ...given, bytes);
    return Number(host.library.view.getBigUint64(bytes, true));
}

/** See `Fairmesh.meanCurvature`. */
export function meanCurvature(host: Host, given: Mesh): Float64Array {
    const mesh = new MeshIn(given);
    return within(host.library, (scope) =>
        readInto(host.library, new Float64Array(mesh.vertexCount), 1, "scalarsOut", (out) =>
            host.library.call("fairmesh_mean_curvature", mesh.struct(scope), out),
        ),
    );
}

/** Frees what was forgotten to be closed; a net only. */
const forgotten = new FinalizationRegistry<() => void>((free) => free());

/**
 * Fairing in steps: run some iterations, look, change the normals, the continuity or the target, go on. For a live surface, `edit` the
 * boundary, show a frame after each `update`, and `finish`.
 *
 * Everything is copied when the solver is made. Runs without changes find what `fair` finds, to the last bit. It holds memory until it
 * is closed.
 */
export class Solver {
    readonly #host: Host;
    readonly #mesh: MeshIn;
    readonly #watching: Watching;
    readonly #told: { progress: number; userData: number };
    #address: number;

    /** Made by `Fairmesh.solver`. @internal */
    constructor(host: Host, given: Mesh, free: Selection | null | undefined, options: FairOptions = {}) {
        known(options, OPTIONS);
        this.#host = host;
        this.#mesh = new MeshIn(given);
        this.#watching = { progress: options.progress, cancel: options.cancel };
        const told = host.relays.add(this.#watching);
        this.#told = told;
        const { library, relays } = host;
        try {
            this.#address = within(library, (scope) => {
                const slot = scope.bytes(4);
                library.call("fairmesh_solver_new", ...asked(scope, this.#mesh, free, options, told), slot);
                return library.view.getUint32(slot, true);
            });
            relays.end(told.userData);
        } catch (why) {
            relays.end(told.userData);
            relays.remove(told.userData);
            throw why;
        }
        const address = this.#address;
        forgotten.register(this, () => free_(library, relays, address, told.userData), this);
    }

    #call(name: FunctionName, ...given: Argument[]): void {
        if (this.#address === 0) throw new FairmeshError("the solver is closed", { status: "bad_handle" });
        this.#host.library.call(name, this.#address, ...given);
    }

    #set(setting: keyof typeof enums.setting, values: (scope: Scope) => Values): void {
        within(this.#host.library, (scope) => this.#call("fairmesh_solver_set", enums.setting[setting], scope.struct("options", values(scope))));
    }

    /** Runs at most so many nonlinear iterations of each component, at least one; without a number, to the end. */
    run(iterations?: number): Report {
        const count = iterations === undefined ? NO_ELEMENT : BigInt(whole(iterations, "iterations"));
        return this.#reported(() => this.#call("fairmesh_solver_run", count, 0));
    }

    #reported(run: () => void): Report {
        try {
            run();
        } finally {
            this.#host.relays.end(this.#told.userData);
        }
        return this.report;
    }

    #result<T>(use: (result: ResultHandle) => T): T {
        if (this.#address === 0) throw new FairmeshError("the solver is closed", { status: "bad_handle" });
        return resultOf(this.#host.library, "fairmesh_solver_result", [this.#address], use);
    }

    /** Asks for other boundary normals from now on, as in `fair`. The next run starts at the surface at hand, here and below. */
    setBoundaryNormals(normals: NonNullable<FairingOptions["boundaryNormals"]>): void {
        this.#set("boundary_normals", (scope) => ({ boundaryNormals: normalsIn(scope, normals, this.#mesh.vertexCount) }));
    }

    setBoundaryCurvature(curvature: NonNullable<FairingOptions["boundaryCurvature"]>): void {
        this.#set("boundary_curvature", (scope) => ({ boundaryCurvature: curvatureIn(scope, curvature, this.#mesh.vertexCount) }));
    }

    setTarget(target: NonNullable<FairingOptions["target"]>): void {
        this.#set("target", () => ({ target: targetIn(target) }));
    }

    setContinuity(continuity: HowFar, loops: NonNullable<FairingOptions["loopContinuity"]> = []): void {
        const asked = howFar(continuity, "continuity");
        this.#set("continuity", (scope) => ({ continuity: asked, loopContinuity: loopsIn(scope, loops) }));
    }

    /**
     * Asks for these changes of the boundary. They take the place of the edits before, and are all relative to what was asked otherwise: no
     * edits, and nothing is changed of that. The next update or run starts at the surface at hand.
     */
    edit(edits: readonly Edit[]): void {
        within(this.#host.library, (scope) => this.#call("fairmesh_solver_edit", ...editsIn(scope, edits)));
    }

    /** One frame: goes on until the surface is settled, or the limit is used up; `positions` has it. */
    update(limit: Budget = {}): Frame {
        const { library } = this.#host;
        const told = within(library, (scope) => {
            const address = budgetIn(scope, limit);
            return filledIn(library, "frame", (at) => this.#call("fairmesh_solver_update", address, at));
        }) as unknown as abi.Frame;
        return { step: told.step, evaluations: told.evaluations, isSettled: told.isSettled !== 0 };
    }

    /** The converged surface with its report, checked: that of `fair` with what is asked and edited, to the tolerance. */
    finish(): Report {
        return this.#reported(() => this.#call("fairmesh_solver_finish", 0));
    }

    /** Between which amounts of a bulge, beside the other edits in force, sound surfaces are found. It costs some tens of frames. */
    bulgeRange(): { low: number; high: number } {
        const { userData } = this.#told;
        try {
            const { low, high } = filledIn(this.#host.library, "bulgeRange", (at) => this.#call("fairmesh_solver_bulge_range", at)) as unknown as abi.BulgeRange;
            return { low, high };
        } finally {
            this.#host.relays.end(userData);
        }
    }

    /** All positions as they stand, in the precision given; before the first run or update, those given. */
    get positions(): Floats {
        return readInto(this.#host.library, this.#mesh.newPositions(), 3, "pointsOut", (out) => this.#call("fairmesh_solver_positions", out));
    }

    /** The mean curvature of the surface as it stands; NaN where no vertex is free. */
    get meanCurvature(): Float64Array {
        return this.#result((result) => result.scalars("mean_curvature", this.#mesh.vertexCount));
    }

    /** The report of the last run; before the first one, of the input. */
    get report(): Report {
        return this.#result((result) => result.report());
    }

    /** Everything that is known of the surface as it stands. */
    result(): FairResult {
        return this.#result((result) => faired(result, this.#mesh));
    }

    /** Frees the solver's memory. Closing twice is allowed; while it runs, it is refused. */
    close(): void {
        if (this.#address === 0) return;
        if (!free_(this.#host.library, this.#host.relays, this.#address, this.#told.userData)) {
            throw new FairmeshError("the solver is in use", { status: "busy" });
        }
        forgotten.unregister(this);
        this.#address = 0;
    }
}

/** Whether a solver could be freed. */
function free_(library: Library, relays: Relays, address: number, number: number): boolean {
    if (!library.isBroken && library.invoke("fairmesh_solver_free", address) !== 0) return false;
    relays.remove(number);
    return true;
}
