/** Files that are handed to the page: good ones, and bad ones with what the page has to say. */

import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const folder = mkdtempSync(join(tmpdir(), "files-"));

/** A file with this name and content. */
export function file(name, content) {
    writeFileSync(join(folder, name), content);
    return join(folder, name);
}

/** A sphere of so many rings without its caps, as text of STL: every corner by itself. */
export function openSphere(rings = 16, around = 24) {
    const at = (i, j) => {
        const [a, b] = [(Math.PI * (i + 2)) / (rings + 4), (2 * Math.PI * (j % around)) / around];
        return [Math.sin(a) * Math.cos(b), Math.sin(a) * Math.sin(b), Math.cos(a)].map((x) => Math.fround(x).toPrecision(9)).join(" ");
    };
    const facet = (corners) => `facet normal 0 0 0\nouter loop\n${corners.map((corner) => `vertex ${corner}`).join("\n")}\nendloop\nendfacet\n`;
    let text = "solid sphere\n";
    for (let i = 0; i < rings; i++) {
        for (let j = 0; j < around; j++) {
            text += facet([at(i, j), at(i + 1, j), at(i + 1, j + 1)]) + facet([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    return `${text}endsolid sphere\n`;
}

const HEADER = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

/** Name, content, and what has to be said. */
export const BAD = [
    ["empty.ply", "", /^Empty\.ply is empty\. Take a PLY, OBJ or STL file\.$/i],
    ["notes.txt", "hello", /files that end with "\.txt" are not read\. Take a PLY, OBJ or STL file\.$/],
    ["picture.ply", "\x89PNG....", /is no PLY file: it does not begin with "ply"/],
    ["cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", /its header does not end\. The file is cut off: load it anew\.$/],
    ["points.ply", HEADER.replace("element face 1\nproperty list uchar int vertex_indices\n", "") + "0 0 0\n1 0 0\n0 1 0\n", /has no triangles\. Save it with faces/],
    ["index.ply", `${HEADER}0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n`, /a face names vertex 7, but there are only 3/],
    ["short.stl", "binary", /is no STL file: it has not the size that it says/],
    ["face.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", /face\.obj, line 4: this is no face: f 1 2 x/i],
    ["nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", /has a coordinate that is no number/],
];

/** A sheet of five by five vertices, and a triangle on an edge inside it, which has two already. */
export function fin() {
    const at = (i, j) => 5 * j + i + 1;
    const inner = [0, 1, 2, 3];
    const faces = inner.flatMap((j) => inner.flatMap((i) => [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]));
    const places = Array.from({ length: 25 }, (_, v) => [v % 5, Math.floor(v / 5), 0]);
    const line = (what) => (numbers) => `${what} ${numbers.join(" ")}\n`;
    return [...places, [2, 2, 1]].map(line("v")).join("") + [...faces, [at(1, 2), at(2, 2), 26]].map(line("f")).join("");
}

/** The open sphere with so many holes more, of one triangle and those around its corners each. */
export function sieve(holes, rings = 24, around = 36) {
    const facets = openSphere(rings, around).split("facet normal").slice(1);
    const at = (k) => 2 * (around * (4 + 5 * (k % 3)) + Math.floor((around * Math.floor(k / 3)) / Math.ceil(holes / 3)) + 2 * (k % 3));
    const gone = new Set(Array.from({ length: holes }, (_, k) => [0, 1, 2, 3].map((t) => at(k) + t)).flat());
    return `solid sieve\n${facets.filter((_, t) => !gone.has(t)).map((facet) => `facet normal${facet}`).join("").replace("endsolid sphere\n", "")}endsolid sieve\n`;
}
