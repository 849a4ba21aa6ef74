/** Options given to the library's structs. Defaults are the library's: what is undefined is not touched. */

import { CONTINUITY_AUTO, enums, type PlainOptions, RELAX_AUTO, rows, type RowsOptions, SHARP_AUTO, structs } from "./abi.js";
import { type Indices, indices, indicesIn, type Points, numbers, numbersIn, points, shown } from "./arrays.js";
import { type EnumName, kindOf, type Library, numberOf, placeOf, plainFields, read, type Scope, type StructName, type Values, write } from "./library.js";
import type { Watching } from "./progress.js";

/** "g1" or 0: tangent planes alone; "g2" or 1: curvature, too; or a number between; "auto": "g2" along loops where it is certain, "g1" along others. */
export type HowFar = "auto" | "g1" | "g2" | number;
/** "auto", "off", or an angle in degrees. */
export type Sharp = "auto" | "off" | number;
/** A map or list of pairs of a vertex and what belongs to it. */
export type ByVertex<T> = ReadonlyMap<number, T> | readonly (readonly [number, T])[];

/** How fairing is done: what `fair`, `fillHoles`, `bridge`, `refill` and `Solver` have in common. */
export interface FairingOptions extends Omit<PlainOptions, "threads" | "continuity" | "sharp">, RowsOptions, Watching {
    /** There is one thread; the option is taken, so that programs can be the same. */
    threads?: number | undefined;
    /**
     * Unit normals at the boundary of the region, pointing to the side that triangles are counter-clockwise seen from: "fitted" (default)
     * to the surface outside; "averaged" over the triangles outside; one for each vertex, zeros or NaN where none is given; or
     * `{ vertices, vectors }`. Where none is given they are fitted. Of length 1 to 0.001.
     */
    boundaryNormals?: "fitted" | "averaged" | Points | { vertices: Indices; vectors: Points } | undefined;
    /** How far the surface continues the mean curvature of its surroundings. Default: "auto". For the solver "fast". */
    continuity?: HowFar | undefined;
    /** The same for single boundary loops, each named by a vertex on it, in place of `continuity` there. */
    loopContinuity?: ByVertex<HowFar> | undefined;
    /** Sharp edges that reach the boundary of the region go on through it: "auto", those that are certain; "off", none; or those of so many degrees. */
    sharp?: Sharp | undefined;
    /** The mean curvature to be continued, in 1 / length: "estimated" (default), one number for each vertex, NaN where none is given, or some. */
    boundaryCurvature?: "estimated" | Float32Array | Float64Array | readonly number[] | { vertices: Indices; values: Indices | Float64Array } | undefined;
    /** The Laplacian of the mean curvature: "harmonic" (default), zero; a number in 1 / length^3; or "minimal_energy", -2 H (H^2 - K). */
    target?: "harmonic" | "minimal_energy" | number | undefined;
}

/** A number. */
export function real(value: unknown, name: string): number {
    if (typeof value !== "number") throw new TypeError(`${name}: a number is needed, not ${shown(value)}`);
    return value;
}

/** A number without sign of so many bits. */
export function whole(value: unknown, name: string, bits: 32 | 64 = 64): number {
    if (!Number.isInteger(value)) throw new TypeError(`${name}: an integer is needed, not ${shown(value)}`);
    if ((value as number) < 0 || (value as number) >= 2 ** bits) throw new RangeError(`${name}: ${shown(value)} is not between 0 and 2**${bits} - 1`);
    return value as number;
}

/** One of the names of an enumeration. */
export function oneOf(kind: EnumName, value: unknown, name: string): string {
    if (typeof value !== "string" || numberOf(kind, value) === undefined) {
        const names = Object.keys(enums[kind]);
        const hint = typeof value === "string" ? didYouMean(value, names) : "";
        throw new TypeError(`${name}: ${shown(value)} is none of ${names.map(shown).join(", ")}${hint}`);
    }
    return value;
}

/** What other packages, and other hosts of fairmesh, call it. */
const SYNONYMS: Record<string, string> = {
    mask: "free",
    faces: "triangles",
    free_faces: "freeTriangles",
    tol: "tolerance",
    eps: "tolerance",
    iterations: "maxIterations",
    callback: "progress",
    onprogress: "progress",
    signal: "cancel",
    normals: "boundaryNormals",
};

/** What may have been meant by a name that is not known, as the end of a sentence. */
function didYouMean(name: string, known: readonly string[]): string {
    const plain = (text: string) => text.toLowerCase().replace(/_/g, "");
    const low = plain(name);
    const synonym = SYNONYMS[name.toLowerCase()];
    const near =
        (synonym !== undefined && known.includes(synonym) ? synonym : undefined) ??
        known.find((each) => plain(each) === low) ??
        known.find((each) => low.length > 2 && (plain(each).startsWith(low) || plain(each).endsWith(low) || distance(plain(each), low) < 3));
    return near === undefined ? "" : `; did you mean ${shown(near)}?`;
}

