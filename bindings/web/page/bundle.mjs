/** Makes the page, one file with everything inside: node bundle.mjs MODULE LICENCES SHAPES FILE */

import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const [module, licences, shapes, file] = process.argv.slice(2);

/** A program and all that it imports, as text that can stand in a page. It has no place of its own to find other files at. */
async function bundled(entry, format) {
    const define = { "import.meta.url": "location.href" };
    const options = { bundle: true, minify: true, format, define, target: "es2022", write: false, legalComments: "none", logLevel: "warning" };
    const made = await build({ entryPoints: [entry], ...options });
    return made.outputFiles[0].text.replaceAll("</script", "<\\/script");
}

const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
const block = (id, text) => `<script type="text/plain" id="data-${id}">${text}</script>`;
const packed = (bytes) => bytes.toString("base64");
const data = [
    block("module", packed(gzipSync(readFileSync(module), { level: 9 }))),
    block("worker", await bundled("../src/worker.ts", "iife")),
    ...readdirSync(shapes).sort().map((name) => block(name.split(".")[0], packed(readFileSync(join(shapes, name))))),
];
const parts = {
    "/*STYLE*/": readFileSync("style.css", "utf8"),
    LICENCES: escaped(readFileSync(licences, "utf8")),
    "<!--DATA-->": data.join("\n"),
    "/*SCRIPT*/": await bundled("src/main.ts", "esm"),
};
const page = readFileSync("page.html", "utf8").replace(new RegExp(Object.keys(parts).map((key) => key.replace(/[/*]/g, "\\$&")).join("|"), "g"), (key) => parts[key]);
writeFileSync(file, page);
