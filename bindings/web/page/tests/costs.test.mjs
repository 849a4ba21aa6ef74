/** What large files cost is told before, in Chromium; LIVE_PROGRAM makes them. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";
import { launched, opened, positions, press, said } from "./browser.mjs";
import { file } from "./files.mjs";
import { upload } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

const status = (page, pattern) => page.waitForFunction((pattern) => new RegExp(pattern).test(document.querySelector("#status").textContent), { timeout: 120_000 }, pattern);
const click = (page, id) => page.$eval(`#${id}`, (button) => button.click());

test("what fairing will cost is told beside its button: seconds, and memory as the library says", async () => {
    const { page } = await opened(browser);
    await page.waitForFunction("!document.querySelector('#cost').hidden");
    const told = /^([\d,]+) vertices move: about ([\d.]+) s, at most (\d+) MB of memory\.$/.exec(await page.$eval("#cost", ({ textContent }) => textContent));
    assert.ok(told !== null && Number(told[3]) > 10 && Number(told[3]) < 200, String(told));
    assert.match(await press(page, "fair"), new RegExp(`^Faired: ${told[1]} vertices`));
    await press(page, "clear");
    await page.waitForFunction("document.querySelector('#cost').hidden");
    await page.close();
});

test("before what takes long it asks: Stop leaves all as it was, Go on takes about as long as was told", async () => {
    const { page, seen } = await opened(browser);
    page.setDefaultTimeout(120_000);
    const path = file("large.ply", "");
    execFileSync(process.env.LIVE_PROGRAM, ["generate", "sphere-hole", "--vertices", "110000", "--quiet", "-o", path]);
    assert.match(await upload(page, path), /triangles, 1 boundary/);
    const before = await positions(page);
    await press(page, "all");
    await click(page, "fair");
    await status(page, "^Faired: this takes about [\\d.]+ s, at most [\\d.]+ GB of memory\\. Go on\\?$");
    await click(page, "stop");
    assert.equal(await said(page), "Faired: stopped, nothing has changed.");
    assert.deepEqual(await positions(page), before);
    await click(page, "fair");
    await status(page, "Go on\\?$");
    const told = Number(/about ([\d.]+) s/.exec(await page.$eval("#status", ({ textContent }) => textContent))[1]);
    const start = performance.now();
    await click(page, "go");
    await status(page, "^Faired: [\\d,]+ vertices");
    const took = (performance.now() - start) / 1000;
    console.log(`told ${told} s, took ${took.toFixed(1)} s`);
    assert.ok(took < 4 * told && told < 4 * took, `told ${told} s, took ${took} s`);
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("a file that is too much is not even read when Stop is pressed", async () => {
    const { page } = await opened(browser);
    const before = await positions(page);
    await (await page.$("#file")).uploadFile(file("huge.ply", "ply\nformat ascii 1.0\nelement vertex 3000000\nelement face 6000000\nend_header\n"));
    await status(page, "^huge\\.ply: this takes about \\d+ s, at most 1\\.8 GB of memory\\. Go on\\?$");
    await click(page, "stop");
    assert.equal(await said(page), "huge.ply: stopped, nothing has changed.");
    assert.deepEqual(await positions(page), before);
    await page.close();
});
