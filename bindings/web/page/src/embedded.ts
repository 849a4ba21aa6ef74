/** What the page has inside: the module, the worker's program, and shapes. */

import type { Normals, Triangles } from "./surface.js";

/** Shapes of the page. */
export const SHAPES = {
    sphere: "Sphere with bumps and a hole",
    blend: "Three cylinders, 5,000 vertices",
    blend13k: "Three cylinders, 13,000 vertices",
    tetra: "Tetra thing",
    head: "Head (scans)",
} as const;
export type ShapeName = keyof typeof SHAPES;

/** A shape with the vertices that may move, and normals at its boundary. */
export interface Shape extends Triangles {
    free: Uint32Array;
    normals: Normals | null;
}

/** The text of one of the page's blocks of data. */
function text(id: string): string {
    return document.getElementById(`data-${id}`)!.textContent!.trim();
}

/** Bytes of a block, which are compressed. */
async function bytes(id: string): Promise<ArrayBuffer> {
    const packed = Uint8Array.from(atob(text(id)), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

export function module(): Promise<ArrayBuffer> {
    return bytes("module");
}

/** Starts a worker with the program that the page has inside. No module: browsers take none from a page that is a file. */
export function startWorker(): Worker {
    const address = URL.createObjectURL(new Blob([text("worker")], { type: "text/javascript" }));
    const worker = new Worker(address);
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    return worker;
}

/** The shape that the page begins with, and its positions when it is faired. */
export const FIRST: ShapeName = "blend";
export const faired = async (): Promise<Float64Array> => Float64Array.from(new Float32Array(await bytes(`${FIRST}-faired`)));

/** Unpacks a shape, in the order in which shapes.mjs has packed it. */
export async function shape(name: ShapeName): Promise<Shape> {
    const data = await bytes(name);
    const [vertexCount, normalCount, triangleCount, freeCount] = new Uint32Array(data, 0, 4) as unknown as [number, number, number, number];
    let at = 16;
    const next = <T>(Type: { new (data: ArrayBuffer, at: number, count: number): T; BYTES_PER_ELEMENT: number }, count: number): T => {
        const array = new Type(data, at, count);
        at += count * Type.BYTES_PER_ELEMENT;
        return array;
    };
    const positions = next(Float64Array, 3 * vertexCount);
    const told = next(Float64Array, 4 * normalCount);
    const triangles = next(Uint32Array, 3 * triangleCount);
    const free = next(Uint32Array, freeCount);
    const vertices = Uint32Array.from({ length: normalCount }, (_, k) => told[4 * k]!);
    const vectors = Float64Array.from({ length: 3 * normalCount }, (_, k) => told[4 * Math.floor(k / 3) + 1 + (k % 3)]!);
    return { positions, triangles, free, normals: normalCount === 0 ? null : { vertices, vectors } };
}
