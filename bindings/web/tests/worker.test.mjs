/** The library in a worker. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { createWorker, InputError, load, TrapError, version } from "fairmesh";
import { cube, dent, offSphere } from "./meshes.mjs";

const mesh = dent();
/** A run of seconds: it is stopped long before its end. */
const large = dent(401, 10);

test("a worker finds the same, and tells of progress", async () => {
    const [library, worker] = await Promise.all([load(), createWorker()]);
    const told = [];
    const options = { progress: (at) => void told.push(at) };
    const [first, second] = await Promise.all([worker.fair(mesh, mesh.free, options), worker.fair(mesh, mesh.free)]);
    assert.deepEqual(first.positions, library.fair(mesh, mesh.free).positions);
    assert.deepEqual(second.report, first.report);
    assert.ok(told.length >= first.report.iterations && told.at(-1).fraction <= 1);
    assert.deepEqual(await worker.components(mesh), library.components(mesh));
    assert.equal((await worker.selectBall(mesh, [0, 0, 1], 0.3)).length, mesh.triangles.length / 3);
    assert.equal((await worker.defaultOptions()).tolerance, 1e-8);
    assert.deepEqual((await worker.roundEdges(cube(2), { width: 0.3 })).positions, library.roundEdges(cube(2), { width: 0.3 }).positions);
    worker.close();
    await assert.rejects(worker.components(mesh), { message: "the worker is closed" });
});

test("errors come through with all that they tell", async () => {
    const worker = await createWorker();
    await assert.rejects(worker.fair(mesh, [0]), (why) => {
        assert.ok(why instanceof InputError);
        assert.equal(why.status, "free_vertex_on_boundary");
        assert.equal(why.element, 0);
        assert.match(why.message, /^free vertex 0 lies on the boundary/);
        return true;
    });
    await assert.rejects(worker.fair(mesh, mesh.free, { tol: 1 }), { name: "TypeError", message: 'unknown option "tol"; did you mean "tolerance"?' });
    await assert.rejects(worker.fair(mesh, mesh.free, { progress: () => { throw new Error("enough"); } }), { message: "enough" });
    assert.ok((await worker.fair(mesh, mesh.free)).report.isSuccess);
    worker.close();
});

test("arrays are copied, or handed over", async () => {
    const worker = await createWorker();
    const given = { positions: mesh.positions.slice(), triangles: mesh.triangles.slice() };
    await worker.fair(given, mesh.free);
    assert.equal(given.positions.length, mesh.positions.length);
    const { positions } = await worker.fair(given, mesh.free, { transfer: true });
    assert.equal(given.positions.length, 0);
    assert.ok(offSphere(positions) < 1e-9);
    worker.close();
});

/** A module that says the version and traps at the first allocation. */
function trapping() {
    const text = (name) => [name.length, ...Buffer.from(name)];
    const section = (id, bytes) => [id, bytes.length, ...bytes];
    return new Uint8Array([
        ...[0x00, 0x61, 0x73, 0x6d, 1, 0, 0, 0],
        ...section(1, [2, 0x60, 0, 1, 0x7f, 0x60, 1, 0x7f, 1, 0x7f]),
        ...section(3, [2, 0, 1]),
        ...section(5, [1, 0, 1]),
        ...section(7, [3, ...text("memory"), 2, 0, ...text("fairmesh_version_string"), 0, 0, ...text("fairmesh_wasm_allocate"), 0, 1]),
        ...section(10, [2, 4, 0, 0x41, 16, 0x0b, 3, 0, 0x00, 0x0b]),
        ...section(11, [1, 0, 0x41, 16, 0x0b, ...text(`${version}\0`)]),
    ]);
}

test("a trap comes through, and calls after it are answered", async () => {
    const worker = await createWorker({ source: trapping() });
    const told = { name: "TrapError", message: "the WebAssembly module has stopped (unreachable) and cannot be used any more; load() makes a new one" };
    await assert.rejects(worker.components(mesh), told);
    await Promise.all([assert.rejects(worker.components(mesh), told), assert.rejects(worker.components(mesh), TrapError)]);
    worker.close();
});

