/** How far a run is, and stopping it. */

import type { Progress } from "./abi.js";
import { type Library, read } from "./library.js";

/** Told after every iteration and at phases of the preparation. False stops the run; an exception stops it too, and is thrown again. */
export type ProgressCallback = (progress: Progress) => unknown;

/** Watching and stopping a run. */
export interface Watching {
    progress?: ProgressCallback | undefined;
    /**
     * In shared memory (`new Int32Array(new SharedArrayBuffer(4))`): set to another number than 0 by another thread, it stops the run
     * before the next iteration, with the outcome "cancelled".
     */
    cancel?: Int32Array | undefined;
}

/** Stands between the library's callback and what was given. Nothing is ever thrown through the library. */
class Relay {
    #thrown: { why: unknown } | null = null;
    #stopped = false;
    readonly #given: Watching;

    constructor(given: Watching) {
        const { progress, cancel } = given;
        if (progress !== undefined && typeof progress !== "function") throw new TypeError("progress: a function is needed");
        if (cancel !== undefined && !(cancel instanceof Int32Array)) throw new TypeError("cancel: an Int32Array is needed");
        this.#given = given;
    }

    tell(library: Library, at: number): number {
        if (!this.#stopped) {
            try {
                this.#stopped = this.#ask(read(library, at, "progress") as unknown as Progress);
            } catch (why) {
                this.#thrown = { why };
                this.#stopped = true;
            }
        }
        return this.#stopped ? 1 : 0;
    }

    #ask(progress: Progress): boolean {
        const { cancel } = this.#given;
        const isCancelled = cancel !== undefined && Atomics.load(cancel, 0) !== 0;
        return this.#given.progress?.(progress) === false || isCancelled;
    }

    /** Throws what the callback has thrown, and is as new. */
    end(): void {
        const thrown = this.#thrown;
        this.#thrown = null;
        this.#stopped = false;
        if (thrown !== null) throw thrown.why;
    }
}

/** The callbacks of one copy of the module: one function in its table, and numbers for those who are told. */
export class Relays {
    readonly #library: Library;
    readonly #relays = new Map<number, Relay>();
    #place = -1;
    #last = 0;

    constructor(library: Library) {
        this.#library = library;
    }

    /** The number of a new one, and what the library is to call; zeros where nobody wants to be told. */
    add(given: Watching): { progress: number; userData: number } {
        if (given.progress === undefined && given.cancel === undefined) return { progress: 0, userData: 0 };
        this.#relays.set(++this.#last, new Relay(given));
        if (this.#place < 0) {
            this.#place = this.#library.table.grow(1);
            this.#library.table.set(this.#place, callable((at, number) => this.#relays.get(number)?.tell(this.#library, at >>> 0) ?? 1));
        }
        return { progress: this.#place, userData: this.#last };
    }

    /** Throws what a callback has thrown during a run. */
    end(number: number): void {
        this.#relays.get(number)?.end();
    }

    remove(number: number): void {
        this.#relays.delete(number);
    }
}

type Callback = (progress: number, userData: number) => number;
type FunctionMaker = new (type: { parameters: string[]; results: string[] }, call: Callback) => unknown;

/**
 * `(module (type (func (param i32 i32) (result i32))) (import "f" "f" (func (type 0))) (export "f" (func 0)))`: a function of
 * JavaScript comes out as one of WebAssembly, which alone can be put into a table.
 */
const THROUGH = Uint8Array.of(
    ...[0x00, 0x61, 0x73, 0x6d, 0x01, 0x00, 0x00, 0x00],
    ...[0x01, 0x07, 0x01, 0x60, 0x02, 0x7f, 0x7f, 0x01, 0x7f],
    ...[0x02, 0x07, 0x01, 0x01, 0x66, 0x01, 0x66, 0x00, 0x00],
    ...[0x07, 0x05, 0x01, 0x01, 0x66, 0x00, 0x00],
);

function callable(call: Callback): unknown {
    const maker = (WebAssembly as { Function?: FunctionMaker }).Function;
    if (maker !== undefined) return new maker({ parameters: ["i32", "i32"], results: ["i32"] }, call);
    return new WebAssembly.Instance(new WebAssembly.Module(THROUGH), { f: { f: call } }).exports["f"];
}
