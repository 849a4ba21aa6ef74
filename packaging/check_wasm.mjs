// Loads the WebAssembly module as a host without any bindings does: node check_wasm.mjs fairmesh.wasm. Fairs a dented plane, and prints
// the names of what the module exports.
import { readFileSync } from "node:fs";

const module = await WebAssembly.compile(readFileSync(process.argv[2]));
if (WebAssembly.Module.imports(module).length > 0) throw new Error("the module imports something");
const wasm = (await WebAssembly.instantiate(module)).exports;

const side = 9;
const vertices = side * side;
const triangles = 2 * (side - 1) ** 2;
const reserve = (bytes) => {
    const at = wasm.fairmesh_wasm_allocate(bytes);
    if (at === 0) throw new Error("no memory");
    return at;
};
const points = reserve(24 * vertices);
const corners = reserve(12 * triangles);
const mesh = reserve(48);
const out = reserve(20);
// Memory may have moved: views are made after the last allocation.
const positions = new Float64Array(wasm.memory.buffer, points, 3 * vertices);
const middle = 3 * (vertices >> 1) + 2;
for (let v = 0; v < vertices; v++) positions.set([v % side, Math.floor(v / side), 0], 3 * v);
positions[middle] = -1;
const indices = new Uint32Array(wasm.memory.buffer, corners, 3 * triangles);
let t = 0;
for (let j = 0; j + 1 < side; j++) {
    for (let i = 0; i + 1 < side; i++) {
        const a = side * j + i;
        indices.set([a, a + 1, a + side + 1, a, a + side + 1, a + side], t);
        t += 6;
    }
}
const FLOAT64 = 2;
// As the header says, with pointers and sizes of four bytes.
new Uint32Array(wasm.memory.buffer, mesh, 12).set([48, 0, points, vertices, 0, FLOAT64, 0, corners, triangles, 0, 0, 0]);
new Uint32Array(wasm.memory.buffer, out, 5).set([points, vertices, 0, FLOAT64, 0]);
const status = wasm.fairmesh_fair(mesh, 0, 0, out, 0, 0, 0);
const z = new Float64Array(wasm.memory.buffer, points, 3 * vertices)[middle];
if (status !== 0 || !(Math.abs(z) < 1e-6)) throw new Error(`status ${status}, the middle at ${z}`);
wasm.fairmesh_wasm_free(points, 24 * vertices);
wasm.fairmesh_wasm_free(corners, 12 * triangles);
for (const { name } of WebAssembly.Module.exports(module)) console.log(name);