/** Aborts a run after its first message, with shared memory and without. */
async function aborted() {
    const worker = await createWorker();
    const controller = new AbortController();
    const run = worker.fair(large, large.free, { signal: controller.signal, progress: () => controller.abort() });
    const next = worker.fair(mesh, mesh.free);
    const later = new AbortController();
    const never = worker.fair(mesh, mesh.free, { signal: later.signal });
    later.abort(new Error("not wanted"));
    await assert.rejects(never, { message: "not wanted" });
    await assert.rejects(run, { name: "AbortError" });
    assert.ok((await next).report.isSuccess);
    await assert.rejects(worker.fair(mesh, mesh.free, { signal: controller.signal }), { name: "AbortError" });
    worker.close();
}

test("a signal stops the run, and the next one is done", { timeout: 60000 }, aborted);

test("so it does where no memory can be shared", { timeout: 60000 }, async () => {
    const shared = globalThis.SharedArrayBuffer;
    delete globalThis.SharedArrayBuffer;
    try {
        await aborted();
    } finally {
        globalThis.SharedArrayBuffer = shared;
    }
});

test("a number in shared memory stops the run with the best surface so far", { timeout: 60000 }, async () => {
    const worker = await createWorker();
    const cancel = new Int32Array(new SharedArrayBuffer(4));
    const result = await worker.fair(large, large.free, { cancel, progress: ({ iterations }) => void (iterations > 0 && Atomics.store(cancel, 0, 1)) });
    assert.equal(result.outcome, "cancelled");
    worker.close();
});

/** Edits like those of a hand: a vertex of the boundary of the free ones, tilted more and more. */
async function handled(worker) {
    const library = await load();
    const here = library.solver(mesh, mesh.free);
    const there = await worker.solver(mesh, mesh.free);
    const [{ iterations }, report] = [here.run(), await there.run()];
    assert.equal(report.iterations, iterations);
    assert.deepEqual(await there.positions(), here.positions);
    const [vertex] = here.result().boundaryVertices;
    const tilted = (k) => [{ kind: "tilt", vertex, angle: 0.01 * k }];
    return { here, there, tilted };
}

test("a solver in a worker finds the same bits, frame by frame", async () => {
    const worker = await createWorker();
    const { here, there, tilted } = await handled(worker);
    for (let k = 1; k < 6; k++) {
        const { positions, meanCurvature, ...frame } = await there.show(tilted(k), { evaluations: 6 }, { meanCurvature: k === 5 });
        here.edit(tilted(k));
        assert.deepEqual(frame, here.update({ evaluations: 6 }));
        assert.deepEqual(positions, here.positions);
        assert.deepEqual(meanCurvature, k === 5 ? here.meanCurvature : null);
    }
    assert.deepEqual(await there.finish(), here.finish());
    assert.deepEqual((await there.result()).positions, here.positions);
    await there.close();
    await there.close();
    await assert.rejects(there.positions(), { message: "the solver is closed" });
    worker.close();
    here.close();
});

test("while a frame is under way only the newest edits wait", async () => {
    const worker = await createWorker();
    const { here, there, tilted } = await handled(worker);
    const frames = await Promise.all(Array.from({ length: 20 }, (_, k) => there.show(tilted(k + 1))));
    assert.deepEqual(frames.map((frame) => frame !== null), Array.from({ length: 20 }, (_, k) => k === 0 || k === 19));
    await assert.rejects(there.show([{ kind: "tilt", vertex: 1e9, angle: 0.1 }]), InputError);
    here.edit(tilted(20));
    here.finish();
    await there.edit(tilted(20));
    await there.finish();
    const [found, expected] = [await there.positions(), here.positions];
    assert.ok(found.every((x, k) => Math.abs(x - expected[k]) < 1e-7));
    worker.close();
});

test("a solver whose run was aborted without shared memory is made anew, with its edits", { timeout: 60000 }, async () => {
    const shared = globalThis.SharedArrayBuffer;
    delete globalThis.SharedArrayBuffer;
    try {
        const worker = await createWorker();
        const { here, there, tilted } = await handled(worker);
        await there.edit(tilted(9));
        const controller = new AbortController();
        const run = worker.fair(large, large.free, { signal: controller.signal, progress: () => controller.abort() });
        await assert.rejects(run, { name: "AbortError" });
        await there.finish();
        here.edit(tilted(9));
        here.finish();
        const [found, expected] = [await there.positions(), here.positions];
        assert.ok(found.every((x, k) => Math.abs(x - expected[k]) < 1e-7));
        worker.close();
    } finally {
        globalThis.SharedArrayBuffer = shared;
    }
});
