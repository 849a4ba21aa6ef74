/** What something will cost, before it is done: memory as the library tells it, seconds by what this machine has taken so far. */

export interface Cost {
    seconds: number;
    bytes: number;
}

/** What is asked about first: who waits longer than seconds wants to know, and browsers end pages for gigabytes. At half the scans of every day
 *  ask, at double phones have given up. */
const MOST: Cost = { seconds: 5, bytes: 1e9 };
/** What a module can have; measured in no browser to be more. */
const MEMORY = 4e9;

/** Seconds per byte needed, of fairing 5,000 to 75,000 vertices and of filling: 1 to 1.9e-9 here. Whoever measures it takes half of the new one. */
let perByte = 1.3e-9;
/** Seconds per triangle of a file that is opened: 3.1 to 7e-6 here. */
let perTriangle = 4e-6;
/** Smaller ones are over before a clock can tell. */
const LEAST: Cost = { seconds: 0.02, bytes: 2e7 };

export const costOf = (bytes: number): Cost => ({ bytes, seconds: bytes * perByte });

/** Learns from what something has taken. */
export function took({ bytes }: Cost, seconds: number): void {
    if (bytes > LEAST.bytes && seconds > LEAST.seconds) perByte = (perByte + seconds / bytes) / 2;
}

/** What a file costs to open, by what its head says, or its size. */
export function costOfFile(name: string, size: number, head: string): Cost {
    const told = /element face (\d+)/.exec(head)?.[1];
    const triangles = told !== undefined ? Number(told) : name.endsWith(".stl") ? (head.startsWith("solid") ? size / 250 : size / 50) : size / 70;
    // Positions, triangles and their tree, and copies while it is read.
    return { seconds: triangles * perTriangle, bytes: 300 * triangles };
}

export function opened(triangles: number, seconds: number): void {
    if (triangles > 50_000) perTriangle = (perTriangle + seconds / triangles) / 2;
}

export const isLarge = ({ seconds, bytes }: Cost): boolean => seconds > MOST.seconds || bytes > MOST.bytes;

/** "about 0.2 s, at most 60 MB". */
export function costText({ seconds, bytes }: Cost): string {
    const short = (x: number) => Number(x.toPrecision(x < 1 ? 1 : 2)).toLocaleString("en");
    const time = seconds < 90 ? `${short(Math.max(seconds, 0.1))} s` : `${short(seconds / 60)} minutes`;
    const memory = bytes < 1e9 ? `${short(bytes / 1e6)} MB` : `${short(bytes / 1e9)} GB`;
    return `about ${time}, at most ${memory} of memory${bytes > MEMORY ? ", which is more than a page may have: choose less" : ""}`;
}
