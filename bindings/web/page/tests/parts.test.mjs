/** What is told of each hole and each part, in Chromium; and what painting adds to. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launched, opened, press, said } from "./browser.mjs";
import { file, openSphere, sieve } from "./files.mjs";
import { chosen, middle, radio, upload } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

const lines = (page) => page.$$eval("#parts li", (all) => all.map((line) => [line.textContent, line.classList.contains("bad")]));
/** The file with a triangle that stands on an edge of its first rim: there the boundary branches. */
const finned = (text) => text.replace("endsolid", `${/facet normal[^]*?endfacet\n/.exec(text)[0].replace(/vertex [^\n]+(?=\nendloop)/, "vertex 0 0 3")}endsolid`);

test("each of nine boundaries has its own line, and those that stay open do not speak for the others", async () => {
    const { page } = await opened(browser);
    await upload(page, file("sieve.stl", finned(sieve(6))));
    const told = await press(page, "fill");
    assert.match(told, /^Holes: 7 of 9 filled by [\d,]+ triangles: 7 fair and sound, 2 left open: the list tells of each\.$/);
    const all = await lines(page);
    assert.equal(all.length, 9);
    assert.equal(all.filter(([text, isBad]) => !isBad && /^Hole \d \(\d+ edges\) fair and sound$/.test(text)).length, 7);
    assert.equal(all.filter(([text, isBad]) => isBad && /more than two triangles\. Paint the triangles there, and take “Erase and fill”$/.test(text)).length, 2, JSON.stringify(all));
    await page.close();
});

test("filled patches are no region: what is painted next is faired by itself, and a click on a line takes a patch again", async () => {
    const { page } = await opened(browser);
    await upload(page, file("sphere.stl", openSphere()));
    await press(page, "fill");
    assert.equal(await chosen(page), 0);
    await radio(page, "tool", "paint");
    await page.mouse.click(...(await middle(page)));
    const painted = await chosen(page);
    assert.ok(painted > 5 && painted < 300, String(painted));
    assert.match(await press(page, "fair"), /^Faired: \d+ vertices, \d+ iterations: tolerance met/);
    await press(page, "undo");
    await press(page, "undo");
    await press(page, "undo");
    assert.match(await press(page, "fill"), /^Holes: 2 of 2 filled by [\d,]+ triangles: all 2: tolerance met, and the surface is sound\.$/);
    await page.$eval("#parts button", (button) => button.click());
    assert.match(await said(page), /^Hole 1 \(24 edges\) is the region/);
    assert.ok((await chosen(page)) > 20);
    assert.match(await press(page, "fair"), /tolerance met/);
    assert.ok((await page.evaluate("fairmesh.arrows()")).length >= 8, "its boundary can be dragged");
    await page.close();
});

test("what is erased is filled, and is no region either", async () => {
    const { page, seen } = await opened(browser);
    await upload(page, file("sphere.stl", openSphere(24, 36)));
    const before = (await page.evaluate("fairmesh.triangles().length")) / 3;
    await radio(page, "tool", "paint");
    await page.mouse.click(...(await middle(page)));
    const painted = await chosen(page);
    // Triangles of the region between vertices that stay, stay.
    const stay = await page.evaluate(() => {
        const [region, triangles] = [fairmesh.region(), fairmesh.triangles()];
        const held = new Set(triangles.filter((_, k) => !region[Math.floor(k / 3)]));
        return region.reduce((sum, is, t) => sum + (is && [0, 1, 2].every((c) => held.has(triangles[3 * t + c])) ? 1 : 0), 0);
    });
    const told = /^Region: erased, and filled by ([\d,]+) triangles\.$/.exec(await press(page, "erase-fill"));
    assert.ok(told !== null && painted > 20);
    assert.equal(await page.evaluate("fairmesh.triangles().length / 3"), before - painted + stay + Number(told[1].replace(",", "")));
    assert.equal(await chosen(page), 0);
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("what was filled last has a colour of its own, until it is chosen", async () => {
    const { page } = await opened(browser);
    await upload(page, file("sphere.stl", openSphere()));
    /** Pixels of the picture that are redder than blue, as patches are. */
    const warm = async () => {
        await new Promise((done) => setTimeout(done, 800));
        return page.evaluate(() => {
            const canvas = document.querySelector("#canvas");
            const context = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
            context.drawImage(canvas, 0, 0);
            const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
            let count = 0;
            for (let k = 0; k < data.length; k += 4) if (data[k] - data[k + 2] > 45) count++;
            return count;
        });
    };
    await press(page, "fill");
    const filled = await warm();
    assert.ok(filled > 1000, String(filled));
    const left = [];
    for (const number of [0, 1]) {
        await page.evaluate((number) => document.querySelectorAll("#parts button")[number].click(), number);
        left.push(await warm());
    }
    assert.ok(Math.min(...left) < 0.2 * filled, `${left} of ${filled}`);
    await page.close();
});
