/** The WebAssembly module, from wherever it is. */

/** A `WebAssembly.Module`, which TypeScript knows where it knows pages. */
export interface CompiledModule {}

/** What the module is loaded from: its address, its bytes, the answer to a request for it, or the compiled module. */
export type Source = URL | string | ArrayBuffer | ArrayBufferView | Response | CompiledModule;

/** Compiles the module, by default that of this package: for several copies, and to hand to workers. */
export async function compile(source: Source = new URL("./fairmesh.wasm", import.meta.url)): Promise<CompiledModule> {
    if (source instanceof WebAssembly.Module) return source;
    if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) return WebAssembly.compile(source as BufferSource);
    // Relative to the page. Not to this file: bundlers take that for one of their own.
    if (typeof source === "string") return fromAddress(new URL(source, globalThis.location?.href));
    if (source instanceof URL) return fromAddress(source);
    if (!(source instanceof Response)) throw new TypeError("a module, its bytes, its address, or an answer of fetch is needed");
    if (!source.ok) throw new Error(`${source.url}: ${source.status} ${source.statusText}`);
    // There are servers that do not know the type.
    if (source.headers.get("content-type")?.startsWith("application/wasm")) return WebAssembly.compileStreaming(source);
    return WebAssembly.compile(await source.arrayBuffer());
}

async function fromAddress(url: URL): Promise<CompiledModule> {
    if (url.protocol !== "file:") return compile(await fetch(url));
    // Node does not fetch files. Bundlers are not to look for what it reads them with.
    const name = "node:fs/promises";
    const { readFile } = (await import(/* webpackIgnore: true */ /* @vite-ignore */ name)) as { readFile: (from: URL) => Promise<Uint8Array> };
    return WebAssembly.compile((await readFile(url)) as BufferSource);
}
