/** The library in a worker: the same calls, as promises. */

import type { Progress } from "./abi.js";
import type { Indices, Mesh, Out, Points, Selection } from "./arrays.js";
import { compile, type CompiledModule, type Source } from "./compile.js";
import { received, type SentError, TrapError } from "./errors.js";
import type { Carried, RefillOptions, RemeshOptions, RemeshResult } from "./erase.js";
import type { FairOptions, FairResult } from "./fairing.js";
import type { BridgeOptions, BridgeResult, FillOptions, FillResult } from "./holes.js";
import type { Fairmesh } from "./index.js";
import { newWorker, type Port, webPort } from "./ports.js";
import type { Watching } from "./progress.js";
import type { RegionResult, RegionStep } from "./region.js";
import type { RoundOptions, RoundResult } from "./round.js";
import { type Caller, type SolverCall, WorkerSolver } from "./worker_solver.js";

/** What a call in a worker can be handed besides its options. */
export interface Handed {
    /**
     * Aborts the call: the promise is refused with the signal's reason. Where memory can be shared (pages that are cross-origin isolated,
     * Node) the run ends before its next iteration; elsewhere the worker is ended and a new one is started.
     */
    signal?: AbortSignal | undefined;
    /** Hands the arrays of the mesh over in place of copying them: they are empty afterwards. */
    transfer?: boolean | undefined;
}

/** Calls that take long, and can be watched. */
interface LongCalls {
    fair<M extends Mesh>(mesh: M, free?: Selection | null, options?: FairOptions & Handed): Promise<FairResult<Out<M>>>;
    fillHoles<M extends Mesh>(mesh: M, options?: FillOptions & Handed): Promise<FillResult<Out<M>>>;
    bridge<M extends Mesh>(mesh: M, start: Indices, end: Indices, options?: BridgeOptions & Handed): Promise<BridgeResult<Out<M>>>;
    refill<M extends Mesh>(mesh: M, free?: Selection | null, options?: RefillOptions & Handed): Promise<RemeshResult<Out<M>>>;
    remesh<M extends Mesh>(mesh: M, free?: Selection | null, options?: RemeshOptions & Handed): Promise<RemeshResult<Out<M>>>;
    roundEdges<M extends Mesh>(mesh: M, options: RoundOptions & Handed): Promise<RoundResult<Out<M>>>;
    carryOver(mesh: Mesh, points: Points, among?: Selection | null, options?: Watching & Handed): Promise<Carried>;
    selfIntersections(mesh: Mesh, among?: Selection | null, options?: Watching & Handed): Promise<Uint32Array>;
    selectRegion(mesh: Mesh, steps: readonly RegionStep[], options?: Watching & Handed): Promise<RegionResult>;
}

/** Where the options of the long calls are among their arguments. */
const LONG = {
    fair: 2,
    fillHoles: 1,
    bridge: 3,
    refill: 2,
    remesh: 2,
    roundEdges: 1,
    carryOver: 3,
    selfIntersections: 2,
    selectRegion: 2,
} as const satisfies Record<keyof LongCalls, number>;

const SHORT = [
    ...(["boundaryLoops", "suggestJoins", "erase", "trimBoundary", "components", "meanCurvature", "memoryNeeded", "memoryNeededToFill"] as const),
    ...(["selectBall", "selectBox", "selectHalfspace", "selectGeodesic", "selectComponent"] as const),
    ...(["selectPatch", "selectBump", "grow", "shrink", "defaultOptions", "defaultFillOptions", "defaultRemeshOptions", "defaultRoundOptions", "describe"] as const),
];

/** The other calls. */
type ShortCalls = { [K in (typeof SHORT)[number]]: (...given: Parameters<Fairmesh[K]>) => Promise<ReturnType<Fairmesh[K]>> };

/** What can be called in a worker. */
export type Method = keyof LongCalls | keyof ShortCalls;

/** Calls by which solvers live in the worker: their number comes first. */
export type SolverMethod = "openSolver" | "callSolver" | "closeSolver";

