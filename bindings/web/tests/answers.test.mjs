/** The library's answers, tests/answers.json of the repository, come through: each option arrives, and all that is found comes back. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { InputError, load } from "fairmesh";

const { meshes, cases } = JSON.parse(readFileSync(new URL("answers.json", import.meta.url)));
const library = await load();

const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
/** Names of the file, which are Python's. */
const here = (name) => camel(name).replace(/faces$/, "triangles").replace(/Faces$/, "Triangles").replace("face", "triangle");
const withFields = (given) => Object.fromEntries(Object.entries(given).map(([name, value]) => [camel(name), value]));

/** Single numbers in the call come before the options of `calls`. */
const CALLS = {
    select_ball: ["centre", "radius"],
    select_box: ["low", "high"],
    select_halfspace: ["point", "normal"],
    select_geodesic: ["seed", "radius"],
    select_patch: ["seed", "angle"],
    select_component: ["seed"],
    grow: ["region", "rings"],
    shrink: ["region", "rings"],
    erase: ["erased"],
    bridge: ["start", "end"],
};

function run({ call, mesh, options }) {
    const { faces, free, within, target, ...rest } = options;
    const given = { positions: meshes[mesh].vertices, triangles: faces ?? meshes[mesh].faces };
    const first = (CALLS[call] ?? []).map((name) => rest[name]);
    for (const name of CALLS[call] ?? []) delete rest[name];
    const asked = withFields(rest);
    if (within) asked.within = Array.isArray(within[1]) ? { low: within[0], high: within[1] } : { centre: within[0], radius: within[1] };
    if (target !== undefined) asked.target = target === "inf" ? Infinity : target;
    if (["fair", "remesh", "refill"].includes(call)) first.push(free ?? meshes[mesh].free);
    return library[camel(call)](given, ...first, asked);
}

function near(found, expected, name) {
    assert.ok(Math.abs(found - expected) <= 1e-8 * Math.max(1, Math.abs(expected)), `${name}: ${found}, not ${expected}`);
}

/** Numbers, or lists of them, nearly; the rest exactly. */
function same(found, expected, name) {
    if (typeof expected === "number") near(found, expected, name);
    else if (Array.isArray(expected)) expected.forEach((value, k) => same(found[k], value, `${name}.${k}`));
    else assert.deepEqual(found, expected, name);
}

/** Vectors of three numbers, or numbers, at some places. */
function samples(found, expected, name) {
    for (const [at, value] of expected) {
        if (Array.isArray(value)) same(Array.from(found.subarray(3 * at, 3 * at + 3)), value, `${name} ${at}`);
        else near(found[at], value, `${name} ${at}`);
    }
}

function loop(found, expected) {
    const { loop_indices, edge_count, outcome, reason, vertices, faces } = expected;
    assert.deepEqual(Array.from(found.loopIndices), loop_indices);
    assert.deepEqual([found.edgeCount, found.outcome, found.reason], [edge_count, outcome, reason]);
    assert.deepEqual([found.firstVertex, found.vertexCount], [vertices[0], vertices[1] - vertices[0]]);
    assert.deepEqual([found.firstTriangle, found.triangleCount], [faces[0], faces[1] - faces[0]]);
}

function faired(result, expected) {
    for (const [name, value] of Object.entries(expected.report)) same(result.report[camel(name)], value, name);
    samples(result.meanCurvature, expected.mean_curvature, "H");
    samples(result.gaussianCurvature, expected.gaussian_curvature, "K");
    const places = Array.from(result.boundaryVertices);
    samples(result.boundaryNormals, expected.boundary_normals.map(([v, normal]) => [places.indexOf(v), normal]), "normal");
    const { continuity } = result.report.components[0];
    assert.equal(continuity.length, expected.continuity.length);
    expected.continuity.forEach((told, k) => {
        for (const [name, value] of Object.entries(told)) same(continuity[k][name], value, name);
    });
}

function bridged(result, expected) {
    assert.deepEqual(result.chains.map((chain) => Array.from(chain).sort((a, b) => a - b)), expected.chains);
    assert.deepEqual(result.sides.map((side) => side.length), expected.sides);
    assert.deepEqual([result.rest.length, result.whole?.outcome ?? null], [expected.rest, expected.whole]);
    loop(result.strip, expected.strip);
}

for (const one of cases.filter(({ answer }) => answer)) {
    test(`answer: ${one.name}`, () => {
        const { call, answer } = one;
        const result = run(one);
        if (result instanceof Uint8Array) {
            assert.deepEqual(Array.from(result.keys()).filter((k) => result[k]), answer.faces);
            return;
        }
        samples(result.positions, answer.positions ?? [], "position");
        if (answer.vertex_count !== undefined) assert.equal(result.positions.length, 3 * answer.vertex_count);
        if (answer.face_count !== undefined) assert.equal(result.triangles.length, 3 * answer.face_count);
        for (const name of ["kept_vertices", "kept_faces", "free_vertices"]) {
            if (answer[name] !== undefined) assert.equal(result[here(name)].length, answer[name], name);
        }
        if (call === "fair") faired(result, answer);
        if (call === "bridge") bridged(result, answer);
        if (call === "erase") assert.deepEqual([result.droppedCount, Array.from(result.loops)], [answer.dropped_count, answer.loops]);
        if (call === "fill_holes") {
            assert.equal(result.loops.length, answer.loops.length);
            answer.loops.forEach((told, k) => loop(result.loops[k], told));
            const step = Math.max(1, Math.floor(result.newVertexCount / 3));
            answer.parents.forEach(([parents, weights], k) => {
                assert.deepEqual(Array.from(result.parents.subarray(3 * step * k, 3 * step * k + 3)), parents);
                same(result.parentWeights.subarray(3 * step * k), weights, "weights");
            });
        }
    });
}

for (const one of cases.filter(({ error }) => error)) {
    test(`error: ${one.name}`, () => {
        const { status, element_kind, message } = one.error;
        assert.throws(() => run(one), (why) => {
            assert.ok(why instanceof InputError, `${why}`);
            assert.deepEqual([why.status, why.elementKind], [status, element_kind]);
            assert.equal(why.message.replace(camel(one.name), one.name), message);
            if (element_kind === "argument") assert.equal(why.argument, camel(one.name));
            return true;
        });
    });
}
