/** Colours of curvature and their scale, in Chromium. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launched, opened, press, take } from "./browser.mjs";
import { file, openSphere } from "./files.mjs";
import { middle, radio, upload } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

const ticks = (page) => page.$$eval("#legend div span", (all) => all.map(({ textContent }) => Number(textContent.replace("−", "-"))));

test("the scale is there at once, with numbers and their unit; a ball of radius 2 has H = −0.5 under the pointer", async () => {
    const { page } = await opened(browser);
    await upload(page, file("ball.stl", openSphere(40, 60).replace(/vertex ([^\n]+)/g, (_, at) => `vertex ${at.split(" ").map((x) => 2 * x).join(" ")}`)));
    const seconds = await page.evaluate(async () => {
        const start = performance.now();
        document.querySelector("input[name=shading][value=curvature]").click();
        while (document.querySelector("#legend").hidden) await new Promise(requestAnimationFrame);
        return (performance.now() - start) / 1000;
    });
    assert.ok(seconds < 0.1, `${seconds} s`);
    await page.waitForFunction("document.querySelector('#legend div span').textContent !== ''");
    assert.deepEqual(await ticks(page), [-0.5, -0.25, 0, 0.25, 0.5]);
    assert.match(await page.$eval("#legend figcaption", ({ textContent }) => textContent), /1 \/ unit of the file/);
    assert.match(await page.$eval("#legend small", ({ textContent }) => textContent), /radius 2 has −0\.5$/);
    await page.mouse.move(...(await middle(page)));
    const told = Number(await page.$eval("#spot-h", ({ textContent }) => textContent));
    assert.ok(Math.abs(told + 0.5) < 0.01, String(told));
    await radio(page, "shading", "plain");
    assert.equal(await page.$eval("#legend", ({ hidden }) => hidden), true);
    await page.close();
});

test("its colours are those of the surface: the faired sphere has one of them, its bumps had many", async () => {
    const { page } = await opened(browser);
    await take(page, "sphere");
    await radio(page, "shading", "curvature");
    await page.waitForFunction("Number(document.querySelector('#legend-inverse').textContent) > 1");
    const bumpy = await ticks(page);
    await press(page, "fair");
    await page.waitForFunction("Number(document.querySelector('#legend-inverse').textContent) === 1");
    assert.ok(bumpy[4] > 1, String(bumpy));
    await page.close();
});
