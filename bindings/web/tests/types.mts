/** What programs in TypeScript write: this has to compile, and where it says so, it must not. */

import { createWorker, type FairResult, FairmeshError, type Fairmesh, load, type Mesh, type Outcome, type Progress, type Report } from "fairmesh";

const single = { positions: new Float32Array(9), triangles: new Uint16Array(3) };
const listed: Mesh = { positions: [[0, 0, 0]], triangles: null, coincident: 0.1 };

export async function all(): Promise<void> {
    const library: Fairmesh = await load();
    const result = library.fair(single, new Uint8Array(3), { innerFairness: "convex", progress: ({ fraction }: Progress) => fraction < 0.5 });
    const positions: Float32Array = result.positions;
    const doubles: Float64Array = library.fair({ positions: [0, 0, 0] }).positions;
    const either: FairResult = library.fair(listed);
    const outcome: Outcome = either.outcome;
    const report: Report = either.report;
    const worst: number | null = report.worstTriangle;
    // @ts-expect-error: it may be null.
    const wrong: number = report.worstTriangle;
    // @ts-expect-error: there is no such fairness.
    library.fair(single, null, { innerFairness: "none" });
    // @ts-expect-error: there is no such option.
    library.fair(single, null, { tol: 1 });
    // @ts-expect-error: positions are needed.
    library.fair({ triangles: [0, 1, 2] });
    const blended: Float32Array = library.roundEdges(single, { width: 0.1, creases: "convex", edges: [[0, 1]] }).positions;
    // @ts-expect-error: blends are tangent to what is beside them.
    library.roundEdges(single, { width: 0.1, boundaryNormals: "averaged" });
    const [low, high]: [number, number] = report.hInside;
    const loops = library.boundaryLoops(single);
    const kinds: ("hole" | "outer_boundary" | "non_manifold" | "inconsistent")[] = loops.map(({ kind }) => kind);
    const text: string = library.describe("status", "no_bump").remedy;
    const name: string = report.components[0]!.attempts[0]!.name;
    const solver = library.solver(single);
    solver.setTarget(1);
    solver.close();
    try {
        library.fillHoles(single, { join: [[0, 1]], within: { centre: [0, 0, 0], radius: 1 } });
    } catch (why) {
        if (why instanceof FairmeshError && why.status === "nothing_fixed") void why.element;
    }
    const worker = await createWorker();
    const there: Float32Array = (await worker.fair(single, null, { signal: new AbortController().signal, transfer: true })).positions;
    const mask: Uint8Array = await worker.selectBall(single, [0, 0, 0], 1);
    worker.close();
    void [positions, doubles, blended, outcome, worst, wrong, low, high, kinds, text, name, there, mask];
}
