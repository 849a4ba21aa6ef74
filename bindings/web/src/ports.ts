/** Workers, as browsers and as Node have them. */

/** One end of a line to a worker. */
export interface Port {
    post(message: unknown, transfer?: Transferable[]): void;
    /** What is done with messages, and with the end of the worker by an error. */
    listen(message: (data: never) => void, failed: (why: Error) => void): void;
    /** Whether the program is kept alive by it. */
    hold(is: boolean): void;
    close(): void;
}

/** What is used of a worker thread of Node, and of its parent. */
interface NodeThread {
    postMessage(message: unknown, transfer?: Transferable[]): void;
    on(event: string, listener: (value: never) => void): void;
    ref(): void;
    unref(): void;
    terminate(): Promise<unknown>;
}

interface NodeThreads {
    Worker: new (url: URL) => NodeThread;
    parentPort: NodeThread | null;
}

async function threads(): Promise<NodeThreads> {
    const name = "node:worker_threads";
    return (await import(/* webpackIgnore: true */ /* @vite-ignore */ name)) as NodeThreads;
}

/** A line to a new worker that runs worker.js of this package. */
export async function newWorker(): Promise<Port> {
    if (typeof Worker === "undefined") return nodePort(new (await threads()).Worker(new URL("./worker.js", import.meta.url)));
    const url = new URL("./worker.js", import.meta.url);
    if (typeof location !== "undefined" && url.protocol.startsWith("http") && url.origin !== location.origin) return foreign(url);
    // Bundlers know it by this form.
    return webPort(new Worker(new URL("./worker.js", import.meta.url), { type: "module" }));
}

/** Workers have to come from the page's own server; one of its own may import from another. */
function foreign(url: URL): Port {
    const program = new Blob([`import ${JSON.stringify(url.href)};`], { type: "text/javascript" });
    const address = URL.createObjectURL(program);
    const port = webPort(new Worker(address, { type: "module" }));
    return { ...port, close: () => (port.close(), URL.revokeObjectURL(address)) };
}

/** A line to a worker of the web. */
export function webPort(worker: Worker): Port {
    return {
        post: (message, transfer = []) => worker.postMessage(message, transfer),
        listen(message, failed) {
            worker.onmessage = (event) => message(event.data as never);
            worker.onerror = (event) => failed(new Error(event.message || "the worker could not be started"));
            worker.onmessageerror = () => failed(new Error("a message of the worker could not be read"));
        },
        hold: () => undefined,
        close: () => worker.terminate(),
    };
}

function nodePort(thread: NodeThread): Port {
    return {
        post: (message, transfer = []) => thread.postMessage(message, transfer),
        listen(message, failed) {
            thread.on("message", message);
            thread.on("error", failed);
        },
        hold: (is) => (is ? thread.ref() : thread.unref()),
        close: () => void thread.terminate(),
    };
}

/** What is used of the inside of a worker of the web. */
interface Inside {
    postMessage(message: unknown, transfer?: Transferable[]): void;
    onmessage: ((event: { data: never }) => void) | null;
}

/** Hands messages to a worker's function, which answers by the one it gets. Listens at once where that is possible: what comes before is lost. */
export function serve(answer: (data: never, post: (message: unknown, transfer?: Transferable[]) => void) => void): void {
    const inside = globalThis as unknown as Inside;
    if (typeof inside.postMessage === "function" && typeof self !== "undefined") {
        inside.onmessage = ({ data }) => answer(data, (message, transfer = []) => inside.postMessage(message, transfer));
        return;
    }
    void threads().then(({ parentPort }) =>
        parentPort?.on("message", (data) => answer(data, (message, transfer = []) => parentPort.postMessage(message, transfer))),
    );
}
