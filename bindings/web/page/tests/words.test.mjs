/** What the page says can be done: with its own buttons, in its own words. Of the library's answers none is left out. */

import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { launched, opened, positions, press, said, take, triangles } from "./browser.mjs";
import { file } from "./files.mjs";
import { chosen, middle, radio, upload } from "./hands.mjs";

const packaged = (name) => import(pathToFileURL(join(process.env.LIVE_PACKAGE, "dist", name)).href);
let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

/** Refusals of arguments that the page makes itself, and what only options lead to that it has not. */
const NOT_HERE = ["bad_struct_size", "aliasing", "busy", "not_on_loop", "bad_guide", "guides_cross", "bad_chain", "not_an_edge", "converged_loosely"];

test("each answer that has a remedy has one here, and each button that is named is there", async () => {
    const { page } = await opened(browser);
    const remedies = await page.evaluate("fairmesh.remedies");
    const labels = await page.$$eval("button, .choices span, label.button, label", (all) => all.map((each) => each.textContent.trim()));
    const [{ enums }, { load }] = [await packaged("abi.js"), await packaged("index.js")];
    const library = await load();
    for (const kind of ["status", "outcome", "looseReason", "fillOutcome", "fillReason"]) {
        for (const name of Object.keys(enums[kind])) {
            if (library.describe(kind, name).remedy !== "" && !NOT_HERE.includes(name)) assert.ok(remedies[name], `${kind} ${name}`);
        }
    }
    for (const [name, text] of Object.entries(remedies)) {
        assert.doesNotMatch(text, /callback|option|argument|function|selection|prescribe|free vert|handle\b|\w_\w|inner fairness/, name);
        for (const [, button] of text.matchAll(/“([^”]+)”/g)) assert.ok(labels.includes(button), `${name}: there is no ${button}`);
    }
    const texts = await page.evaluate("fairmesh.texts");
    for (const kind of ["outcome", "looseReason", "fillOutcome", "fillReason"]) {
        for (const name of Object.keys(enums[kind])) assert.doesNotMatch(texts[name] ?? library.describe(kind, name).text, /callback|report|returned|argument|option/, `${kind} ${name}`);
    }
    await page.close();
});

test("Remesh makes better triangles of the region, which stays one, and is faired next", async () => {
    const { page, seen } = await opened(browser);
    await take(page, "head");
    await radio(page, "tool", "paint");
    await page.mouse.click(...(await middle(page)));
    const painted = await chosen(page);
    await press(page, "grow");
    await page.waitForFunction((painted) => fairmesh.region().reduce((sum, x) => sum + x, 0) > painted, {}, painted);
    const [before, count] = [await chosen(page), (await triangles(page)).length / 3];
    const told = /^Region: remeshed, from ([\d,]+) to ([\d,]+) triangles of like size\. Fair it next\.$/.exec(await press(page, "remesh"));
    assert.equal(Number(told[1].replace(",", "")), before);
    const after = Number(told[2].replace(",", ""));
    assert.equal(await chosen(page), after);
    // Triangles between vertices that stay are not made anew.
    const kept = (await triangles(page)).length / 3 - after - (count - before);
    assert.ok(kept >= 0 && kept < 0.01 * before, String(kept));
    assert.match(await press(page, "fair"), /^Faired: [\d,]+ vertices, \d+ iterations: /);
    assert.ok((await positions(page)).every(Number.isFinite));
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("a region that is too thin, or has nothing that holds it, is answered by what to press", async () => {
    const { page } = await opened(browser);
    await upload(page, file("tetra.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"));
    await press(page, "all");
    assert.match(await press(page, "fair"), /^Nothing would hold the region: all of a part is chosen\. “Unpaint” a part: what stays holds the rest\.$/);
    await take(page, "sphere");
    await press(page, "clear");
    await radio(page, "tool", "paint");
    await page.$eval("#brush", (brush) => (brush.value = "1"));
    await page.mouse.click(...(await middle(page)));
    assert.match(await press(page, "fair"), /^Nothing can move: the region is too thin\. Paint more, or take “Grow”/);
    assert.match(await said(page), /Grow/);
    await page.close();
});
