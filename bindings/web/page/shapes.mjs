/**
 * Makes the shapes of the page: node shapes.mjs PROGRAM HEAD.FIF FOLDER. Surfaces by the command line, a bracket, and the head from a file of the Python
 * package MNE. Each becomes NAME.bin.gz: four counts, then positions (double), normals given (vertex, then x, y, z as doubles), corners, and free vertices,
 * these two as differences.
 * The first one is there faired, too, as NAME-faired.bin.gz with positions alone (float): the page shows it before its own solver is awake.
 */

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const [program, head, folder] = process.argv.slice(2);
const GENERATED = {
    // All but the rings around the hole is free, and starts with bumps and a dent.
    sphere: ["sphere-hole", "--vertices", "5000", "--angle", "35", "--raise=0.95,0.2,-0.24,0.6,0.4", "--raise=-0.5,0.8,-0.33,0.6,-0.35", "--raise=-0.2,-0.9,-0.4,0.5,0.3"],
    blend: ["cylinder-blend", "--vertices", "5000"],
    blend13k: ["cylinder-blend", "--vertices", "13308"],
    tetra: ["tetra-thing", "--vertices", "5000"],
};

const FIRST = "blend";

const numbers = (path) => readFileSync(path, "utf8").split("\n").filter(Boolean).map((line) => line.trim().split(/\s+/).map(Number));

/** The hole, which is at the bottom of the z axis, comes to the top of the picture. */
const upright = ([x, y, z]) => [x, -z, y];

/** Vertices and triangles of an OBJ file. */
function read(path) {
    const made = { positions: [], triangles: [] };
    for (const line of readFileSync(path, "utf8").split("\n")) {
        const [what, ...rest] = line.split(" ");
        if (what === "v") made.positions.push(...rest.map(Number));
        if (what === "f") made.triangles.push(...rest.map((corner) => parseInt(corner, 10) - 1));
    }
    return made;
}

function generated(given) {
    const work = mkdtempSync(join(tmpdir(), "shapes-"));
    const [mesh, free, normals, faired] = ["mesh.obj", "free", "normals", "faired.obj"].map((name) => join(work, name));
    execFileSync(program, ["generate", ...given, "--quiet", "-o", mesh, "--free", free, "--normals", normals]);
    const made = { free: numbers(free).flat(), normals: numbers(normals) };
    Object.assign(made, read(mesh));
    execFileSync(program, ["fair", mesh, "--free", free, "--normals", normals, "--quiet", "-o", faired]);
    made.faired = read(faired).positions;
    rmSync(work, { recursive: true });
    if (given[0] === "sphere-hole") {
        made.positions = made.positions.flatMap((_, k, all) => (k % 3 === 0 ? upright(all.slice(k, k + 3)) : []));
        made.normals = made.normals.map(([vertex, ...normal]) => [vertex, ...upright(normal)]);
    }
    return made;
}

// Of MNE's constants.py: FIFF_BEM_SURF_NODES and FIFF_BEM_SURF_TRIANGLES; matrices end with their sizes, and FIF is big-endian.
const [NODES, TRIANGLES] = [3105, 3106];

/** The head in a FIF file: tags of kind, type, size and the place of the next one (0: behind this one). */
function scanned(path) {
    const bytes = readFileSync(path);
    const made = { positions: [], triangles: [], free: [], normals: [] };
    for (let at = 0; at + 16 <= bytes.length; ) {
        const [kind, size, next] = [0, 8, 12].map((offset) => bytes.readInt32BE(at + offset));
        const data = bytes.subarray(at + 16, at + 16 + size);
        const count = (size - 12) / 4;
        // To the right, to the front, up, in metres: here up is the second one, the face looks at the eye, and lengths are in centimetres.
        const number = (k) => 100 * data.readFloatBE(4 * k);
        if (kind === NODES) for (let k = 0; k < count; k += 3) made.positions.push(-number(k), number(k + 2), number(k + 1));
        if (kind === TRIANGLES) for (let k = 0; k < count; k++) made.triangles.push(data.readInt32BE(4 * k) - 1);
        if (next < 0) break;
        at = next === 0 ? at + 16 + size : next;
    }
    if (made.triangles.length === 0) throw new Error(`${path}: no surface was found`);
    return made;
}

/** A bracket: an L, extruded. */
function bracket() {
    const corners = [[0, 0], [2, 0], [2, 0.5], [0.5, 0.5], [0.5, 2], [0, 2]];
    const positions = [0, 1].flatMap((z) => corners.flatMap(([x, y]) => [x - 1, y - 1, z - 0.5]));
    const cap = [[3, 4, 5], [3, 5, 0], [3, 0, 1], [3, 1, 2]];
    const sides = corners.flatMap((_, i) => {
        const j = (i + 1) % 6;
        return [[i, j, j + 6], [i, j + 6, i + 6]];
    });
    const triangles = [...cap.map(([a, b, c]) => [a, c, b]), ...cap.map((t) => t.map((v) => v + 6)), ...sides].flat();
    return { positions, triangles, free: [], normals: [] };
}

/** The first bytes of all numbers, then the second ones: bytes of one kind are compressed by a third more. */
function planes(array) {
    const [bytes, size] = [new Uint8Array(array.buffer), array.BYTES_PER_ELEMENT];
    return Buffer.from(bytes.map((_, at) => bytes[(at % array.length) * size + Math.floor(at / array.length)]));
}
const differences = (array) => array.map((number, k) => number - (k === 0 ? 0 : array[k - 1]));
const zipped = (arrays) => gzipSync(Buffer.concat(arrays.map(planes)), { level: 9 });

function packed({ positions, triangles, free, normals }) {
    const counts = Uint32Array.of(positions.length / 3, normals.length, triangles.length / 3, free.length);
    const arrays = [counts, Float64Array.from(positions), Float64Array.from(normals.flat()), differences(Uint32Array.from(triangles)), differences(Uint32Array.from(free))];
    return zipped(arrays);
}

mkdirSync(folder, { recursive: true });
const shapes = { ...Object.fromEntries(Object.entries(GENERATED).map(([name, given]) => [name, generated(given)])), head: scanned(head), bracket: bracket() };
for (const [name, shape] of Object.entries(shapes)) writeFileSync(join(folder, `${name}.bin.gz`), packed(shape));
writeFileSync(join(folder, `${FIRST}-faired.bin.gz`), zipped([Float32Array.from(shapes[FIRST].faired)]));
