/** Arrays given, as the library reads them. All are copied into its memory. */

import { enums, type SelectionKind } from "./abi.js";
import { type ErrorDetails, InputError } from "./errors.js";
import type { Scope, Values } from "./library.js";

/** x, y, z of one point after the other, or a list of triples. */
export type Points = Float32Array | Float64Array | readonly number[] | readonly (readonly number[])[];
/** Whole numbers from 0. */
export type Indices = Uint32Array | Uint16Array | Int32Array | Int16Array | readonly number[];
/** Three corners of one triangle after the other, or a list of triples. */
export type Triangles = Indices | readonly (readonly number[])[];
/** One entry for each vertex or triangle: not 0, or true, is chosen. */
export type Mask = Uint8Array | Uint8ClampedArray | readonly boolean[];
/** A mask, or indices. */
export type Selection = Mask | Indices;

/** A mesh. It is not written. */
export interface Mesh {
    /** In any unit of length; computed is in double precision, whatever is given. */
    positions: Points;
    /** Counter-clockwise seen from the side that normals point to. Without them every three positions are a triangle. */
    triangles?: Triangles | null | undefined;
    /**
     * Whether vertices at the same place are one vertex of the surface, as in triangle soups and along texture seams: "join" (default)
     * where their coordinates are equal; a distance that they may be apart; or "separate".
     */
    coincident?: "join" | "separate" | number | undefined;
}

/** Positions as results have them: in the precision given. */
export type Floats = Float32Array | Float64Array;

/** What positions come out as, by what goes in. */
export type Out<M extends Mesh> = M extends { positions: Float32Array }
    ? Float32Array
    : M extends { positions: Float64Array | readonly unknown[] }
      ? Float64Array
      : Floats;

const INTEGERS = [Uint32Array, Uint16Array, Int32Array, Int16Array, Uint8Array, Int8Array] as const;

function isArray(value: unknown): value is ArrayLike<unknown> {
    return Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
}

/** A value as a message shows it. */
export function shown(value: unknown): string {
    if (typeof value === "string") return JSON.stringify(value);
    return isArray(value) ? `an array of ${value.length}` : String(value);
}

function flat(given: unknown, name: string): ArrayLike<number> {
    if (!isArray(given)) throw new TypeError(`${name}: an array is needed, not ${shown(given)}`);
    if (!Array.isArray(given) || !isArray(given[0])) return given as ArrayLike<number>;
    return given.flatMap((row: unknown, index) => {
        if (!isArray(row) || row.length !== 3) throw new TypeError(`${name}: entry ${index} has to be three numbers`);
        return Array.from(row as ArrayLike<number>);
    });
}

/** Real numbers. Single precision stays that; everything else becomes double. */
export function numbers(given: unknown, name: string): Floats {
    const values = flat(given, name);
    if (values instanceof Float32Array || values instanceof Float64Array) return values;
    if (typeof values[0] === "bigint") throw new TypeError(`${name}: real numbers are needed, not bigints`);
    const wrong = Array.prototype.findIndex.call(values, (value) => typeof value !== "number");
    if (wrong >= 0) throw new TypeError(`${name}: numbers are needed, not ${shown(values[wrong])}`);
    return Float64Array.from(values);
}

/** Points or vectors. */
export function points(given: unknown, name: string): Floats {
    const values = numbers(given, name);
    if (values.length % 3 !== 0) throw new RangeError(`${name}: three numbers for each are needed, not ${values.length} in all`);
    return values;
}

type Refuse = (index: number, value: number) => Partial<ErrorDetails> & { status: ErrorDetails["status"]; message: string };

function whole(values: ArrayLike<number>, name: string, refuse: Refuse): Uint32Array {
    if (values instanceof Uint32Array) return values;
    if (values instanceof Float32Array || values instanceof Float64Array || (!Array.isArray(values) && !INTEGERS.some((T) => values instanceof T))) {
        throw new TypeError(`${name}: integers are needed, not a ${values.constructor.name}`);
    }
    const made = new Uint32Array(values.length);
    for (let k = 0; k < made.length; k++) {
        const value = values[k]!;
        if (!Number.isInteger(value)) throw new TypeError(`${name}: integers are needed, not ${shown(value)}`);
        if (value < 0 || value >= 2 ** 32) {
            const { message, ...details } = refuse(k, value);
            throw new InputError(message, details);
        }
        made[k] = value;
    }
    return made;
}

/** What lists of indices name, if not vertices. */
const ELEMENTS: Record<string, ErrorDetails["elementKind"]> = {
    freeTriangles: "triangle",
    among: "triangle",
    region: "triangle",
    erased: "triangle",
    loops: "loop",
    join: "loop",
    ofComponents: "none",
};

/** Indices. */
export function indices(given: unknown, name: string): Uint32Array {
    return whole(flat(given, name), name, (_, element) => ({
        status: "selection_out_of_range",
        message: `${name} names element ${element}`,
        elementKind: ELEMENTS[name] ?? "vertex",
        element,
    }));
}

/** A mesh as the library reads it. */
export class MeshIn {
    readonly positions: Floats;
    readonly triangles: Uint32Array;
    readonly #coincident: Values;

