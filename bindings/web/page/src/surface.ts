/** A surface with a region on it, and what can be told from the triangles alone. */

import { acceleratedRaycast, MeshBVH } from "three-mesh-bvh";
import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, type Ray, Vector3 } from "three";

/** A triangle mesh, as the library takes it. */
export interface Triangles {
    positions: Float64Array;
    triangles: Uint32Array;
}

/** Unit normals that belong to vertices of a shape's boundary. */
export interface Normals {
    vertices: Uint32Array;
    vectors: Float64Array;
}

/** A place on the surface. */
export interface Hit {
    point: Vector3;
    triangle: number;
}

/** What is drawn, and asked where a ray meets it. Positions change, triangles do not. */
export class Surface {
    readonly geometry = new BufferGeometry();
    readonly triangles: Uint32Array;
    positions: Float64Array;
    readonly #picked: Mesh;
    readonly #bvh: MeshBVH;
    #isMoved = false;
    #centres: Float64Array | null = null;
    #rim: Uint8Array | null = null;

    constructor({ positions, triangles }: Triangles) {
        this.positions = positions;
        this.triangles = triangles;
        this.geometry.setAttribute("position", new BufferAttribute(Float32Array.from(positions), 3));
        this.geometry.setAttribute("curvature", new BufferAttribute(new Float32Array(positions.length / 3), 1));
        this.geometry.setAttribute("chosen", new BufferAttribute(new Float32Array(positions.length / 3), 1));
        this.geometry.setIndex(new BufferAttribute(triangles, 1));
        // Of its own: the tree puts the triangles into another order where it may.
        const tree = new BufferGeometry();
        tree.setAttribute("position", this.geometry.getAttribute("position"));
        tree.setIndex(new BufferAttribute(triangles.slice(), 1));
        this.#bvh = new MeshBVH(tree, { indirect: true });
        tree.boundsTree = this.#bvh;
        this.#picked = new Mesh(tree);
        this.#picked.raycast = acceleratedRaycast;
        this.#shape();
    }

