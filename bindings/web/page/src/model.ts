/** What is worked on: a surface with a region, the steps that made it, and the solver that is live. No controls, no drawing. */

import { createWorker, type Edit, type FairmeshWorker, type Report, type Watched, type WorkerSolver } from "../../src/index.js";
import { type Cost, costOf } from "./costs.js";
import { faired, FIRST, module, type Shape, shape as embedded, type ShapeName, startWorker } from "./embedded.js";
import { maskOf, runsOf, type Step } from "./link.js";
import { type Part, partsOfHoles, partsOfRegion, saysOf, summed } from "./parts.js";
import { saysOfBlends, sharpEdges } from "./rounding.js";
import { lengthOf, type LoopVertex, moving, type Normals, regionLoops, Surface, type Triangles, trianglesAt, verticesOf } from "./surface.js";
import { worded } from "./words.js";

/** A solver that is held up at a fair surface, and what it was asked since. */
export interface Live {
    solver: WorkerSolver<Float64Array>;
    loops: LoopVertex[][];
    lengths: number[];
    edits: Edit[];
    /** How much the boundary may bulge, if known. */
    range: { low: number; high: number } | null;
}

/** What is kept to come back to. */
interface Snapshot extends Triangles {
    region: Uint8Array;
    normals: Normals | null;
    held: Uint8Array | null;
    steps: Step[];
    carried: Edit[];
    /** What was live when another region was chosen: its arrows come back. */
    live: Live | null;
}

/** Evaluations of the residual for a frame: a settled surface takes one to three iterations from the last one. */
const FRAME = { evaluations: 8 };
/** Frames that edits get to settle; what is still moving then is left to `finish`, which tells why. */
const MOST_FRAMES = 60;
const DEGREE = Math.PI / 180;

export class Model {
    readonly #worker: FairmeshWorker;
    surface!: Surface;
    /** What the surface was before the last step, for the swipe. */
    before: Surface | null = null;
    region: Uint8Array = new Uint8Array(0);
    normals: Normals | null = null;
    /** Vertices of a shape that stay where they are, though all around them is in the region: its curves. */
    #held: Uint8Array | null = null;
    /** Null: a file of the person, which no link can carry. */
    shape: ShapeName | null = null;
    steps: Step[] = [];
    live: Live | null = null;
    /** Turns of boundaries that stay in force where these are boundaries of the next region, too. */
    #carried: Edit[] = [];
    /** What is no longer live, but may be again. */
    #paused: Live | null = null;
    /** The triangles that the last step has made. */
    #fresh: Uint8Array | null = null;
    /** Until the first shape can be dragged. */
    #waking: Promise<unknown> = Promise.resolve();
    /** What the last step has come to, one by one. */
    parts: Part[] = [];
    /** Frames shown since the page was loaded. */
    frames = 0;
    /** Other triangles, positions or another region: what is seen is out of date. */
    changed: () => void = () => undefined;
    #snapshots: Snapshot[] = [];
    /** The snapshot that the last rounding began with. */
    #beforeRounding: Snapshot | null = null;
    /** Counts edits and finishes: an older one goes no further. */
    #edition = 0;
    /** Whether the surface is following edits. */
    isFollowing = false;

    static async start(): Promise<Model> {
        return new Model(await createWorker({ source: await module(), start: startWorker }));
    }

    private constructor(worker: FairmeshWorker) {
        this.#worker = worker;
    }

    get mesh(): Triangles {
        return { positions: this.surface.positions, triangles: this.surface.triangles };
    }

    get canUndo(): boolean {
        return (this.live?.edits.length ?? 0) > 0 || this.#snapshots.length > 0;
    }

