/** The page where something is missing, in Chromium. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { ADDRESS, launched } from "./browser.mjs";

/** What is to be seen of the page in a browser that was started with these switches. */
async function seen(switches, before = () => undefined) {
    const browser = await launched("chrome", switches);
    const page = await browser.newPage();
    await page.evaluateOnNewDocument(before);
    await page.goto(ADDRESS);
    await page.waitForFunction("/cannot work/.test(document.querySelector('#status').textContent)");
    const found = await page.evaluate(() => ({
        text: document.querySelector("#status").textContent,
        shown: document.querySelector("#unable p").getBoundingClientRect().height > 0 && document.querySelector("#unable").innerText,
        live: [...document.querySelectorAll("button, select, input")].filter((each) => !each.disabled && !each.closest("fieldset:disabled")).map(({ id }) => id),
    }));
    await browser.close();
    return found;
}

test("without WebGL it says why and what can be done, and every button is off", async () => {
    const { text, shown, live } = await seen(["--disable-3d-apis"]);
    assert.match(text, /^The page cannot work here: .*WebGL 2 is switched off.*\. Switch on hardware acceleration in the browser's settings.*\.$/);
    assert.match(shown, /WebGL 2 is switched off/);
    assert.deepEqual(live, []);
});

test("so it is without WebAssembly", async () => {
    const { text, live } = await seen([], () => delete globalThis.WebAssembly);
    assert.match(text, /no WebAssembly.*\. Take another browser/);
    assert.deepEqual(live, []);
});