/** How many letters have to be changed, put in or left out. */
function distance(a: string, b: string): number {
    let row = Array.from({ length: b.length + 1 }, (_, k) => k);
    for (let i = 1; i <= a.length; i++) {
        const next = [i];
        for (let j = 1; j <= b.length; j++) next[j] = Math.min(row[j]! + 1, next[j - 1]! + 1, row[j - 1]! + (a[i - 1] === b[j - 1] ? 0 : 1));
        row = next;
    }
    return row[b.length]!;
}

/** Refuses options that nobody reads. */
export function known(options: object, names: readonly string[]): void {
    if (typeof options !== "object" || options === null) throw new TypeError("options: an object is needed");
    for (const name of Object.keys(options)) {
        if (!names.includes(name)) throw new TypeError(`unknown option ${shown(name)}${didYouMean(name, names)}`);
    }
}

/** A plain value as it is written: an enumeration by its name, a number. */
function plainValue(struct: StructName, name: string, value: unknown): unknown {
    if (name === "relaxRim" && value === "auto") return RELAX_AUTO;
    const kind = kindOf(struct, name);
    if (kind in enums) return oneOf(kind as EnumName, value, name);
    if (kind === "flag") return value ? 1 : 0;
    if (kind === "f64") return real(value, name);
    return whole(value, name, kind === "u64" ? 64 : 32);
}

/** A struct with the library's defaults, and the plain ones of the options given. */
export function withDefaults(scope: Scope, struct: StructName, init: string, given: object): number {
    const at = scope.struct(struct);
    scope.library.invoke(init, at, structs[struct].size);
    for (const name of plainFields(struct)) {
        const value = (given as Values)[name];
        if (value !== undefined && !OTHERWISE.includes(name)) write(scope.library, at, struct, { [name]: plainValue(struct, name, value) });
    }
    return at;
}

/** Plain in the library, but not here. */
const OTHERWISE = ["continuity", "sharp"];

export const WATCHING = ["progress", "cancel"];
/** The names of the fairing options. */
export const FAIRING: readonly string[] = [
    ...plainFields("options"),
    ...Object.keys(rows.options),
    ...["boundaryNormals", "loopContinuity", "boundaryCurvature", "target"],
    ...WATCHING,
];

/** The library's fairing options. */
export function fairingIn(scope: Scope, given: FairingOptions, isSingle: boolean, vertexCount: number, told: Values): number {
    const at = withDefaults(scope, "options", "fairmesh_options_init", given);
    const set = (values: Values) => write(scope.library, at, "options", values);
    set(told);
    if (isSingle && given.outputPrecision === undefined) set({ outputPrecision: "single" });
    if (given.continuity !== undefined) set({ continuity: howFar(given.continuity, "continuity") });
    if (given.sharp !== undefined) set({ sharp: sharpAngle(given.sharp) });
    if (given.target !== undefined) set({ target: targetIn(given.target) });
    if (given.boundaryNormals !== undefined) set({ boundaryNormals: normalsIn(scope, given.boundaryNormals, vertexCount) });
    if (given.boundaryCurvature !== undefined) set({ boundaryCurvature: curvatureIn(scope, given.boundaryCurvature, vertexCount) });
    if (given.loopContinuity !== undefined) set({ loopContinuity: loopsIn(scope, given.loopContinuity) });
    writeRows(scope, at, "options", given);
    return at;
}

/** The lists of indices of a struct. */
export function writeRows(scope: Scope, at: number, struct: keyof typeof rows, given: object): void {
    for (const [name, width] of Object.entries(rows[struct])) {
        const list = (given as Record<string, Rows | undefined>)[name];
        if (list !== undefined) write(scope.library, at, struct, { [name]: rowsIn(scope, list, width, name) });
    }
}

/** Rows of indices, or these one after the other. */
type Rows = ArrayLike<number> | readonly (readonly number[])[];

/** A list of rows, or of their indices one after the other. */
function rowsIn(scope: Scope, given: Rows, width: 1 | 2 | 3, name: string): Values {
    const listed = indices((Array.isArray(given) ? given.flat() : given) as Indices, name);
    if (listed.length % width !== 0) throw new RangeError(`${name}: rows of ${width} are needed, not ${listed.length} vertices`);
    return indicesIn(scope, listed, width);
}

