// One fair and one fill on a sheet, by the npm package that is installed.
import assert from "node:assert/strict";
import { load } from "fairmesh";

const fairmesh = await load();
const n = 21;
const inside = (v) => Math.hypot((v % n) - 10, Math.floor(v / n) - 10) < 7;
const positions = new Float64Array(3 * n * n);
const triangles = [];
const around = [];
for (let v = 0; v < n * n; v++) {
    positions.set([v % n, Math.floor(v / n), inside(v) ? -2 : 0], 3 * v);
    if (v % n === n - 1 || v >= n * (n - 1)) continue;
    for (const t of [[v, v + 1, v + n + 1], [v, v + n + 1, v + n]]) {
        triangles.push(...t);
        if (!t.some(inside)) around.push(...t);
    }
}
const isFlat = (of) => of.every((x, k) => k % 3 < 2 || Math.abs(x) < 1e-6);

const faired = fairmesh.fair({ positions, triangles }, Uint8Array.from({ length: n * n }, (_, v) => Number(inside(v))));
assert.equal(faired.outcome, "converged");
assert(isFlat(faired.positions));

const filled = fairmesh.fillHoles({ positions: faired.positions, triangles: around });
assert(filled.triangles.length > around.length && isFlat(filled.positions));
console.log("node", process.version);
