/** Every call: what it takes and what it returns. The numbers are in answers.test.mjs. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { load, version } from "fairmesh";
import { cube, dent, offSphere, sheets, tubes } from "./meshes.mjs";

const library = await load();
const mesh = dent();

test("a dented sphere comes back, from arrays of all kinds", () => {
    const result = library.fair(mesh, mesh.free);
    assert.equal(result.outcome, "converged");
    assert.ok(result.report.isSuccess);
    assert.ok(result.positions instanceof Float64Array);
    assert.ok(offSphere(result.positions) < 1e-9, `${offSphere(result.positions)}`);
    const fixed = Array.from(mesh.free).findIndex((is) => !is);
    assert.deepEqual(result.positions.subarray(3 * fixed, 3 * fixed + 3), mesh.positions.subarray(3 * fixed, 3 * fixed + 3));
    const middle = mesh.free.length >> 1;
    assert.ok(Math.abs(result.meanCurvature[middle] + 1) < 1e-6);
    assert.ok(Math.abs(result.gaussianCurvature[middle] - 1) < 1e-2);
    assert.equal(result.boundaryNormals.length, 3 * result.boundaryVertices.length);

    const indices = Array.from(mesh.free.keys()).filter((v) => mesh.free[v]);
    const rows = (values) => Array.from({ length: values.length / 3 }, (_, k) => Array.from(values.subarray(3 * k, 3 * k + 3)));
    const same = [
        [{ positions: Array.from(mesh.positions), triangles: Uint16Array.from(mesh.triangles) }, indices],
        [{ positions: rows(mesh.positions), triangles: rows(mesh.triangles) }, Array.from(mesh.free, Boolean)],
        [mesh, Uint16Array.from(indices)],
        [mesh, null, { fixed: Uint8Array.from(mesh.free, (is) => 1 - is) }],
        [mesh, undefined, { fixed: Array.from(mesh.free.keys()).filter((v) => !mesh.free[v]) }],
    ];
    for (const [other, free, options] of same) assert.deepEqual(library.fair(other, free, options).positions, result.positions);
});

test("triangles select what lies inside, and without a selection all of the inside is free", () => {
    const all = library.fair(mesh);
    assert.equal(all.report.freeVertices, 23 * 23);
    const mask = new Uint8Array(mesh.triangles.length / 3).fill(1);
    assert.deepEqual(library.fair(mesh, null, { freeTriangles: mask }).positions, all.positions);
});

test("single precision stays, and so do triangle soups", () => {
    const positions = Float32Array.from(mesh.positions);
    const result = library.fair({ positions, triangles: mesh.triangles }, mesh.free);
    assert.ok(result.positions instanceof Float32Array);
    assert.ok(offSphere(result.positions) < 1e-6);
    const soup = Float32Array.from(Array.from(mesh.triangles).flatMap((v) => Array.from(positions.subarray(3 * v, 3 * v + 3))));
    const free = Uint8Array.from(mesh.triangles, (v) => mesh.free[v]);
    const apart = library.fair({ positions: soup }, free);
    assert.equal(apart.outcome, "converged");
    assert.ok(offSphere(apart.positions) < 1e-6);
    assert.throws(() => library.fair({ positions: soup, coincident: "separate" }, free), { status: "free_vertex_on_boundary" });
});

test("a report tells all of its components", () => {
    const { report } = library.fair(sheets([{ dent: 0.1 }, { dent: 0.1, height: 5 }]), sheets([{ dent: 0.1 }, { dent: 0.1 }]).free);
    assert.equal(report.componentCount, 2);
    assert.equal(report.components.length, 2);
    for (const component of report.components) {
        assert.equal(component.outcome, "converged");
        assert.equal(component.attempts.length, component.attemptCount);
        assert.ok(component.attempts.every(({ name, end }) => name.length > 3 && end === "sound"));
    }
    assert.equal(report.components[1].vertex - report.components[0].vertex, 625);
    assert.ok(report.worstAngle > 30 && report.hInside[0] <= report.hInside[1] && report.intersectionsChecked);
    assert.equal(report.text, library.describe("outcome", "converged").text);
});

test("normals and curvature in any way", () => {
    const flat = { ...sheets([{ shape: 1, reach: 1 }]) };
    for (let k = 2; k < flat.positions.length; k += 3) flat.positions[k] = 0;
    const normals = new Float64Array(flat.positions.length).fill(NaN);
    const rim = library.fair(flat, flat.free).boundaryVertices;
    const tilted = [0.1, 0, Math.sqrt(0.99)];
    rim.forEach((v) => normals.set(tilted, 3 * v));
    const given = library.fair(flat, flat.free, { boundaryNormals: normals });
    const vectors = Array.from(rim).flatMap(() => tilted);
    const listed = library.fair(flat, flat.free, { boundaryNormals: { vertices: rim, vectors } });
    assert.deepEqual(given.positions, listed.positions);
    const curvature = new Float64Array(flat.positions.length / 3).fill(NaN);
    rim.forEach((v) => (curvature[v] = -1));
    const by = (boundaryCurvature) => library.fair(flat, flat.free, { continuity: "g2", boundaryCurvature }).positions;
    assert.deepEqual(by(curvature), by({ vertices: rim, values: new Float64Array(rim.length).fill(-1) }));
});

test("sharp edges go on where that is asked for", () => {
    const roof = sheets([{ side: 15, frame: 4, shape: 1, reach: 7 }]);
    const p = roof.positions;
    for (let k = 0; k < p.length; k += 3) p[k + 2] = roof.free[k / 3] ? -3 : -Math.abs(p[k + 1]);
    const worst = (q) => Math.max(...Array.from(roof.free.keys(), (v) => Math.abs(q[3 * v + 2] + Math.abs(q[3 * v + 1]))));
    const auto = library.fair(roof, roof.free, { sharp: "auto" });
    const off = library.fair(roof, roof.free, { sharp: "off" });
    assert.ok(worst(auto.positions) < 1e-9 && worst(off.positions) > 0.1);
    assert.deepEqual(off.report.sharpEdges, []);
    assert.deepEqual(library.fair(roof, roof.free, { sharp: 20 }).positions, auto.positions);
    assert.equal(auto.report.sharpEdges.length, 1);
    const [edge] = auto.report.sharpEdges;
    assert.equal(edge.fate, "goes_on");
    assert.ok(library.describe("sharpFate", edge.fate).text.includes("goes on"));
    assert.ok(edge.vertices.length > 2);
    for (const v of edge.vertices) assert.ok(Math.abs(auto.positions[3 * v + 2]) < 1e-9);
    for (const end of edge.ends) {
        assert.ok(Math.abs(end.angle - 90) < 1e-6);
        assert.ok(edge.vertices.includes(end.vertex));
        assert.ok(Math.abs(Math.abs(end.direction[0]) - 1) < 1e-6);
    }
    for (let k = 2; k < p.length; k += 3) p[k] *= 0.1;
    const onRidge = Array.from({ length: p.length / 3 }, (_, v) => v).filter((v) => Math.abs(p[3 * v + 1]) < 1e-9);
    const markedEdges = onRidge.slice(1).map((v, k) => [onRidge[k], v]);
    assert.deepEqual(library.fair(roof, roof.free).report.sharpEdges, []);
    const marked = library.fair(roof, roof.free, { sharp: "off", markedEdges });
    assert.equal(marked.report.sharpEdges[0].fate, "goes_on");
    for (const v of marked.report.sharpEdges[0].vertices) assert.ok(Math.abs(marked.positions[3 * v + 2]) < 1e-9);
    assert.throws(() => library.fair(roof, roof.free, { markedEdges: [1, 2, 3] }), { message: "markedEdges: rows of 2 are needed, not 3 vertices" });
    assert.throws(() => library.fair(roof, roof.free, { sharp: "on" }), { message: 'sharp: "on" is neither "auto" nor "off" nor a number' });
});

test("in steps it finds the same", () => {
    const whole = library.fair(mesh, mesh.free);
    const solver = library.solver(mesh, mesh.free);
    let runs = 1;
    while (solver.run(1).outcome === "iteration_limit") runs++;
    assert.equal(runs, whole.report.iterations);
    assert.deepEqual(solver.positions, whole.positions);
    assert.deepEqual(solver.result().boundaryVertices, whole.boundaryVertices);
    assert.deepEqual(solver.meanCurvature, whole.meanCurvature);
    solver.setTarget(1);
    assert.ok(solver.run().isSuccess);
    assert.notDeepEqual(solver.positions, whole.positions);
    solver.setTarget("harmonic");
    solver.setContinuity("g1");
    solver.setBoundaryNormals("averaged");
    solver.setBoundaryCurvature("estimated");
    assert.equal(solver.run().outcome, solver.report.outcome);
    solver.close();
    solver.close();
    assert.throws(() => solver.run(), { name: "FairmeshError", message: "the solver is closed", status: "bad_handle" });
});

test("holes are found and filled", () => {
    const open = sheets([{ side: 25, frame: 9, shape: 2, reach: 0.6 }], { hole: true });
    const loops = library.boundaryLoops(open, { roughness: true });
    assert.deepEqual(loops.map(({ kind }) => kind).sort(), ["hole", "outer_boundary"]);
    const at = loops.findIndex(({ kind }) => kind === "hole");
    assert.equal(loops[at].vertices.length, loops[at].vertexCount);
    assert.ok(loops[at].hasRoughness && !loops[at].isRough);
    const filled = library.fillHoles(open);
    // Its rim is no noise.
    assert.deepEqual(library.fillHoles(open, { relaxRim: "auto" }).positions, filled.positions);
    assert.throws(() => library.fillHoles(open, { relaxRim: "some" }), /relaxRim/);
    const done = filled.loops.find(({ loopIndex }) => loopIndex === at);
    assert.ok(done.report.isSuccess && done.vertexCount === filled.newVertexCount && filled.newVertexCount > 10);
    assert.deepEqual(filled.positions.subarray(0, open.positions.length), open.positions);
    assert.deepEqual(filled.triangles.subarray(0, open.triangles.length), open.triangles);
    assert.equal(filled.parents.length, 3 * filled.newVertexCount);
});

test("loops are joined, and a bridge is made", () => {
    const two = tubes();
    assert.deepEqual(Array.from(new Set(library.components(two))), [0, 1]);
    const inner = library.boundaryLoops(two).flatMap(({ vertices }, k) => (Math.abs(two.positions[3 * vertices[0] + 2]) < 0.6 ? [k] : []));
    const [found] = library.suggestJoins(two, { loops: inner });
    assert.equal(found.gapKind, "gap");
    assert.deepEqual(Array.from(found.loops), inner);
    assert.ok(found.jointBend < found.separateBend);
    assert.equal(library.fillHoles(two, { join: "auto", loops: inner }).loops[0].gapKind, "gap");

    // Of each rim the vertices 0 to 4: the first ring of the upper tube, the last one of the lower.
    const chains = [0, 15].map((ring) => [0, 1, 2, 3, 4].map((i) => 32 * ring + i));
    const strip = library.bridge(two, chains[0], chains[1]);
    assert.deepEqual(Array.from(strip.chains[0]).sort((a, b) => a - b), chains[0]);
    assert.ok(strip.newTriangleCount > 0 && strip.rest.length === 0 && strip.whole === null && strip.isSuccess);
    assert.ok(strip.sides[0].length > 0 && strip.sides[1].length > 0 && Math.abs(strip.twist) < 0.1);
    assert.ok(library.bridge(two, chains[0], chains[1], { fill: true }).whole.isSuccess);
});

test("regions are chosen, erased, trimmed and carried over", () => {
    const ball = library.selectBall(mesh, [0, 0, 0.9], 0.3);
    const count = ball.reduce((sum, is) => sum + is, 0);
    assert.ok(count > 50 && count < ball.length);
    const both = library.selectRegion(mesh, [
        { kind: "all" },
        { kind: "ball", point: [0, 0, 0.9], value: 0.3, combine: "remove" },
        { kind: "invert" },
    ]);
    assert.deepEqual(both.mask, ball);
    assert.deepEqual(Array.from(both.counts), [1152, count, count]);

    const erased = library.erase(mesh, ball);
    assert.equal(erased.triangles.length / 3 + count + erased.droppedCount, mesh.triangles.length / 3);
    assert.equal(erased.loops.length, 1);
    const left = { positions: mesh.positions, triangles: erased.triangles };
    assert.ok(library.trimBoundary(left, 10).droppedCount <= 10);
    const filled = library.fillHoles(left, { loops: erased.loops });
    const fresh = filled.positions.subarray(mesh.positions.length);
    const carried = library.carryOver(mesh, fresh, ball);
    assert.equal(carried.triangles.length, filled.newVertexCount);
    assert.ok(carried.triangles.every((triangle) => ball[triangle] === 1));
    assert.deepEqual(Array.from(library.carryOver(mesh, [NaN, 0, 0]).corners), [-1, -1, -1]);
});

test("a bump is found, and told", () => {
    const n = 41;
    const flat = sheets([{ shape: 1, reach: 1, side: n }]);
    for (let v = 0; v < n * n; v++) {
        const [x, y] = flat.positions.subarray(3 * v);
        flat.positions[3 * v + 2] = 0.1 * Math.exp(-40 * (x * x + y * y));
    }
    const { bumps, mask, triangles } = library.selectRegion(flat, [{ kind: "bump", seed: [0, 0, 0.1] }]);
    assert.equal(bumps.length, 1);
    assert.equal(bumps[0].triangleCount, triangles.length);
    assert.ok(bumps[0].radius > 0.1 && bumps[0].radius < 0.8);
    assert.deepEqual(library.selectBump(flat, [0, 0, 0.1]), mask);
});

test("curvature and intersections of whole meshes", () => {
    const round = library.meanCurvature(sheets([{}]));
    assert.ok(Math.abs(round[312] + 1) < 1e-2);
    assert.equal(library.selfIntersections(mesh).length, 0);
    const crossing = { positions: [0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, -1, 0.5, 0.5, 1, 3, 3, 0], triangles: [0, 1, 2, 3, 4, 5] };
    assert.deepEqual(Array.from(library.selfIntersections(crossing)), [0, 1]);
    assert.deepEqual(Array.from(library.selfIntersections(crossing, [1])), [0, 1]);
});

test("a cube's edges are rounded", () => {
    const box = cube(4);
    const width = 0.2;
    const made = library.roundEdges(box, { width });
    assert.ok(made.isSuccess && made.report.outcome === "converged");
    assert.equal(made.creases.length, 12);
    assert.ok(made.creases.every(({ isRounded, bend, part, vertices }) => isRounded && Math.abs(bend - 90) < 1e-9 && part === 1 && vertices.length === 5));
    assert.ok(made.sharpCorners.length === 0 && made.angle > 0 && made.angle < 90);
    // Away from the corners each edge is a cylinder.
    const inner = 1 - width;
    let farthest = 0;
    for (let k = 0; k < made.positions.length; k += 3) {
        const p = Array.from(made.positions.subarray(k, k + 3));
        if (p.filter((x) => Math.abs(x) > 1 - 3 * width).length > 2) continue;
        farthest = Math.max(farthest, Math.abs(Math.hypot(...p.map((x) => Math.max(Math.abs(x) - inner, 0))) - width));
    }
    assert.ok(farthest < 1e-3, `${farthest}`);
    const vertexCount = made.positions.length / 3;
    assert.equal(made.keptVertices.length, vertexCount - made.newVertexCount);
    assert.equal(made.keptTriangles.length, made.triangles.length / 3 - made.newTriangleCount);
    made.keptVertices.forEach((from, to) => {
        assert.deepEqual(made.positions.subarray(3 * to, 3 * to + 3), box.positions.subarray(3 * from, 3 * from + 3));
    });
    assert.ok(made.freeVertices.length > 0 && made.freeVertices.every((v) => v >= made.keptVertices.length && v < vertexCount));
});

test("one edge is rounded by a ball, and which options there are", () => {
    const box = cube(4);
    const onEdge = [];
    box.positions.forEach((x, k) => k % 3 === 0 && x === 1 && box.positions[k + 1] === 1 && onEdge.push(k / 3));
    onEdge.sort((a, b) => box.positions[3 * a + 2] - box.positions[3 * b + 2]);
    const height = (v) => box.positions[3 * v + 2];
    const ends = onEdge.filter((v, k) => k === 0 || height(v) !== height(onEdge[k - 1]));
    const edges = ends.slice(1).map((v, k) => [ends[k], v]);
    const made = library.roundEdges(box, { radius: 0.2, edges, tolerance: 1e-6, maxIterations: 100, intersections: "skip" });
    assert.equal(made.creases.filter(({ isRounded }) => isRounded).length, 1);
    assert.ok(made.isSuccess && !made.report.intersectionsChecked);
    assert.throws(() => library.roundEdges(box, { radius: 0.2, edges: [[0, 12]] }), { status: "not_an_edge" });
    assert.throws(() => library.roundEdges(box, { width: 0.2, creases: "concave" }), { status: "no_crease" });
    assert.throws(() => library.roundEdges(box, { width: 0.2, creases: "round" }), { message: 'creases: "round" is none of "all", "convex", "concave"' });
    assert.throws(() => library.roundEdges(box, { widht: 0.2 }), { message: 'unknown option "widht"; did you mean "width"?' });
    assert.throws(() => library.roundEdges(box, { width: 0.2, target: 1 }), { name: "TypeError" });
    const smoother = library.roundEdges(cube(2), { width: 0.3, continuity: "g2" });
    const loops = smoother.report.components.flatMap(({ continuity }) => continuity);
    assert.ok(smoother.isSuccess && loops.length > 0 && loops.every(({ reached }) => reached > 0.95));
    assert.throws(() => library.roundEdges(box, { width: 0.2, progress: () => false }), { status: "cancelled" });
});

test("defaults are the library's", () => {
    const all = library.defaultOptions();
    assert.equal(all.tolerance, 1e-8);
    assert.equal(all.innerFairness, "uniform");
    assert.equal(all.maxIterations, 500);
    assert.ok(!("progress" in all));
    assert.equal(library.defaultFillOptions().maxNewVertices, 200000);
    assert.ok(library.defaultRemeshOptions().density > 1.4);
    assert.equal(library.defaultRoundOptions().creases, "all");
    assert.match(version, /^\d+\.\d+\.\d+$/);
    assert.deepEqual(library.fair(mesh, mesh.free, { tolerance: all.tolerance, discretization: all.discretization }).positions, library.fair(mesh, mesh.free).positions);
});

test("a hundred thousand triangles", () => {
    const large = dent(225, 60);
    assert.ok(large.triangles.length / 3 > 1e5);
    const result = library.fair(large, large.free);
    assert.equal(result.outcome, "converged");
    assert.ok(offSphere(result.positions) < 1e-9, `${offSphere(result.positions)}`);
});
