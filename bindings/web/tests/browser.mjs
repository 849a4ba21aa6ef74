/**
 * The package in a browser: node browser.mjs chrome|firefox. Serves this folder; pages with and without shared memory load it into a worker,
 * and so do the page of the README and those that two bundlers have made.
 */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { load } from "fairmesh";
import puppeteer from "puppeteer-core";
import { dent } from "./meshes.mjs";

const TYPES = { html: "text/html", js: "text/javascript", mjs: "text/javascript", wasm: "application/wasm", css: "text/css" };
const ISOLATED = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
const readme = /```html\n([^]*?)```/.exec(readFileSync("node_modules/fairmesh/README.md", "utf8"))[1];

const server = createServer(({ url }, answer) => {
    const path = url.split("?")[0];
    const headers = url.includes("isolated") || path.endsWith(".js") ? ISOLATED : {};
    try {
        const body = path === "/readme.html" ? readme : readFileSync(`.${path}`);
        answer.writeHead(200, { "Content-Type": TYPES[path.split(".").at(-1)] ?? "text/plain", ...headers }).end(body);
    } catch {
        answer.writeHead(404).end();
    }
});
await new Promise((done) => server.listen(0, "localhost", done));
const at = `http://localhost:${server.address().port}`;
const name = process.argv[2];
const programs = { chrome: "/usr/bin/chromium", firefox: "/usr/bin/firefox-esr" };
const browser = await puppeteer.launch({
    browser: name,
    executablePath: programs[name],
    headless: true,
    args: name === "chrome" ? ["--no-sandbox"] : [],
});

/** What a page has found, once it has. */
async function opened(path, ready) {
    const page = await browser.newPage();
    page.on("pageerror", (why) => console.error(`${path}: ${why.message}`));
    await page.goto(at + path);
    await page.waitForFunction(ready, { timeout: 60000 });
    return page;
}

try {
    const library = await load();
    const mesh = dent();
    for (const path of ["/page.html", "/page.html?isolated"]) {
        const page = await opened(path, "window.found !== undefined");
        const { positions, ...found } = await page.evaluate("window.found");
        assert.deepEqual(found, {
            outcome: "converged",
            told: true,
            isIsolated: path.endsWith("isolated"),
            same: true,
            aborted: "AbortError, converged",
            refused: "free vertex 0 lies on the boundary of the mesh; fix it or leave it out of the selection",
        });
        assert.deepEqual(positions, Array.from(library.fair(mesh, mesh.free).positions), "the bits of node");
    }
    await opened("/readme.html", "document.getElementById('says')?.textContent === 'converged'");
    for (const bundler of ["bundle", "webpack"]) {
        const bundled = await opened(`/${bundler}/index.html`, "document.title !== 'bundled'");
        assert.equal(await bundled.title(), "converged", bundler);
    }
    console.log(`npm: ${await browser.version()}: a page, an isolated one, the README's, and two bundled ones have faired meshes in a worker`);
} finally {
    await browser.close();
    server.close();
}