/** A call, as it is sent. */
export interface Request {
    id: number;
    module: CompiledModule;
    method: Method | SolverMethod;
    given: unknown[];
    /** Of the long calls, and of a solver that is made; what watches them stays here. */
    options: Record<string, unknown> | null;
    isWatched: boolean;
    cancel?: Int32Array | undefined;
}

type Answer = { id: number } & ({ progress: Progress } | { result: unknown } | { error: SentError });

interface Job {
    request: Request;
    transfer: Transferable[];
    progress: ((progress: Progress) => unknown) | undefined;
    signal: AbortSignal | undefined;
    done: (result: unknown) => void;
    failed: (why: unknown) => void;
}

/** A call, as it is asked for. */
interface Call extends SolverCall {
    transfer: Transferable[];
}

/** A `Worker` of the web, where TypeScript knows pages. */
export type WebWorker = typeof globalThis extends { Worker: new (...given: never[]) => infer W } ? W : never;

/** How a worker is made. */
export interface WorkerOptions {
    /** The module, if not that of this package. */
    source?: Source | undefined;
    /**
     * Makes a worker that runs worker.js of this package, where the file cannot be had by its address: in a page that has it inside. Called again
     * where a worker has to be replaced.
     */
    start?: (() => WebWorker) | undefined;
}

/** Starts a worker with the library in it. */
export async function createWorker({ source, start }: WorkerOptions = {}): Promise<FairmeshWorker> {
    const another = start === undefined ? newWorker : () => Promise.resolve(webPort(start()));
    return new FairmeshWorker(await compile(source), await another(), another);
}

export interface FairmeshWorker extends LongCalls, ShortCalls {}

/**
 * The library in a worker, which does one call after the other. All functions of `Fairmesh` are there as promises, with
 * the same arguments, results and errors; what the progress callback returns is not looked at.
 */
export class FairmeshWorker {
    readonly #module: CompiledModule;
    readonly #another: () => Promise<Port>;
    /** Which worker it is: solvers of an earlier one are gone. */
    #generation = 0;
    #port: Promise<Port> | null;
    #running: Job | null = null;
    readonly #waiting: Job[] = [];
    #last = 0;
    #isClosed = false;

    /** Made by `createWorker`. @internal */
    constructor(module: CompiledModule, port: Port, another: () => Promise<Port>) {
        this.#module = module;
        this.#another = another;
        this.#port = Promise.resolve(this.#listening(port));
    }

    static {
        for (const method of [...SHORT, ...(Object.keys(LONG) as (keyof LongCalls)[])]) {
            Object.defineProperty(this.prototype, method, {
                value(this: FairmeshWorker, ...given: unknown[]) {
                    return this.#call(method, given);
                },
            });
        }
    }

    /** Fairing in steps, in the worker. */
    async solver<M extends Mesh>(mesh: M, free?: Selection | null, options: FairOptions & Handed = {}): Promise<WorkerSolver<Out<M>>> {
        const caller: Caller = {
            generation: () => this.#generation,
            call: (call: SolverCall) => this.#send({ ...call, transfer: [] }),
        };
        const { progress, signal, transfer: _, ...plain } = options;
        return WorkerSolver.open(caller, ++this.#last, [mesh, free ?? null, plain], { progress, signal });
    }

    #listening(port: Port): Port {
        port.listen(
            (answer: Answer) => this.#answered(answer),
            (why) => this.#end(port, why),
        );
        port.hold(false);
        return port;
    }

