/** The program of a worker: loads the library, and does what it is asked, one call after the other. */

import type { Progress } from "./abi.js";
import type { Mesh, Selection } from "./arrays.js";
import type { Method, Request, SolverMethod } from "./client.js";
import { sent } from "./errors.js";
import type { Budget, Edit } from "./edits.js";
import type { FairOptions, Solver } from "./fairing.js";
import { type Fairmesh, load } from "./index.js";
import { serve } from "./ports.js";
import type { Look, ShownFrame } from "./worker_solver.js";

let library: Promise<Fairmesh> | null = null;
const solvers = new Map<number, Solver>();

/** The memory of all arrays in a result: it changes hands, and is not copied. */
function memoryOf(value: unknown, found = new Set<ArrayBuffer>()): Set<ArrayBuffer> {
    if (ArrayBuffer.isView(value)) {
        if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
    } else if (typeof value === "object" && value !== null) {
        for (const each of Object.values(value)) memoryOf(each, found);
    }
    return found;
}

type Tell = (progress: Progress) => void;

/** The arguments, with what watches the run in the options. */
function watching(request: Request, tell: Tell): unknown[] {
    if (request.options === null) return request.given;
    const options: Record<string, unknown> = { ...request.options };
    if (request.isWatched) options["progress"] = tell;
    if (request.cancel !== undefined) options["cancel"] = request.cancel;
    return [...request.given, options];
}

/** What watches a solver's calls: that of the call under way, each has its own. */
let watch: (progress: Progress) => boolean = () => true;

function watchOf({ isWatched, cancel }: Request, tell: Tell): (progress: Progress) => boolean {
    return (progress) => {
        if (isWatched) tell(progress);
        return cancel === undefined || Atomics.load(cancel, 0) === 0;
    };
}

/** One frame, and what is to be seen of it. */
function show(solver: Solver, edits: readonly Edit[], budget: Budget, look: Look): ShownFrame {
    solver.edit(edits);
    const frame = solver.update(budget);
    return { ...frame, positions: solver.positions, meanCurvature: look.meanCurvature ? solver.meanCurvature : null };
}

function solverOf(number: number): Solver {
    const solver = solvers.get(number);
    if (solver === undefined) throw new Error(`the worker has no solver ${number}`);
    return solver;
}

/** Calls of solvers, by their numbers. */
function solverCall(host: Fairmesh, { method, given, options }: Request): unknown {
    const number = given[0] as number;
    if (method === "openSolver") {
        const [, mesh, free] = given as [number, Mesh, Selection | null];
        solvers.set(number, host.solver(mesh, free, { ...(options as FairOptions), progress: (progress) => watch(progress) }));
        return undefined;
    }
    const solver = solverOf(number);
    if (method === "closeSolver") {
        solvers.delete(number);
        return solver.close();
    }
    const [, name, arguments_] = given as [number, string, unknown[]];
    if (name === "show") return show(solver, ...(arguments_ as [Edit[], Budget, Look]));
    const member = (solver as unknown as Record<string, unknown>)[name];
    return typeof member === "function" ? (member.apply(solver, arguments_) as unknown) : member;
}

const OF_SOLVERS: ReadonlySet<string> = new Set<SolverMethod>(["openSolver", "callSolver", "closeSolver"]);

function answer(host: Fairmesh, request: Request, tell: Tell): unknown {
    if (OF_SOLVERS.has(request.method)) {
        watch = watchOf(request, tell);
        return solverCall(host, request);
    }
    const calls = host as unknown as Record<Method, (...given: unknown[]) => unknown>;
    return calls[request.method as Method](...watching(request, tell));
}

serve((request: Request, post) => {
    void (async () => {
        try {
            library ??= load(request.module);
            const result = answer(await library, request, (progress) => post({ id: request.id, progress }));
            post({ id: request.id, result }, [...memoryOf(result)]);
        } catch (why) {
            post({ id: request.id, error: sent(why) });
        }
    })();
});
