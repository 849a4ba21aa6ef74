/** Files of the person: read, said what is wrong with them, and written. */

import { BufferAttribute, BufferGeometry, Mesh } from "three";
import { OBJExporter } from "three/examples/jsm/exporters/OBJExporter.js";
import { PLYExporter } from "three/examples/jsm/exporters/PLYExporter.js";
import { STLExporter } from "three/examples/jsm/exporters/STLExporter.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";
import type { Triangles } from "./surface.js";

/** What is wrong with a file, and what can be done. */
export class FileError extends Error {
    constructor(
        message: string,
        readonly remedy: string,
    ) {
        super(message);
    }
}

const FORMATS = "take a PLY, OBJ or STL file";

/** Reads a mesh. Corners at the same place become one vertex, as STL files need it. */
export function readMesh(name: string, data: ArrayBuffer): Triangles {
    const ending = name.toLowerCase().split(".").at(-1) ?? "";
    if (data.byteLength === 0) throw new FileError(`${name} is empty`, FORMATS);
    const soup = ending === "ply" ? ply(name, data) : ending === "stl" ? stl(name, data) : ending === "obj" ? obj(name, data) : null;
    if (soup === null) throw new FileError(`${name}: files that end with ".${ending}" are not read`, FORMATS);
    if (soup.triangles.length === 0) throw new FileError(`${name} has no triangles`, "save it with faces: points alone are no surface");
    if (soup.positions.some((x) => !Number.isFinite(x))) throw new FileError(`${name} has a coordinate that is no number`, "save it anew");
    const count = soup.positions.length / 3;
    const wrong = soup.triangles.find((v) => v >= count);
    if (wrong !== undefined) {
        throw new FileError(`${name}: a face names vertex ${wrong}, but there are only ${count}`, "save it anew: vertices of it are missing");
    }
    return welded(soup);
}

function ply(name: string, data: ArrayBuffer): Triangles {
    const head = new TextDecoder("latin1").decode(data.slice(0, 4096));
    if (!head.startsWith("ply")) throw new FileError(`${name} is no PLY file: it does not begin with "ply"`, FORMATS);
    if (!/^end_header/m.test(new TextDecoder("latin1").decode(data.slice(0, 65536)))) {
        throw new FileError(`${name}: its header does not end`, "the file is cut off: load it anew");
    }
    let read: BufferGeometry;
    try {
        read = new PLYLoader().parse(data);
    } catch (why) {
        throw new FileError(`${name} cannot be read as PLY (${(why as Error).message})`, "the file is damaged or cut off: save it anew");
    }
    return of(read);
}

function stl(name: string, data: ArrayBuffer): Triangles {
    const isText = new TextDecoder("latin1").decode(data.slice(0, 5)) === "solid";
    const told = data.byteLength < 84 ? -1 : new DataView(data).getUint32(80, true);
    if (!isText && data.byteLength !== 84 + 50 * told) {
        throw new FileError(`${name} is no STL file: it has not the size that it says`, "the file is damaged or cut off: save it anew");
    }
    return of(new STLLoader().parse(data));
}

/** Vertices and faces of an OBJ file, polygons as fans. three.js keeps no indices of them. */
function obj(name: string, data: ArrayBuffer): Triangles {
    const positions: number[] = [];
    const triangles: number[] = [];
    new TextDecoder().decode(data).split("\n").forEach((line, number) => {
        const [what, ...rest] = line.trim().split(/\s+/);
        if (what === "v") positions.push(...rest.slice(0, 3).map(Number));
        if (what !== "f") return;
        const corners = rest.map((corner) => parseInt(corner, 10));
        if (corners.length < 3 || corners.some((c) => !Number.isInteger(c) || c === 0)) {
            throw new FileError(`${name}, line ${number + 1}: this is no face: ${line.slice(0, 60)}`, "save it anew");
        }
        const indices = corners.map((c) => (c > 0 ? c - 1 : positions.length / 3 + c));
        for (let k = 2; k < indices.length; k++) triangles.push(indices[0]!, indices[k - 1]!, indices[k]!);
    });
    if (positions.length === 0) throw new FileError(`${name} is no OBJ file: it has no line with a vertex`, FORMATS);
    return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

function of(read: BufferGeometry): Triangles {
    const positions = Float64Array.from(read.getAttribute("position")?.array ?? []);
    const index = read.getIndex()?.array;
    // Points alone have no index, too.
    const count = read.hasAttribute("normal") || index ? positions.length / 3 : 0;
    return { positions, triangles: Uint32Array.from(index ?? Array.from({ length: count - (count % 3) }, (_, k) => k)) };
}

/** Vertices at exactly the same place become one; vertices without triangles go. */
function welded({ positions, triangles }: Triangles): Triangles {
    const places = new Map<string, number>();
    const kept: number[] = [];
    const corners = Array.from(triangles, (v) => {
        const [x, y, z] = [positions[3 * v]! + 0, positions[3 * v + 1]! + 0, positions[3 * v + 2]! + 0];
        const place = `${x} ${y} ${z}`;
        const known = places.get(place);
        if (known !== undefined) return known;
        kept.push(x, y, z);
        places.set(place, kept.length / 3 - 1);
        return kept.length / 3 - 1;
    });
    const whole: number[] = [];
    for (let k = 0; k < corners.length; k += 3) {
        const [a, b, c] = corners.slice(k, k + 3) as [number, number, number];
        if (a !== b && b !== c && c !== a) whole.push(a, b, c);
    }
    return { positions: Float64Array.from(kept), triangles: Uint32Array.from(whole) };
}

export type Format = "ply" | "obj" | "stl";

/** A mesh as a file. Text with all digits, but for STL, which has no more than single precision. */
export function written({ positions, triangles }: Triangles, format: Format): Blob {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    const mesh = new Mesh(geometry);
    if (format === "obj") return new Blob([new OBJExporter().parse(mesh)], { type: "model/obj" });
    if (format === "stl") return new Blob([new STLExporter().parse(mesh, { binary: true })], { type: "model/stl" });
    const text = new PLYExporter().parse(mesh, () => undefined, { excludeAttributes: ["normal", "uv", "color"] }) as unknown as string;
    // The numbers have all digits of doubles.
    return new Blob([text.replace(/property float/g, "property double")], { type: "model/ply" });
}

/** Hands a file to the browser. */
export function save(blob: Blob, name: string): void {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
