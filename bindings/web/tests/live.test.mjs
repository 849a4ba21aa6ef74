/** A surface that follows what is dragged at its boundary. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "fairmesh";
import { dent } from "./meshes.mjs";

const library = await load();
const mesh = dent();

const farthest = (a, b) => a.reduce((most, value, k) => Math.max(most, Math.abs(value - b[k])), 0);

/** A solver that has found its first surface, and a vertex on its boundary. */
function begun() {
    const solver = library.solver(mesh, mesh.free, { tolerance: 1e-10 });
    solver.finish();
    return { solver, vertex: solver.result().boundaryVertices[0] };
}

test("frames lead to what one call finds, and edits are absolute", () => {
    const { solver, vertex } = begun();
    const first = solver.positions;
    const edits = [{ kind: "tilt", vertex, angle: 0.1 }];
    solver.edit(edits);
    let frames = 1;
    let frame = solver.update({ evaluations: 2 });
    while (!frame.isSettled && frames++ < 100) {
        assert.ok(frame.evaluations <= 2);
        frame = solver.update({ evaluations: 2 });
    }
    assert.ok(frame.isSettled && frames > 1 && frame.step <= 1e-6);
    assert.ok(farthest(solver.positions, first) > 1e-3);
    assert.equal(solver.finish().outcome, "converged");
    const cold = library.solver(mesh, mesh.free, { tolerance: 1e-10 });
    cold.edit(edits);
    cold.finish();
    assert.ok(farthest(cold.positions, solver.positions) < 1e-8);
    cold.close();
    solver.edit([]);
    solver.finish();
    assert.ok(farthest(solver.positions, first) < 1e-8);
    solver.close();
});

test("a handle takes the surface with it, and a bulge has a range", () => {
    const { solver, vertex } = begun();
    const first = solver.positions;
    const fixed = Uint32Array.from([...mesh.free.keys()].filter((v) => !mesh.free[v]));
    solver.edit([{ kind: "move", vertices: fixed, translation: [0, 2, 0] }]);
    assert.ok(solver.update().isSettled);
    solver.finish();
    const moved = solver.positions.map((value, k) => value - (k % 3 === 1 ? 2 : 0));
    assert.ok(farthest(moved, first) < 1e-8);
    solver.edit([]);
    const { low, high } = solver.bulgeRange();
    assert.ok(low < 0 && high > 0, `${low} to ${high}`);
    solver.edit([{ kind: "bulge", amount: high / 2 }, { kind: "twist", vertex, angle: 0.05, falloff: 0.5 }]);
    assert.equal(solver.finish().outcome, "converged");
    solver.close();
});

test("bad edits are refused, by name", () => {
    const { solver } = begun();
    const inside = mesh.free.findIndex((free) => free);
    assert.throws(() => solver.edit(1), { name: "TypeError", message: "edits: an array is needed" });
    assert.throws(() => solver.edit([{ kind: "tild", vertex: 0, angle: 0 }]), /"tild" is none of .*Did you mean "tilt"/i);
    assert.throws(() => solver.edit([{ kind: "tilt", vertex: 0, angel: 0 }]), /angel/);
    assert.throws(() => solver.edit([{ kind: "tilt", vertex: inside, angle: 0.1 }]), { name: "InputError", element: inside });
    assert.throws(() => solver.edit([{ kind: "tilt", vertex: mesh.free.length, angle: 0.1 }]), { status: "selection_out_of_range" });
    assert.throws(() => solver.edit([{ kind: "move", vertices: [inside], translation: [0, 0, 1] }]), { name: "InputError", element: inside });
    solver.close();
});
