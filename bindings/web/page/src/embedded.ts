/** What the page has inside: the module, the worker's program, and shapes. */

import type { Normals, Triangles } from "./surface.js";

/** Shapes of the page. */
export const SHAPES = {
    sphere: "Sphere with bumps and a hole",
    blend: "Three cylinders, 5,000 vertices",
    blend13k: "Three cylinders, 13,000 vertices",
    tetra: "Tetra thing",
    head: "Head (scans)",
    bracket: "Bracket with sharp edges",
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

/** An array of numbers. */
interface ArrayType<T> {
    new (data: ArrayBuffer): T;
    BYTES_PER_ELEMENT: number;
}

/** Takes arrays out of what shapes.mjs has packed, one after the other: the first bytes of all numbers, then the second ones. */
function unpacked(data: ArrayBuffer): <T>(type: ArrayType<T>, count: number) => T {
    const packed = new Uint8Array(data);
    let at = 0;
    return (Type, count) => {
        const size = Type.BYTES_PER_ELEMENT;
        const bytes = new Uint8Array(count * size);
        for (let k = 0; k < size; k++) {
            for (let i = 0; i < count; i++) bytes[i * size + k] = packed[at++]!;
        }
        return new Type(bytes.buffer);
    };
}

/** Adds up numbers of which the differences are given. */
function summed(array: Uint32Array): Uint32Array {
    for (let k = 1; k < array.length; k++) array[k]! += array[k - 1]!;
    return array;
}

/** The shape that the page begins with, and its positions when it is faired. */
export const FIRST: ShapeName = "blend";
export async function faired(): Promise<Float64Array> {
    const data = await bytes(`${FIRST}-faired`);
    return Float64Array.from(unpacked(data)(Float32Array, data.byteLength / 4));
}

/** Unpacks a shape, in the order in which shapes.mjs has packed it. */
export async function shape(name: ShapeName): Promise<Shape> {
    const next = unpacked(await bytes(name));
    const [vertexCount, normalCount, triangleCount, freeCount] = next(Uint32Array, 4) as unknown as [number, number, number, number];
    const positions = next(Float64Array, 3 * vertexCount);
    const told = next(Float64Array, 4 * normalCount);
    const triangles = summed(next(Uint32Array, 3 * triangleCount));
    const free = summed(next(Uint32Array, freeCount));
    const vertices = Uint32Array.from({ length: normalCount }, (_, k) => told[4 * k]!);
    const vectors = Float64Array.from({ length: 3 * normalCount }, (_, k) => told[4 * Math.floor(k / 3) + 1 + (k % 3)]!);
    return { positions, triangles, free, normals: normalCount === 0 ? null : { vertices, vectors } };
}