    #show(mesh: Triangles, before: Triangles | null, fresh: Uint8Array | null = null): void {
        this.surface?.free();
        this.before?.free();
        this.surface = new Surface(mesh);
        this.before = before && new Surface(before);
        this.parts = [];
        this.#fresh = fresh;
        this.mark();
    }

    /** Colours the region, after a change of it. */
    mark(): void {
        this.colour(this.region);
        this.changed();
    }

    /** Colours a region, which may not be chosen yet, and what was filled last. */
    colour(region: Uint8Array): void {
        const marks = Int8Array.from(verticesOf(region, this.mesh));
        if (this.#fresh !== null) verticesOf(this.#fresh, this.mesh).forEach((is, v) => is && !marks[v] && (marks[v] = -1));
        this.surface.paint("chosen", marks);
    }

    #begin(mesh: Triangles, region: Uint8Array, normals: Normals | null, shape: ShapeName | null): void {
        this.end();
        this.#held = null;
        [this.region, this.normals, this.shape, this.steps, this.#snapshots, this.#carried] = [region, normals, shape, [], [], []];
        this.#show(mesh, null);
    }

    /** Begins with a shape of the page. */
    async take(name: ShapeName): Promise<void> {
        const shape: Shape = await embedded(name);
        this.#begin(shape, trianglesAt(shape.free, shape), shape.normals, name);
        if (shape.free.length === 0) return;
        this.#held = new Uint8Array(shape.positions.length / 3).fill(1);
        for (const vertex of shape.free) this.#held[vertex] = 0;
    }

    /** Begins with the first shape as it is when it is faired; it can be dragged as soon as the solver has come to that, too. */
    async welcome(): Promise<{ awake: Promise<string> }> {
        const [positions] = await Promise.all([faired(), this.take(FIRST)]);
        const rough = this.mesh;
        this.surface.move(positions);
        this.changed();
        const awake = this.#fair({}, rough);
        this.#waking = awake.catch(() => undefined);
        return { awake };
    }

    /** Begins with a mesh of the person; the library looks at all of it first. */
    async open(mesh: Triangles): Promise<number> {
        const { length } = await this.#worker.boundaryLoops(mesh);
        this.#begin(mesh, new Uint8Array(mesh.triangles.length / 3), null, null);
        return length;
    }

    /** Another region: the surface stays as it was dragged, and what was live waits for Undo. The same region again changes nothing. */
    choose(region: Uint8Array): void {
        if (region.every((is, t) => is === this.region[t])) return this.mark();
        this.#remember(this.live);
        if (this.live !== null) {
            this.#carry();
            [this.#paused, this.live] = [this.live, null];
        }
        this.region = region;
        this.mark();
    }

    async spread(kind: "grow" | "shrink"): Promise<void> {
        this.choose(await this.#worker[kind](this.mesh, this.region));
    }

    #remember(live: Live | null = null, { positions, triangles } = this.mesh): void {
        const { region, normals, steps } = this;
        this.#snapshots.push({ positions, triangles, region: region.slice(), normals, held: this.#held, steps: structuredClone(steps), carried: this.#carried, live });
        if (this.#snapshots.length > 30) this.#snapshots.shift();
    }

    /** Ends what is live, or could be again; the surface stays. */
    end(): void {
        for (const live of [this.live, this.#paused]) void live?.solver.close().catch(() => undefined);
        this.live = this.#paused = null;
    }

    /** Keeps the turns that are in force, as turns of loops. What was moved has moved. */
    #carry(): void {
        if (this.live === null) return;
        const { edits, loops } = this.live;
        this.#carried = edits.flatMap((edit): Edit[] => {
            if (edit.kind === "bulge") return loops.map((loop) => ({ kind: "tilt", vertex: loop[0]!.vertex, angle: edit.amount, falloff: 0 }));
            return edit.kind === "move" ? [] : [edit];
        });
    }

    /** Takes back the last edit, or the last step. */
    async undo(): Promise<void> {
        if (this.live !== null && this.live.edits.length > 0) return this.edit(this.live.edits.slice(0, -1));
        const last = this.#snapshots.pop();
        if (last === undefined) return;
        const live = last.live === this.#paused ? last.live : null;
        if (live !== null) this.#paused = null;
        this.end();
        this.live = live;
        [this.region, this.normals, this.#held, this.steps, this.#carried] = [last.region, last.normals, last.held, last.steps, last.carried];
        this.#show(last, null);
    }

    /** How many vertices fairing would move, and what it costs. What cannot be faired costs nothing: it is told why when it is tried. */
    async cost(): Promise<Cost & { vertices: number }> {
        const free = moving(this.region, this.surface, this.#held);
        const vertices = free.reduce((sum, is) => sum + is, 0);
        return { vertices, ...costOf(vertices === 0 ? 0 : await this.#worker.memoryNeeded(this.mesh, free).catch(() => 0)) };
    }

    async costToFill(joined: [number, number] | null): Promise<Cost> {
        const choice = joined === null ? await this.#gaps() : { loops: joined, join: [joined] };
        return costOf(await this.#worker.memoryNeededToFill(this.mesh, choice).catch(() => 0));
    }

    async costToRefill(): Promise<Cost> {
        try {
            const { triangles, loops } = await this.#worker.erase(this.mesh, this.region);
            return costOf(await this.#worker.memoryNeededToFill({ ...this.mesh, triangles }, { loops }));
        } catch {
            return costOf(0);
        }
    }

    /** Fairs the region, and holds the solver up there. What the library has found out is told. */
    async fair(watched: Watched): Promise<string> {
        await this.#waking;
        return this.#fair(watched, this.mesh);
    }

    async #fair(watched: Watched, mesh: Triangles): Promise<string> {
        const { surface, region } = this;
        const free = moving(this.region, this.surface, this.#held);
        const loops = regionLoops(free, this.surface, this.#held);
        const asked = await this.#worker.solver(mesh, free, { ...this.#given(loops), ...watched });
        this.#carry();
        const boundary = new Set(loops.flat().map(({ vertex }) => vertex));
        const edits = this.#carried.filter((edit) => "vertex" in edit && boundary.has(edit.vertex));
        try {
            if (edits.length > 0) await asked.edit(edits);
            const report = await asked.finish(watched);
            const positions = await asked.positions();
            if (this.surface !== surface || this.region !== region) throw new Error("another region has been taken meanwhile");
            this.#remember(null, mesh);
            this.end();
            this.#show({ positions, triangles: mesh.triangles }, mesh);
            this.steps.push({ kind: "fair", region: runsOf(this.region), edits });
            const found = regionLoops(free, this.surface, this.#held);
            this.live = { solver: asked, loops: found, lengths: found.map((loop) => lengthOf(loop, this.surface)), edits, range: null };
            this.parts = await this.#partsOf(report, free);
            this.changed();
            const { freeVertices, iterations } = report;
            return `${freeVertices.toLocaleString("en")} vertices, ${iterations} iterations: ${this.parts.length > 1 ? summed(this.parts) : saysOf(report)}`;
        } catch (why) {
            void asked.close().catch(() => undefined);
            throw why;
        }
    }

    async #partsOf({ components }: Report, free: Uint8Array): Promise<Part[]> {
        const names = components.map(({ outcome, looseReason }) => (outcome === "converged_loosely" ? (["looseReason", looseReason] as const) : (["outcome", outcome] as const)));
        const told = await Promise.all(names.map(async ([kind, name]) => worded(name, (await this.#worker.describe(kind, name)).text)));
        return partsOfRegion(components, free, this.surface.triangles, (of) => told[components.indexOf(of)]!);
    }

    /** The shape's own normals, where they are at the boundary of the region. Where a boundary was moved they are no longer right. */
    #given(loops: readonly LoopVertex[][]): { boundaryNormals?: { vertices: number[]; vectors: number[] } } {
        if (this.normals === null || this.steps.some((step) => step.kind === "fair" && step.edits.some(({ kind }) => kind === "move"))) return {};
        const boundary = new Set(loops.flat().map(({ vertex }) => vertex));
        const [vertices, vectors] = [[] as number[], [] as number[]];
        this.normals.vertices.forEach((vertex, k) => {
            if (!boundary.has(vertex)) return;
            vertices.push(vertex);
            vectors.push(...this.normals!.vectors.subarray(3 * k, 3 * k + 3));
        });
        return vertices.length === 0 ? {} : { boundaryNormals: { vertices, vectors } };
    }

    /** Fills all holes, or two with one patch. */
    async fill(watched: Watched, joined: [number, number] | null): Promise<string> {
        const mesh = this.mesh;
        const choice = joined === null ? await this.#gaps() : { loops: joined, join: [joined] };
        const filled = await this.#worker.fillHoles(mesh, { ...choice, ...watched });
        const asked = filled.loops.filter(({ reason }) => reason !== "not_asked_for");
        if (asked.length === 0) return "no hole was found";
        const done = asked.filter(({ triangleCount }) => triangleCount > 0).length;
        const parts = partsOfHoles(asked, filled.triangles.length / 3);
        if (done > 0) this.#replace(filled, joined === null ? { kind: "fill" } : { kind: "join", loops: joined });
        this.parts = parts;
        this.changed();
        const by = done === 0 ? "" : ` by ${filled.newTriangleCount.toLocaleString("en")} triangles`;
        return `${done} of ${asked.length} filled${by}: ${summed(parts)}`;
    }

    /** Holes; where there are none, the one boundary that there is. */
    async #gaps(): Promise<{ loops?: number[] }> {
        const loops = await this.#worker.boundaryLoops(this.mesh);
        return loops.length === 1 ? { loops: [0] } : {};
    }

    /** Deletes the region and fills what is left open: what was there is of no use. */
    async refill(watched: Watched): Promise<string> {
        const made = await this.#worker.refill(this.mesh, null, { freeTriangles: this.region, ...watched });
        this.#replace(made, { kind: "refill", region: runsOf(this.region) });
        return `erased, and filled by ${made.newTriangleCount.toLocaleString("en")} triangles`;
    }

    /** Better triangles for the region, which it stays: the surface keeps its shape, and is to be faired next. */
    async remesh(watched: Watched): Promise<string> {
        const count = this.region.reduce((sum, is) => sum + is, 0);
        const made = await this.#worker.remesh(this.mesh, null, { freeTriangles: this.region, ...watched });
        this.#replace(made, { kind: "remesh", region: runsOf(this.region) });
        this.region.fill(1, this.region.length - made.newTriangleCount);
        this.mark();
        const [from, to] = [count, made.newTriangleCount].map((x) => x.toLocaleString("en"));
        return `remeshed, from ${from} to ${to} triangles of like size. Fair it next`;
    }

    /** Whether nothing has been done or chosen since edges were rounded: another width takes the place of that. */
    get canRoundAgain(): boolean {
        return this.#beforeRounding !== null && this.#snapshots.at(-1) === this.#beforeRounding;
    }

    /** Puts blends in place of the sharp edges in the region, or of all where none is chosen; `width`: how far they reach, in parts of the diagonal. */
    async round(watched: Watched, width: number): Promise<string> {
        const isAgain = this.canRoundAgain;
        const { region, ...mesh } = isAgain ? this.#beforeRounding! : { ...this.mesh, region: this.region };
        const surface = new Surface(mesh);
        const edges = region.includes(1) ? sharpEdges(region, surface) : null;
        const { diagonal } = surface;
        surface.free();
        if (edges?.length === 0) throw new Error("no edge of the region is sharp: choose the triangles on both sides of one");
        const asked = { width: width * diagonal, ...(edges === null ? {} : { edges }) };
        const made = await this.#worker.roundEdges({ positions: mesh.positions, triangles: mesh.triangles }, { ...asked, ...watched });
        if (!made.creases.some(({ isRounded }) => isRounded)) return saysOfBlends(made);
        // Not before: where it fails or is stopped, what was there stays.
        if (isAgain) await this.undo();
        this.#replace(made, { kind: "round", region: runsOf(region), width });
        this.#beforeRounding = this.#snapshots.at(-1)!;
        return saysOfBlends(made);
    }

    /** Other triangles, of which the last ones are new: no region, so that what is painted next is one by itself. The list of parts has the patches. */
    #replace(made: Triangles & { newTriangleCount: number }, step: Step): void {
        this.#remember();
        this.#carry();
        this.end();
        const before = this.mesh;
        this.region = new Uint8Array(made.triangles.length / 3);
        this.steps.push(step);
        // Vertices of a mesh that was refilled have other numbers.
        if (step.kind === "refill" || step.kind === "remesh" || step.kind === "round") [this.#held, this.normals, this.#carried] = [null, null, []];
        const count = this.region.length;
        // Between blends triangles are so large that their colour would run far into them.
        const fresh = step.kind === "round" ? null : new Uint8Array(count).fill(1, count - made.newTriangleCount);
        this.#show(made, before, fresh);
    }

    /** Holes and boundaries, for the lists. */
    async loops(): Promise<{ vertexCount: number }[]> {
        return this.#worker.boundaryLoops(this.mesh);
    }

    async meanCurvature(mesh: Triangles): Promise<Float64Array> {
        return this.#worker.meanCurvature(mesh);
    }

    /** Shows the surface with these edits, frame by frame until it has settled or other edits come. */
    async edit(edits: Edit[], look: { meanCurvature?: boolean } = {}): Promise<void> {
        const live = this.live;
        if (live === null) return;
        live.edits = edits;
        const step = this.steps.at(-1);
        if (step?.kind === "fair") step.edits = edits;
        const mine = ++this.#edition;
        this.isFollowing = true;
        try {
            await this.#follow(live, mine, look);
        } finally {
            if (mine === this.#edition) this.isFollowing = false;
        }
    }

    async #follow(live: Live, mine: number, look: { meanCurvature?: boolean }): Promise<void> {
        const { edits } = live;
        for (let count = 0, isSettled = false; !isSettled && count < MOST_FRAMES; count++) {
            const frame = await live.solver.show(edits, FRAME, look);
            if (frame === null || this.live !== live) return;
            // Where frames take longer than a hand, there always is a newer edit: what has come is shown all the same.
            this.surface.move(frame.positions);
            if (frame.meanCurvature !== null) this.surface.paint("curvature", frame.meanCurvature);
            this.frames++;
            this.changed();
            if (mine !== this.#edition) return;
            isSettled = frame.isSettled;
        }
    }

    /** The surface to the last digit, and what the library says about it. */
    async finish(watched: Watched): Promise<string> {
        const live = this.live!;
        const mine = ++this.#edition;
        this.isFollowing = false;
        await live.solver.edit(live.edits);
        const report = await live.solver.finish(watched);
        const positions = await live.solver.positions();
        if (mine !== this.#edition) return "other edits have come";
        this.surface.move(positions);
        this.changed();
        return saysOf(report);
    }

    async bulgeRange(watched: Watched): Promise<{ low: number; high: number }> {
        const live = this.live!;
        return (live.range ??= await live.solver.bulgeRange(watched));
    }

    /** Does again what a link tells. */
    async replay(steps: readonly Step[], watched: Watched): Promise<void> {
        for (const step of steps) {
            if ("region" in step) this.region = maskOf(step.region, this.surface.triangles.length / 3);
            if (step.kind === "fill" || step.kind === "join") await this.fill(watched, step.kind === "join" ? step.loops : null);
            if (step.kind === "refill") await this.refill(watched);
            if (step.kind === "remesh") await this.remesh(watched);
            if (step.kind === "round") await this.round(watched, step.width);
            if (step.kind !== "fair") continue;
            await this.fair(watched);
            if (step.edits.length === 0) continue;
            await this.edit(step.edits);
            await this.finish(watched);
        }
    }
}

/** The edits with one more; one like the last takes its place, so that a drag is one. None where it does nothing. */
export function withEdit(edits: readonly Edit[], edit: Edit): Edit[] {
    const bulges = edit.kind === "bulge";
    const kept = edits.filter((each) => !(bulges ? each.kind === "bulge" : isAlike(each, edit)));
    const isNothing = edit.kind === "bulge" ? edit.amount === 0 : edit.kind === "move" ? !Array.from(edit.translation ?? []).some((x) => x !== 0) : edit.angle === 0;
    return isNothing ? kept : [...kept, edit];
}

/** Whether two edits are the same grip at the same place. */
export function isAlike(a: Edit, b: Edit): boolean {
    if (a.kind === "bulge" || b.kind === "bulge" || a.kind !== b.kind || a.falloff !== b.falloff) return false;
    if (a.kind === "move" || b.kind === "move") return a.kind === "move" && b.kind === "move" && a.vertices[0] === b.vertices[0];
    return a.vertex === b.vertex;
}

export { DEGREE };