    #shape(): void {
        this.geometry.computeVertexNormals();
        this.geometry.computeBoundingSphere();
        this.geometry.computeBoundingBox();
    }

    /** Shows other positions of the same vertices. */
    move(positions: Float64Array): void {
        this.positions = positions;
        const shown = this.geometry.getAttribute("position") as BufferAttribute;
        (shown.array as Float32Array).set(positions);
        shown.needsUpdate = true;
        this.#shape();
        this.#isMoved = true;
        this.#centres = null;
    }

    /** Numbers at the vertices that are coloured; NaN leaves what is there. */
    paint(attribute: "curvature" | "chosen", values: ArrayLike<number>): void {
        const shown = this.geometry.getAttribute(attribute) as BufferAttribute;
        const array = shown.array as Float32Array;
        for (let v = 0; v < array.length; v++) if (!Number.isNaN(values[v])) array[v] = values[v]!;
        shown.needsUpdate = true;
    }

    /** The curvature that is coloured in a triangle. */
    curvature(triangle: number): number {
        const shown = this.geometry.getAttribute("curvature");
        return [0, 1, 2].reduce((sum, k) => sum + shown.getX(this.triangles[3 * triangle + k]!) / 3, 0);
    }

    /** Where a ray meets the surface first. */
    hit(ray: Ray): Hit | null {
        if (this.#isMoved) this.#bvh.refit();
        this.#isMoved = false;
        const found = this.#bvh.raycastFirst(ray, DoubleSide);
        return found === null || found === undefined ? null : { point: found.point, triangle: found.faceIndex! };
    }

    vertex(v: number): Vector3 {
        return new Vector3(this.positions[3 * v], this.positions[3 * v + 1], this.positions[3 * v + 2]);
    }

    /** The centres of all triangles: a brush asks for them at every movement. */
    get centres(): Float64Array {
        if (this.#centres !== null) return this.#centres;
        const { positions, triangles } = this;
        const centres = new Float64Array(triangles.length);
        triangles.forEach((v, k) => {
            const at = k - (k % 3);
            for (let x = 0; x < 3; x++) centres[at + x]! += positions[3 * v + x]! / 3;
        });
        return (this.#centres = centres);
    }

    /** Per vertex, 1 on the boundary of the mesh: at an edge that has one triangle. */
    get rim(): Uint8Array {
        if (this.#rim !== null) return this.#rim;
        const { triangles } = this;
        const count = this.positions.length / 3;
        const edges = new Float64Array(triangles.length);
        triangles.forEach((a, k) => {
            const b = triangles[k % 3 === 2 ? k - 2 : k + 1]!;
            edges[k] = Math.min(a, b) * count + Math.max(a, b);
        });
        edges.sort();
        const rim = new Uint8Array(count);
        edges.forEach((edge, k) => {
            if (edge !== edges[k - 1] && edge !== edges[k + 1]) rim[Math.floor(edge / count)] = rim[edge % count] = 1;
        });
        return (this.#rim = rim);
    }

    /** Twice the area times the normal. */
    normal(triangle: number): Vector3 {
        const [a, b, c] = [0, 1, 2].map((k) => this.vertex(this.triangles[3 * triangle + k]!)) as [Vector3, Vector3, Vector3];
        return b.sub(a).cross(c.sub(a));
    }

    get diagonal(): number {
        const { min, max } = this.geometry.boundingBox!;
        return max.distanceTo(min) || 1;
    }

    free(): void {
        this.geometry.dispose();
    }
}

/** Per vertex, 1 where a triangle of the region is. */
export function verticesOf(mask: Uint8Array, { positions, triangles }: Triangles): Uint8Array {
    const vertices = new Uint8Array(positions.length / 3);
    for (let k = 0; k < triangles.length; k++) if (mask[Math.floor(k / 3)]) vertices[triangles[k]!] = 1;
    return vertices;
}

/** The triangles that have one of the vertices. */
export function trianglesAt(vertices: Uint32Array, { positions, triangles }: Triangles): Uint8Array {
    const is = new Uint8Array(positions.length / 3);
    for (const v of vertices) is[v] = 1;
    const mask = new Uint8Array(triangles.length / 3);
    for (let k = 0; k < triangles.length; k++) if (is[triangles[k]!]) mask[Math.floor(k / 3)] = 1;
    return mask;
}

/** A vertex on a loop of the region's boundary. */
export interface LoopVertex {
    vertex: number;
    /** Unit vector in the surface, from the boundary into the region. */
    inward: Vector3;
    normal: Vector3;
}

interface Edge {
    from: number;
    to: number;
    triangle: number;
}

/** Edges of a region's triangles that no other triangle of it has, in the direction of theirs, and those between vertices that are held. */
function edgesOf(mask: Uint8Array, triangles: Uint32Array, count: number, held: Uint8Array | null): Edge[] {
    const inner = new Map<number, Edge>();
    for (let t = 0; t < mask.length; t++) {
        if (!mask[t]) continue;
        for (let c = 0; c < 3; c++) {
            const [from, to] = [triangles[3 * t + c]!, triangles[3 * t + ((c + 1) % 3)]!];
            inner.set(from * count + to, { from, to, triangle: t });
        }
    }
    return [...inner.values()].filter(({ from, to }) => !inner.has(to * count + from) || (held !== null && held[from] && held[to]));
}

/** Per vertex, 1 where it may move: it has triangles of the region only, is not on the boundary of the mesh, and not held. */
export function moving(mask: Uint8Array, surface: Surface, held: Uint8Array | null): Uint8Array {
    const free = verticesOf(mask, surface);
    const others = verticesOf(
        mask.map((is) => 1 - is),
        surface,
    );
    return free.map((is, v) => (is && !others[v] && !surface.rim[v] && !held?.[v] ? 1 : 0));
}

/** The boundary of what may move: loops of vertices in their order, the region on the left. Held curves inside are such loops, too. */
export function regionLoops(free: Uint8Array, surface: Surface, held: Uint8Array | null): LoopVertex[][] {
    const { triangles } = surface;
    const mask = new Uint8Array(triangles.length / 3);
    triangles.forEach((v, k) => free[v] && (mask[Math.floor(k / 3)] = 1));
    const next = new Map<number, Edge[]>();
    for (const edge of edgesOf(mask, triangles, surface.positions.length / 3, held)) next.set(edge.from, [...(next.get(edge.from) ?? []), edge]);
    const loops: LoopVertex[][] = [];
    for (const start of next.keys()) {
        const loop: LoopVertex[] = [];
        // Where two loops touch, a vertex has two ways on: any of them ends where it began. Held curves are gone along once.
        for (let at = start, way; (way = next.get(at)?.pop()) !== undefined; at = way.to) {
            const { from, to } = way;
            next.set(to, next.get(to)?.filter((back) => back.to !== from) ?? []);
            const normal = surface.normal(way.triangle).normalize();
            const along = surface.vertex(to).sub(surface.vertex(at)).normalize();
            loop.push({ vertex: at, inward: normal.clone().cross(along), normal });
        }
        if (loop.length > 2) loops.push(loop);
    }
    return loops.sort((a, b) => b.length - a.length);
}

/** The length around a loop. */
export function lengthOf(loop: readonly LoopVertex[], surface: Surface): number {
    return loop.reduce((sum, { vertex }, k) => sum + surface.vertex(vertex).distanceTo(surface.vertex(loop[(k + 1) % loop.length]!.vertex)), 0);
}
