/** Fairing in steps, in a worker. */

import type { Progress } from "./abi.js";
import type { Floats, Mesh, Selection } from "./arrays.js";
import type { Method, SolverMethod } from "./client.js";
import type { Budget, Edit, Frame } from "./edits.js";
import type { FairOptions, FairResult, Solver } from "./fairing.js";
import type { Report } from "./reports.js";

/** A call that a solver asks its worker for. */
export interface SolverCall {
    method: Method | SolverMethod;
    given: unknown[];
    options: Record<string, unknown> | null;
    progress?: ((progress: Progress) => unknown) | undefined;
    signal?: AbortSignal | undefined;
    cancel?: Int32Array | undefined;
}

/** The worker, as its solvers see it. It does the calls in their order. */
export interface Caller {
    /** Which worker it is; another number: the one before is gone, and its solvers with it. */
    generation(): number;
    call(call: SolverCall): Promise<unknown>;
}

/** What a long call can be handed. */
export interface Watched {
    progress?: ((progress: Progress) => unknown) | undefined;
    /** Aborts the call, as in `FairmeshWorker.fair`. */
    signal?: AbortSignal | undefined;
}

/** A frame with its surface. */
export interface ShownFrame<P extends Floats = Floats> extends Frame {
    /** All positions, in the precision given. */
    positions: P;
    /** The mean curvature, if asked for; NaN where no vertex is free. */
    meanCurvature: Float64Array | null;
}

/** What `WorkerSolver.show` tells besides. */
export interface Look {
    meanCurvature?: boolean;
}

type Setter = "setBoundaryNormals" | "setBoundaryCurvature" | "setTarget" | "setContinuity" | "edit";

/**
 * A `Solver` in a worker, made by `FairmeshWorker.solver`: the same calls, as promises, and `show` for a surface that follows a hand. Where the
 * worker had to be replaced (a run aborted without shared memory, a trap) the next call makes the solver anew, of what it was given, with
 * what was set since; iterations done are lost.
 */
export class WorkerSolver<P extends Floats = Floats> {
    readonly #caller: Caller;
    readonly #number: number;
    readonly #given: [mesh: Mesh, free: Selection | null, options: FairOptions];
    #generation: number;
    readonly #set = new Map<Setter, unknown[]>();
    #frame: Promise<unknown> | null = null;
    #newest: object = {};
    #isClosed = false;

    private constructor(caller: Caller, number: number, given: [Mesh, Selection | null, FairOptions]) {
        this.#caller = caller;
        this.#number = number;
        this.#given = given;
        this.#generation = caller.generation();
    }

    /** Made by `FairmeshWorker.solver`. @internal */
    static async open<P extends Floats>(
        caller: Caller,
        number: number,
        given: [Mesh, Selection | null, FairOptions],
        watched: Watched,
    ): Promise<WorkerSolver<P>> {
        const solver = new WorkerSolver<P>(caller, number, given);
        await solver.#open(watched);
        return solver;
    }

    #open(watched: Watched): Promise<unknown> {
        this.#generation = this.#caller.generation();
        const [mesh, free, options] = this.#given;
        return this.#caller.call({ method: "openSolver", given: [this.#number, mesh, free], options: { ...options }, ...watched });
    }

    async #call(name: string, given: unknown[] = [], watched: Watched = {}): Promise<unknown> {
        if (this.#isClosed) throw new Error("the solver is closed");
        const before: Promise<unknown>[] = [];
        const send = (what: string, arguments_: unknown[], by: Watched) =>
            this.#caller.call({ method: "callSolver", given: [this.#number, what, arguments_], options: null, ...by });
        if (this.#generation !== this.#caller.generation()) {
            before.push(this.#open({}));
            for (const [setter, arguments_] of this.#set) before.push(send(setter, arguments_, {}));
        }
        // All are sent at once: no other call comes between them.
        const all = await Promise.all([...before, send(name, given, watched)]);
        return all.at(-1);
    }

    async #setting(name: Setter, given: unknown[]): Promise<void> {
        await this.#call(name, given);
        this.#set.set(name, given);
    }

    /** See `Solver`, here and below. */
    run(iterations?: number, watched?: Watched): Promise<Report> {
        return this.#call("run", iterations === undefined ? [] : [iterations], watched) as Promise<Report>;
    }

    setBoundaryNormals(...given: Parameters<Solver["setBoundaryNormals"]>): Promise<void> {
        return this.#setting("setBoundaryNormals", given);
    }

    setBoundaryCurvature(...given: Parameters<Solver["setBoundaryCurvature"]>): Promise<void> {
        return this.#setting("setBoundaryCurvature", given);
    }

    setTarget(...given: Parameters<Solver["setTarget"]>): Promise<void> {
        return this.#setting("setTarget", given);
    }

    setContinuity(...given: Parameters<Solver["setContinuity"]>): Promise<void> {
        return this.#setting("setContinuity", given);
    }

    edit(edits: readonly Edit[]): Promise<void> {
        return this.#setting("edit", [edits]);
    }

    update(budget: Budget = {}): Promise<Frame> {
        return this.#call("update", [budget]) as Promise<Frame>;
    }

    finish(watched?: Watched): Promise<Report> {
        return this.#call("finish", [], watched) as Promise<Report>;
    }

    bulgeRange(watched?: Watched): Promise<{ low: number; high: number }> {
        return this.#call("bulgeRange", [], watched) as Promise<{ low: number; high: number }>;
    }

    positions(): Promise<P> {
        return this.#call("positions") as Promise<P>;
    }

    meanCurvature(): Promise<Float64Array> {
        return this.#call("meanCurvature") as Promise<Float64Array>;
    }

    report(): Promise<Report> {
        return this.#call("report") as Promise<Report>;
    }

    result(): Promise<FairResult<P>> {
        return this.#call("result") as Promise<FairResult<P>>;
    }

    /**
     * One frame with these edits: `edit`, `update` and the surface in one message. While a frame is under way only the newest call waits: the
     * promise of one that has given way is null. So it can be called at every movement of a pointer.
     */
    async show(edits: readonly Edit[], budget: Budget = {}, look: Look = {}): Promise<ShownFrame<P> | null> {
        const mine = (this.#newest = {});
        while (this.#frame !== null) {
            await this.#frame;
            if (this.#newest !== mine) return null;
        }
        const frame = this.#call("show", [edits, budget, look]) as Promise<ShownFrame<P>>;
        this.#frame = frame.then(
            () => undefined,
            () => undefined,
        );
        try {
            const shown = await frame;
            this.#set.set("edit", [edits]);
            return shown;
        } finally {
            this.#frame = null;
        }
    }

    /** Frees the solver's memory. Closing twice is allowed. */
    async close(): Promise<void> {
        if (this.#isClosed) return;
        this.#isClosed = true;
        if (this.#generation !== this.#caller.generation()) return;
        await this.#caller.call({ method: "closeSolver", given: [this.#number], options: null });
    }
}
