/** The program of a worker: loads the library, and does what it is asked, one call after the other. */

import type { Progress } from "./abi.js";
import type { Method, Request } from "./client.js";
import { sent } from "./errors.js";
import { type Fairmesh, load } from "./index.js";
import { serve } from "./ports.js";

let library: Promise<Fairmesh> | null = null;

/** The memory of all arrays in a result: it changes hands, and is not copied. */
function memoryOf(value: unknown, found = new Set<ArrayBuffer>()): Set<ArrayBuffer> {
    if (ArrayBuffer.isView(value)) {
        if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
    } else if (typeof value === "object" && value !== null) {
        for (const each of Object.values(value)) memoryOf(each, found);
    }
    return found;
}

/** The arguments, with what watches the run in the options. */
function watching(request: Request, tell: (progress: Progress) => void): unknown[] {
    if (request.options === null) return request.given;
    const options: Record<string, unknown> = { ...request.options };
    if (request.isWatched) options["progress"] = tell;
    if (request.cancel !== undefined) options["cancel"] = request.cancel;
    return [...request.given, options];
}

serve((request: Request, post) => {
    void (async () => {
        try {
            library ??= load(request.module);
            const host = (await library) as unknown as Record<Method, (...given: unknown[]) => unknown>;
            const result = host[request.method](...watching(request, (progress) => post({ id: request.id, progress })));
            post({ id: request.id, result }, [...memoryOf(result)]);
        } catch (why) {
            post({ id: request.id, error: sent(why) });
        }
    })();
});
