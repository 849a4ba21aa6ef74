/** The WebAssembly module: its memory, calls of its functions, and what is refused. */

import { type ElementOfError, FairmeshError, refusal, TrapError } from "./errors.js";
import { enums, functions, structs, type Status } from "./abi.js";

export type StructName = keyof typeof structs;
export type FunctionName = keyof typeof functions;
export type EnumName = keyof typeof enums;
/** What a struct's fields are set to: numbers, names of enumerations, structs in structs. */
export type Values = { readonly [field: string]: unknown };
/** What functions are called with: addresses and numbers. */
export type Argument = number | bigint;

type Field = readonly [at: number, kind: string, count?: number];
type Exported = (...given: Argument[]) => number;

/** In place of an index of 64 bits: there is none. */
export const NO_ELEMENT = 0xffff_ffff_ffff_ffffn;

/** One copy of the module, with a memory of its own. */
export class Library {
    readonly #exports: WebAssembly.Exports;
    readonly #memory: WebAssembly.Memory;
    #broken: unknown = null;

    /** @internal */
    constructor(instance: WebAssembly.Instance) {
        this.#exports = instance.exports;
        this.#memory = instance.exports["memory"] as WebAssembly.Memory;
    }

    /** Its memory, which moves when it grows: not to be kept over a call. */
    get buffer(): ArrayBuffer {
        return this.#memory.buffer as ArrayBuffer;
    }

    get view(): DataView {
        return new DataView(this.buffer);
    }

    /** @internal */
    get table(): WebAssembly.Table {
        return this.#exports["__indirect_function_table"] as WebAssembly.Table;
    }

    /** Whether it has stopped for good. */
    get isBroken(): boolean {
        return this.#broken !== null;
    }

