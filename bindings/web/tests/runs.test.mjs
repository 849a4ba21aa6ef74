/** Progress, stopping, errors, memory. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { compile, createWorker, FairmeshError, InputError, load, TrapError } from "fairmesh";
import { dent, sheets } from "./meshes.mjs";

const library = await load();
const mesh = dent();

test("progress rises, and its names are words", () => {
    const told = [];
    const { report } = library.fair(mesh, mesh.free, { progress: (at) => void told.push(at) });
    assert.ok(told.length >= report.iterations);
    for (let k = 1; k < told.length; k++) assert.ok(told[k].fraction >= told[k - 1].fraction);
    assert.ok(told.every(({ phase, fraction }) => /^[a-z]/.test(phase) && fraction >= 0 && fraction <= 1));
    assert.equal(told.at(-1).iterations, report.iterations);
    assert.deepEqual(Object.keys(told[0]).sort(), ["fraction", "iterations", "phase", "step"]);
});

test("a callback can stop the run, call the library, and throw", () => {
    const stopped = library.fair(mesh, mesh.free, { progress: ({ iterations }) => iterations < 2 });
    assert.equal(stopped.outcome, "cancelled");
    assert.ok(stopped.report.iterations <= 3);
    let inner = 0;
    const outer = library.fair(mesh, mesh.free, { progress: () => void (inner += library.components(mesh).length) });
    assert.ok(outer.report.isSuccess && inner > 1152);
    const why = new Error("enough");
    const thrown = () => library.fair(mesh, mesh.free, { progress: () => { throw why; } });
    assert.throws(thrown, (error) => error === why);
    assert.equal(library.fillHoles(sheets([{ frame: 9 }], { hole: true }), { progress: () => false }).loops[0].reason, "cancelled");
    const solver = library.solver(mesh, mesh.free, { progress: ({ iterations }) => iterations < 3 });
    assert.equal(solver.run().outcome, "cancelled");
    solver.close();
    assert.ok(library.fair(mesh, mesh.free).report.isSuccess);
});

test("what only looks at a mesh, or remeshes, ends at one and can be stopped", () => {
    const calls = {
        remesh: (options) => library.remesh(mesh, mesh.free, options),
        carryOver: (options) => library.carryOver(mesh, mesh.positions, null, options),
        selfIntersections: (options) => library.selfIntersections(mesh, null, options),
        selectRegion: (options) => library.selectRegion(mesh, [{ kind: "geodesic", seed: 0, value: 1 }], options),
    };
    for (const [name, call] of Object.entries(calls)) {
        const told = [];
        call({ progress: ({ fraction }) => void told.push(fraction) });
        assert.ok(told.every((fraction, k) => k === 0 || fraction >= told[k - 1]), name);
        assert.equal(told.at(-1), 1, name);
        assert.throws(() => call({ progress: () => false }), { status: "cancelled" }, name);
        assert.throws(() => call({ onProgress: null }), { name: "TypeError" }, name);
    }
});

test("a number in shared memory stops the run", () => {
    const cancel = new Int32Array(new SharedArrayBuffer(4));
    const progress = ({ iterations }) => void (iterations > 1 && Atomics.store(cancel, 0, 1));
    assert.equal(library.fair(mesh, mesh.free, { cancel, progress }).outcome, "cancelled");
    assert.throws(() => library.fair(mesh, mesh.free, { cancel: true }), { message: "cancel: an Int32Array is needed" });
});

test("refusals have what is to blame, and their texts are the library's", () => {
    const square = { positions: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], triangles: [0, 1, 2, 0, 2, 3] };
    const refused = (call, expected) =>
        assert.throws(call, (why) => {
            assert.ok(why instanceof InputError && why instanceof FairmeshError, `${why}`);
            for (const [name, value] of Object.entries(expected)) assert.deepEqual(why[name], value, name);
            return true;
        });
    refused(() => library.fair({ ...square, triangles: [0, 1, 9] }, [0]), { status: "index_out_of_range", elementKind: "triangle", element: 0, other: 9 });
    refused(() => library.fair({ ...square, triangles: [0, 1, -1] }, [0]), { message: "triangle 0 names vertex -1", status: "index_out_of_range", element: 0, other: -1 });
    refused(() => library.fair(square, null, { fixed: [7] }), { message: "the selection names element 7, but there are only 4", element: 7 });
    refused(() => library.fair(mesh, mesh.free, { tolerance: 2 }), { argument: "tolerance", element: null });
    refused(() => library.fair(mesh, mesh.free, { boundaryNormals: new Float64Array(1875).fill(0.1) }), { status: "bad_normal", element: 130 });
    assert.equal(library.fair(mesh, mesh.free, { maxIterations: 1 }).report.text, "the iterations ran out; the best surface so far is returned");
    assert.equal(library.describe("status", "repeated_index").remedy, "remove the degenerate triangles first");
});

test("what is no mesh and no option is told before", () => {
    const told = (call, message, kind = TypeError) => assert.throws(call, (why) => (assert.equal(why.message, message), why instanceof kind));
    told(() => library.fair(), "a mesh is needed: an object with positions and triangles");
    told(() => library.fair({ positions: "no" }), 'positions: an array is needed, not "no"');
    told(() => library.fair({ positions: [1, 2] }), "positions: three numbers for each are needed, not 2 in all", RangeError);
    told(() => library.fair({ positions: ["1", 2, 3] }), 'positions: numbers are needed, not "1"');
    told(() => library.fair({ ...mesh, triangles: [0.5, 1, 2] }), "triangles: integers are needed, not 0.5");
    told(() => library.fair({ ...mesh, triangles: [1, 2] }), "triangles: three indices for each are needed, not 2 in all", RangeError);
    told(() => library.fair({ ...mesh, triangles: new Float32Array(3) }), "triangles: integers are needed, not a Float32Array");
    told(() => library.fair(mesh, new Uint8Array(3)), "free: a mask has to have 625 entries, not 3", RangeError);
    told(() => library.fair(mesh, [3, 3]), "free: index 3 is given more than once; a mask is a Uint8Array, or an array of booleans", RangeError);
    told(() => library.fair(mesh, [3], { fixed: [4] }), "only one of free and fixed can be given");
    told(() => library.fair(mesh, mesh.free, { tolernace: 1 }), 'unknown option "tolernace"; did you mean "tolerance"?');
    told(() => library.fair(mesh, mesh.free, { max_iterations: 1 }), 'unknown option "max_iterations"; did you mean "maxIterations"?');
    told(() => library.fair(mesh, mesh.free, { tolerance: "1" }), 'tolerance: a number is needed, not "1"');
    told(() => library.fair(mesh, mesh.free, { maxIterations: -1 }), "maxIterations: -1 is not between 0 and 2**64 - 1", RangeError);
    told(() => library.fair(mesh, mesh.free, { discretization: "slow" }), 'discretization: "slow" is none of "second_order", "paper"');
    told(() => library.fair(mesh, mesh.free, { progress: 1 }), "progress: a function is needed");
    told(() => library.fair({ ...mesh, coincident: "near" }), 'coincident: "near" is neither "join" nor "separate" nor a distance');
    told(() => library.fillHoles(mesh, { loops: [] }), "loops: no loop is named; without it all holes are filled", RangeError);
    told(() => library.selectBall(mesh, [0, 0], 1), "point: three numbers are needed, not 2", RangeError);
});

test("memory is given back in all ways that a call ends", async () => {
    // One whose memory no larger call has made room in.
    const library = await load();
    const once = () => {
        library.fair(mesh, mesh.free);
        assert.throws(() => library.fair(mesh, [0]));
        assert.throws(() => library.fair(mesh, mesh.free, { progress: () => { throw new Error("enough"); } }));
        assert.throws(() => library.fair(mesh, mesh.free, { boundaryNormals: [1] }));
        const solver = library.solver(mesh, mesh.free);
        solver.run(1);
        solver.close();
    };
    for (let k = 0; k < 5; k++) once();
    const before = library.memoryBytes;
    for (let k = 0; k < 200; k++) once();
    assert.equal(library.memoryBytes, before);
});

test("two copies know nothing of each other", async () => {
    const module = await compile();
    const [a, b] = await Promise.all([load(module), load(module)]);
    const before = b.memoryBytes;
    const large = dent(101, 10);
    assert.deepEqual(a.fair(large, large.free).positions, library.fair(large, large.free).positions);
    assert.equal(b.memoryBytes, before);
    assert.deepEqual(b.fair(mesh, mesh.free).positions, library.fair(mesh, mesh.free).positions);
});

test("after a trap nothing is called any more, and another copy works", async () => {
    const broken = await load();
    const { grow } = WebAssembly.Table.prototype;
    // A callback that is not there: the module traps when it calls it.
    let place;
    WebAssembly.Table.prototype.grow = function (by) { return (place = grow.call(this, by)); };
    const set = WebAssembly.Table.prototype.set;
    WebAssembly.Table.prototype.set = function (at, call) { set.call(this, at, null); void call; };
    try {
        assert.throws(() => broken.fair(mesh, mesh.free, { progress: () => true }), (error) => {
            assert.ok(error instanceof TrapError);
            assert.match(error.message, /^the WebAssembly module has stopped \(.*\) and cannot be used any more; load\(\) makes a new one$/);
            return true;
        });
    } finally {
        Object.assign(WebAssembly.Table.prototype, { grow, set });
    }
    assert.ok(place > 0 && broken.isBroken);
    assert.throws(() => broken.components(mesh), TrapError);
    assert.ok((await load()).fair(mesh, mesh.free).report.isSuccess);
});

test("a module of another version, or none, is refused", async () => {
    await assert.rejects(load(new Uint8Array([0, 1, 2, 3])), WebAssembly.CompileError);
    const empty = new WebAssembly.Module(new Uint8Array([0x00, 0x61, 0x73, 0x6d, 1, 0, 0, 0]));
    await assert.rejects(load(empty), { message: "this is not the module of fairmesh" });
    const worker = await createWorker({ source: empty });
    await assert.rejects(worker.components(mesh), { message: "this is not the module of fairmesh" });
    worker.close();
    await assert.rejects(load(new URL("file:///nowhere/fairmesh.wasm")), { code: "ENOENT" });
});