    constructor(given: Mesh) {
        if (typeof given !== "object" || given === null || !("positions" in given)) {
            throw new TypeError("a mesh is needed: an object with positions and triangles");
        }
        this.positions = points(given.positions, "positions");
        const count = this.positions.length / 3;
        this.triangles =
            given.triangles == null
                ? Uint32Array.from({ length: 3 * Math.floor(count / 3) }, (_, k) => k)
                : whole(flat(given.triangles, "triangles"), "triangles", (at, other) => ({
                      status: "index_out_of_range",
                      message: `triangle ${Math.floor(at / 3)} names vertex ${other}`,
                      elementKind: "triangle",
                      element: Math.floor(at / 3),
                      other,
                  }));
        if (this.triangles.length % 3 !== 0) {
            throw new RangeError(`triangles: three indices for each are needed, not ${this.triangles.length} in all`);
        }
        this.#coincident = coincident(given.coincident);
    }

    get vertexCount(): number {
        return this.positions.length / 3;
    }

    get triangleCount(): number {
        return this.triangles.length / 3;
    }

    /** An array for positions, in the precision given. */
    newPositions(count = this.vertexCount): Floats {
        return this.positions instanceof Float32Array ? new Float32Array(3 * count) : new Float64Array(3 * count);
    }

    struct(scope: Scope): number {
        return scope.struct("mesh", {
            positions: numbersIn(scope, this.positions, 3),
            triangles: indicesIn(scope, this.triangles, 3),
            ...this.#coincident,
        });
    }
}

function coincident(given: Mesh["coincident"]): Values {
    if (given === undefined || given === "join") return { coincident: "join" };
    if (given === "separate") return { coincident: "separate" };
    if (typeof given !== "number") throw new TypeError(`coincident: ${shown(given)} is neither "join" nor "separate" nor a distance`);
    return { coincident: "join", coincidentWithin: given };
}

/** `fairmesh_points` or `fairmesh_numbers` of a copy. */
export function numbersIn(scope: Scope, values: Floats, each: 1 | 3): Values {
    return { data: scope.copy(values), count: values.length / each, stride: 0, scalar: scalarOf(values) };
}

/** `fairmesh_indices` of a copy. */
export function indicesIn(scope: Scope, values: Uint32Array, each: 1 | 2 | 3 = 1): Values {
    return { data: scope.copy(values), count: values.length / each, stride: 0 };
}

/** The library's number for the kind of numbers in an array. */
export function scalarOf(values: Floats): number {
    return values instanceof Float32Array ? enums.scalar.float32 : enums.scalar.float64;
}

function isMask(given: unknown): given is Mask {
    return given instanceof Uint8Array || given instanceof Uint8ClampedArray || (Array.isArray(given) && typeof given[0] === "boolean");
}

/** A mask of zeros and ones, or indices, each once. */
function chosen(given: unknown, name: string, count: number): Uint8Array | Uint32Array {
    if (isMask(given)) {
        if (given.length !== count) throw new RangeError(`${name}: a mask has to have ${count} entries, not ${given.length}`);
        return Uint8Array.from(given as ArrayLike<number>, (value) => (value ? 1 : 0));
    }
    const listed = indices(given, name);
    const seen = new Set<number>();
    for (const index of listed) {
        if (seen.has(index)) {
            throw new RangeError(`${name}: index ${index} is given more than once; a mask is a Uint8Array, or an array of booleans`);
        }
        seen.add(index);
    }
    return listed;
}

/** Triangles that a mask or a list names. */
export function chosenTriangles(mesh: MeshIn, given: unknown, name: string): Uint32Array {
    const which = chosen(given, name, mesh.triangleCount);
    if (which instanceof Uint32Array) return which;
    const all: number[] = [];
    which.forEach((is, index) => is && all.push(index));
    return Uint32Array.from(all);
}

/** Which vertices may move. */
export interface Region {
    /** In place of `free`: the vertices that may not. */
    fixed?: Selection | undefined;
    /** In place of `free`: free are vertices that have no other triangles and are not on the boundary of the mesh. */
    freeTriangles?: Selection | undefined;
}

/** The library's selection; without any, all vertices that are not on the boundary of the mesh. */
export function selectionIn(scope: Scope, mesh: MeshIn, free: Selection | null | undefined, { fixed, freeTriangles }: Region): number {
    const given = Object.entries({ free, fixed, freeTriangles }).filter(([, value]) => value != null);
    if (given.length > 1) throw new TypeError(`only one of ${given.map(([name]) => name).join(" and ")} can be given`);
    let kind: SelectionKind = "interior";
    let which: Uint8Array | Uint32Array = new Uint8Array(0);
    if (free != null) {
        which = chosen(free, "free", mesh.vertexCount);
        kind = which instanceof Uint8Array ? "free_mask" : "free_vertices";
    } else if (fixed != null) {
        which = fixedMask(chosen(fixed, "fixed", mesh.vertexCount), mesh.vertexCount);
        kind = "fixed_mask";
    } else if (freeTriangles != null) {
        which = chosenTriangles(mesh, freeTriangles, "freeTriangles");
        kind = "faces";
    }
    return scope.struct("selection", { kind, data: scope.copy(which), count: which.length });
}

function fixedMask(which: Uint8Array | Uint32Array, count: number): Uint8Array {
    if (which instanceof Uint8Array) return which;
    const mask = new Uint8Array(count);
    for (const element of which) {
        if (element >= count) {
            const message = `the selection names element ${element}, but there are only ${count}`;
            throw new InputError(message, { status: "selection_out_of_range", elementKind: "vertex", element });
        }
        mask[element] = 1;
    }
    return mask;
}