    #call(method: Method, given: unknown[]): Promise<unknown> {
        const place: number | undefined = (LONG as Partial<Record<Method, number>>)[method];
        if (place === undefined) return this.#send({ method, given, options: null, transfer: [] });
        const { progress, signal, transfer = false, cancel, ...options } = (given[place] ?? {}) as FairOptions & Handed;
        const before = Array.from({ length: place }, (_, k) => given[k]);
        return this.#send({ method, given: before, options, progress, signal, cancel, transfer: transfer ? buffers(given[0] as Mesh) : [] });
    }

    #send({ method, given, options, progress, signal, cancel, transfer }: Call): Promise<unknown> {
        return new Promise((done, failed) => {
            if (this.#isClosed) throw new Error("the worker is closed");
            if (progress !== undefined && typeof progress !== "function") throw new TypeError("progress: a function is needed");
            signal?.throwIfAborted();
            const request: Request = { id: ++this.#last, module: this.#module, method, given, options, isWatched: progress !== undefined };
            request.cancel = cancel ?? (signal === undefined ? undefined : sharedNumber());
            // A signal may outlive the call: nobody listens to it after that.
            const over = new AbortController();
            const job: Job = {
                ...{ request, transfer, progress, signal },
                done: (result) => (over.abort(), done(result)),
                failed: (why) => (over.abort(), failed(why)),
            };
            signal?.addEventListener("abort", () => this.#abort(job), { once: true, signal: over.signal });
            this.#waiting.push(job);
            this.#next();
        });
    }

    #next(): void {
        if (this.#running !== null) return;
        const job = this.#waiting.shift();
        if (job === undefined) return;
        this.#running = job;
        this.#port ??= this.#another().then((port) => this.#listening(port));
        this.#port.then(
            (port) => {
                // It may have been aborted meanwhile.
                if (this.#running !== job) return;
                port.hold(true);
                try {
                    port.post(job.request, job.transfer);
                } catch (why) {
                    this.#settle(job, () => job.failed(why));
                }
            },
            (why: unknown) => this.#settle(job, () => job.failed(why)),
        );
    }

    #answered(answer: Answer): void {
        const job = this.#running;
        if (job === null || job.request.id !== answer.id) return;
        if ("progress" in answer) {
            if (job.signal?.aborted) return;
            try {
                job.progress?.(answer.progress);
            } catch (why) {
                this.#replace();
                this.#settle(job, () => job.failed(why));
            }
            return;
        }
        const why = "error" in answer ? received(answer.error) : null;
        if (why instanceof TrapError) this.#replace();
        this.#settle(job, () => {
            if (job.signal?.aborted) job.failed(job.signal.reason);
            else if (why !== null) job.failed(why);
            else if ("result" in answer) job.done(answer.result);
        });
    }

    #settle(job: Job, say: () => void): void {
        if (this.#running === job) this.#running = null;
        void this.#port?.then((port) => port.hold(this.#running !== null));
        say();
        this.#next();
    }

    /** The worker is gone: the call that it was doing has failed, others wait for the next one. */
    #end(port: Port, why: Error): void {
        port.close();
        this.#port = null;
        this.#generation++;
        const job = this.#running;
        if (job !== null) this.#settle(job, () => job.failed(why));
    }

    /** Ends the worker; the next call starts another one. */
    #replace(): void {
        void this.#port?.then((port) => port.close());
        this.#port = null;
        this.#generation++;
    }

    #abort(job: Job): void {
        const at = this.#waiting.indexOf(job);
        if (at >= 0) {
            this.#waiting.splice(at, 1);
            job.failed(job.signal!.reason);
        } else if (this.#running === job) {
            if (job.request.cancel?.buffer instanceof ArrayBuffer || job.request.cancel === undefined) {
                this.#replace();
                this.#settle(job, () => job.failed(job.signal!.reason));
            } else {
                Atomics.store(job.request.cancel, 0, 1);
            }
        }
    }

    /** Ends the worker. Calls that are not done fail. */
    close(): void {
        this.#isClosed = true;
        this.#replace();
        const all = [...(this.#running === null ? [] : [this.#running]), ...this.#waiting.splice(0)];
        this.#running = null;
        for (const job of all) job.failed(new Error("the worker is closed"));
    }
}

/** The memory of a mesh's arrays. */
function buffers(mesh: Mesh): Transferable[] {
    const found = new Set<ArrayBuffer>();
    for (const array of [mesh.positions, mesh.triangles]) {
        if (ArrayBuffer.isView(array) && array.buffer instanceof ArrayBuffer) found.add(array.buffer);
    }
    return [...found];
}

/** A number in shared memory by which a run is stopped; none where memory cannot be shared. */
function sharedNumber(): Int32Array | undefined {
    return typeof SharedArrayBuffer === "undefined" ? undefined : new Int32Array(new SharedArrayBuffer(4));
}