/** From 0 to 1 or auto, if the library agrees. */
export function howFar(given: HowFar, name: string): number {
    if (given === "auto") return CONTINUITY_AUTO;
    if (given === "g1") return 0;
    if (given === "g2") return 1;
    if (typeof given !== "number") throw new TypeError(`${name}: ${shown(given)} is neither "auto" nor "g1" nor "g2" nor a number`);
    return given;
}

/** The angle from which on sharp edges go on, in degrees, if the library agrees. */
function sharpAngle(given: Sharp): number {
    if (given === "auto") return SHARP_AUTO;
    if (given === "off") return 0;
    if (typeof given !== "number") throw new TypeError(`sharp: ${shown(given)} is neither "auto" nor "off" nor a number`);
    return given;
}

/** `fairmesh_target`. */
export function targetIn(given: NonNullable<FairingOptions["target"]>): Values {
    if (given === "harmonic" || given === "minimal_energy") return { kind: given };
    if (typeof given !== "number") throw new TypeError(`target: ${shown(given)} is neither "harmonic" nor "minimal_energy" nor a number`);
    return { kind: "constant", constant: given };
}

function isPair(given: unknown, second: string): given is { vertices: Indices } & Record<string, unknown> {
    return typeof given === "object" && given !== null && "vertices" in given && second in given;
}

/** As many as there have to be. */
function counted<T extends { length: number }>(values: T, name: string, count: number, each: number): T {
    if (values.length !== each * count) throw new RangeError(`${name}: ${values.length / each} are given, but ${count} are needed`);
    return values;
}

/** `fairmesh_boundary_normals`. */
export function normalsIn(scope: Scope, given: NonNullable<FairingOptions["boundaryNormals"]>, vertexCount: number): Values {
    const name = "boundaryNormals";
    if (given === "fitted" || given === "averaged") return { kind: given };
    if (typeof given === "string") throw new TypeError(`${name}: ${shown(given)} is neither "fitted" nor "averaged" nor an array`);
    if (isPair(given, "vectors")) {
        const vertices = indices(given.vertices, name);
        const vectors = counted(points(given["vectors"], name), name, vertices.length, 3);
        return { kind: "given", vectors: numbersIn(scope, vectors, 3), vertices: indicesIn(scope, vertices) };
    }
    // Rows of NaN say that no normal is given: for the library, zeros do.
    const vectors = counted(points(given, name), name, vertexCount, 3).slice();
    for (let k = 0; k < vectors.length; k += 3) {
        if ([0, 1, 2].every((i) => Number.isNaN(vectors[k + i]))) vectors.fill(0, k, k + 3);
    }
    return { kind: "given", vectors: numbersIn(scope, vectors, 3) };
}

/** `fairmesh_boundary_curvature`. */
export function curvatureIn(scope: Scope, given: NonNullable<FairingOptions["boundaryCurvature"]>, vertexCount: number): Values {
    const name = "boundaryCurvature";
    if (given === "estimated") return { kind: given };
    if (typeof given === "string") throw new TypeError(`${name}: ${shown(given)} is neither "estimated" nor an array`);
    if (isPair(given, "values")) {
        const vertices = indices(given.vertices, name);
        const values = counted(numbers(given["values"], name), name, vertices.length, 1);
        // For the library, no list of vertices is one number for each.
        if (vertices.length === 0) return { kind: "estimated" };
        return { kind: "given", values: numbersIn(scope, values, 1), vertices: indicesIn(scope, vertices) };
    }
    return { kind: "given", values: numbersIn(scope, counted(numbers(given, name), name, vertexCount, 1), 1) };
}

/** `fairmesh_loop_continuity`. */
export function loopsIn(scope: Scope, given: NonNullable<FairingOptions["loopContinuity"]>): Values {
    const name = "loopContinuity";
    if (typeof given !== "object" || given === null || !(Symbol.iterator in given)) {
        throw new TypeError(`${name}: a Map or pairs of a vertex and a number are needed, not ${shown(given)}`);
    }
    const pairs = [...given];
    const vertices = indices(
        pairs.map(([vertex]) => vertex),
        name,
    );
    const values = Float64Array.from(pairs, ([, value]) => howFar(value, name));
    return pairs.length === 0 ? {} : { values: numbersIn(scope, values, 1), vertices: indicesIn(scope, vertices) };
}

/** The address of a field. */
export function fieldOf(at: number, struct: StructName, field: string): number {
    return at + placeOf(struct, field);
}

/** The library's defaults of the plain options. */
export function defaults(library: Library, scope: Scope, struct: StructName, init: string): Record<string, unknown> {
    const all = read(library, withDefaults(scope, struct, init, {}), struct);
    return Object.fromEntries(plainFields(struct).map((name) => [name, all[name]]));
}