    /** Calls an exported function. After a trap nothing is called any more: nobody knows in what state the memory is. */
    invoke(name: string, ...given: Argument[]): number {
        if (this.isBroken) throw new TrapError(this.#broken);
        try {
            return (this.#exports[name] as Exported)(...given);
        } catch (why) {
            this.#broken = why ?? new Error("a trap");
            throw new TrapError(this.#broken);
        }
    }

    /** Calls a function that ends with a `fairmesh_error`, and throws what it was refused with. */
    call(name: FunctionName, ...given: Argument[]): void {
        within(this, (scope) => {
            const why = scope.struct("error");
            const status = this.invoke(name, ...given, why);
            if (status !== enums.status.ok) throw refused(this, name, status, read(this, why, "error") as unknown as ErrorFields);
        });
    }

    /** What is told of a number that the library answers with. */
    text(answer: keyof typeof enums.answer, number: number, text: keyof typeof enums.text): string {
        return this.string(this.invoke("fairmesh_describe", enums.answer[answer], BigInt(number), enums.text[text]) >>> 0);
    }

    /** The text at an address, up to its end. */
    string(at: number): string {
        const bytes = new Uint8Array(this.buffer, at);
        return decoded(bytes.subarray(0, bytes.indexOf(0)));
    }
}

function decoded(bytes: Uint8Array): string {
    return new TextDecoder().decode(bytes);
}

/** Memory of the module for the time of one call. */
export class Scope {
    readonly library: Library;
    readonly #blocks: [at: number, size: number][] = [];

    constructor(library: Library) {
        this.library = library;
    }

    /** So many bytes; their address. */
    bytes(size: number): number {
        const at = this.library.invoke("fairmesh_wasm_allocate", Math.max(size, 1));
        if (at === 0) {
            throw refusal(this.library.text("status", enums.status.out_of_memory, "meaning"), {
                status: "out_of_memory",
                remedy: this.library.text("status", enums.status.out_of_memory, "remedy"),
            });
        }
        this.#blocks.push([at >>> 0, Math.max(size, 1)]);
        return at >>> 0;
    }

    /** A struct, zero where nothing is said, with its size where it has a field for it. */
    struct(name: StructName, values: Values = {}): number {
        return this.structs(name, [values]);
    }

    /** Structs, one after the other. */
    structs(name: StructName, all: readonly Values[]): number {
        const { size } = structs[name];
        const at = this.bytes(size * all.length);
        new Uint8Array(this.library.buffer, at, size * all.length).fill(0);
        all.forEach((values, index) => write(this.library, at + size * index, name, values));
        return at;
    }

    /** A copy of an array; its address, null of an empty one. */
    copy(values: Float32Array | Float64Array | Uint32Array | Uint8Array): number {
        if (values.length === 0) return 0;
        const at = this.bytes(values.byteLength);
        const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
        new Uint8Array(this.library.buffer, at, bytes.length).set(bytes);
        return at;
    }

    free(): void {
        if (this.library.isBroken) return;
        for (const [at, size] of this.#blocks.splice(0)) this.library.invoke("fairmesh_wasm_free", at, size);
    }
}

/** Does something with memory of the module, which is given back however that ends. */
export function within<T>(library: Library, work: (scope: Scope) => T): T {
    const scope = new Scope(library);
    try {
        return work(scope);
    } finally {
        scope.free();
    }
}

function fieldsOf(name: StructName): Record<string, Field> {
    return structs[name].fields as unknown as Record<string, Field>;
}

/** The fields of a struct that stand for themselves: no structs, no addresses. */
export function plainFields(name: StructName): string[] {
    const plain = (field: string) => field !== "structSize" && !field.startsWith("reserved");
    return Object.entries(fieldsOf(name))
        .filter(([field, [, kind]]) => plain(field) && kind !== "pointer" && !(kind in structs))
        .map(([field]) => field);
}

/** What a field is: a number, an enumeration, ... */
export function kindOf(name: StructName, field: string): string {
    return fieldsOf(name)[field]![1];
}

/** Where a field is in its struct. */
export function placeOf(name: StructName, field: string): number {
    return fieldsOf(name)[field]![0];
}

/** The name of the field at a place in a struct, and what kind it is. */
export function fieldAt(name: StructName, offset: number): [field: string, kind: string, at: number] | null {
    let found: [string, string, number] | null = null;
    for (const [field, [at, kind]] of Object.entries(fieldsOf(name))) if (at <= offset) found = [field, kind, at];
    return found;
}

/** Sets fields of a struct. */
export function write(library: Library, at: number, name: StructName, values: Values): void {
    const fields = fieldsOf(name);
    if ("structSize" in fields) library.view.setUint32(at, structs[name].size, true);
    for (const [field, value] of Object.entries(values)) {
        const [place, kind, count = 1] = fields[field]!;
        if (count > 1) (value as readonly number[]).forEach((each, k) => writeOne(library, at + place + 8 * k, kind, each));
        else writeOne(library, at + place, kind, value);
    }
}

function writeOne(library: Library, at: number, kind: string, value: unknown): void {
    if (kind === "f64") library.view.setFloat64(at, value as number, true);
    else if (kind === "u64" || kind === "orNone") library.view.setBigUint64(at, BigInt(value as number | bigint), true);
    else if (kind in structs) write(library, at, kind as StructName, value as Values);
    else library.view.setUint32(at, typeof value === "string" ? numberOf(kind as EnumName, value)! : Number(value), true);
}

/** The number of a name. */
export function numberOf(kind: EnumName, name: string): number | undefined {
    const names = enums[kind] as Record<string, number>;
    return Object.hasOwn(names, name) ? names[name] : undefined;
}

/** The name of a number; "other" if this package does not know it. */
export function nameOf(kind: EnumName, number: number): string {
    return Object.entries(enums[kind]).find((entry) => entry[1] === number)?.[0] ?? "other";
}

/** The fields of a struct, as JavaScript has them. */
export function read(library: Library, at: number, name: StructName): Record<string, unknown> {
    const made: Record<string, unknown> = {};
    for (const [field, [place, kind, count = 1]] of Object.entries(fieldsOf(name))) {
        if (field === "structSize" || field.startsWith("reserved")) continue;
        if (kind === "chars") {
            const bytes = new Uint8Array(library.buffer, at + place, count);
            const end = bytes.indexOf(0);
            made[field] = decoded(bytes.subarray(0, end < 0 ? count : end));
        } else if (count > 1) {
            made[field] = Array.from({ length: count }, (_, k) => readOne(library, at + place + 8 * k, kind));
        } else {
            made[field] = readOne(library, at + place, kind);
        }
    }
    return made;
}

function readOne(library: Library, at: number, kind: string): unknown {
    const view = library.view;
    if (kind === "f64") return view.getFloat64(at, true);
    if (kind === "u64") return Number(view.getBigUint64(at, true));
    if (kind === "orNone") {
        const element = view.getBigUint64(at, true);
        return element === NO_ELEMENT ? null : Number(element);
    }
    const number = view.getUint32(at, true);
    if (kind === "flag") return number !== 0;
    if (kind === "text") return number === 0 ? "" : library.string(number);
    if (kind === "status") return number === 0 ? null : nameOf("status", number);
    if (kind in enums) return nameOf(kind as EnumName, number);
    return kind in structs ? read(library, at, kind as StructName) : number;
}

interface ErrorFields extends ElementOfError {
    message: string;
}

/** Names that are called otherwise here. */
const NAMES: Record<string, string> = { components: "ofComponents" };

function refused(library: Library, name: FunctionName, status: number, why: ErrorFields): FairmeshError {
    const known = nameOf("status", status);
    const text = library.text("status", status, "meaning");
    let message = why.message || (known === "other" ? `unknown status ${status}` : text);
    let { elementKind, element, other } = why;
    let argument: string | null = null;
    if (elementKind === "argument" && element !== null) {
        // Numbers of C arguments and offsets of fields say nothing to programs in JavaScript.
        argument = argumentOf(name, element, other);
        element = other = null;
        if (argument !== null) message = message.replace(/^argument \d+(, [\w.]+)?: /, `${argument}: `);
    }
    return refusal(message, {
        status: (known === "other" ? "internal" : known) as Status,
        elementKind,
        element,
        other,
        argument,
        remedy: library.text("status", status, "remedy"),
    });
}

/** The name of a function's argument, from 1, or of the field of its struct at an offset. */
function argumentOf(name: FunctionName, number: number, offset: number | null): string | null {
    const kind: string | undefined = functions[name][number - 1];
    if (name === "fairmesh_solver_run" && number === 2) return "iterations";
    if (kind === undefined || !(kind in structs) || offset === null) return null;
    let found = fieldAt(kind as StructName, offset);
    if (found?.[1] === "loopFilter") found = fieldAt("loopFilter", offset - found[2]);
    return found === null ? null : (NAMES[found[0]] ?? found[0]);
}
