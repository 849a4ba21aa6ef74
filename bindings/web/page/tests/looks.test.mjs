/** How the page looks, in Chromium, as far as numbers can tell. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { DESKTOP, drag, launched, opened, PHONE } from "./browser.mjs";
import { file } from "./files.mjs";
import { middle, upload } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

test("on a screen of 1280 x 720 nothing has to be scrolled, and on a phone nothing is cut off", async () => {
    for (const [viewport, fits] of [[{ width: 1280, height: 720 }, true], [PHONE, false]]) {
        const { page } = await opened(browser, { viewport });
        const { high, shown, wide } = await page.$eval("#panel", (panel) => ({ high: panel.scrollHeight, shown: panel.clientHeight, wide: panel.scrollWidth - panel.clientWidth }));
        if (fits) assert.ok(high <= shown + 1, `${high} of ${shown}`);
        assert.equal(wide, 0);
        const beyond = await page.$$eval("button, select, label, output", (all) => all.filter((each) => each.getBoundingClientRect().right > innerWidth + 1).map(({ id, textContent }) => id || textContent));
        assert.deepEqual(beyond, []);
        await page.close();
    }
});

test("drawn coarsely or not while it moves, the picture is sharp at rest", async () => {
    const { page } = await opened(browser, { viewport: DESKTOP });
    await drag(page, 2, [60, -60]);
    await page.waitForFunction("(({ width, clientWidth }) => width === Math.floor(clientWidth * devicePixelRatio))(document.querySelector('#canvas'))", { timeout: 10_000 });
    await page.close();
});

test("left of the swipe is what was before, right of it what is now", async () => {
    const { page } = await opened(browser, { viewport: DESKTOP });
    const draw = (part) => page.evaluate(async (part) => {
        const swipe = document.querySelector("#swipe");
        swipe.value = String(part);
        swipe.dispatchEvent(new Event("input"));
        await new Promise((done) => setTimeout(done, 1200));
        const canvas = document.querySelector("#canvas");
        const context = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d");
        context.drawImage(canvas, 0, 0);
        const half = canvas.width >> 1;
        const sides = [context.getImageData(0, 0, half, canvas.height).data, context.getImageData(half, 0, half, canvas.height).data];
        return sides.map((side) => side.reduce((sum, x, k) => (sum + x * ((k % 101) + 1)) % 1e9, 0));
    }, part);
    const [now, half, then] = [await draw(0), await draw(50), await draw(100)];
    assert.ok(now[0] !== then[0] && now[1] !== then[1], "before and after differ");
    assert.deepEqual(half, [then[0], now[1]]);
    await page.close();
});

test("a file whose z points up stands upright by a click, and places are still its own", async () => {
    const { page } = await opened(browser);
    // A tall box: it is higher than wide in the picture when it stands.
    const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, 4 * (k >> 2)]);
    const faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]];
    const text = corners.map((at) => `v ${at.join(" ")}\n`).join("") + faces.map((f) => `f ${f.map((v) => v + 1).join(" ")}\n`).join("");
    await upload(page, file("tower.obj", text));
    await page.$eval("#up", (button) => button.click());
    const [u, v] = await middle(page);
    const height = async (down) => {
        await page.mouse.move(u, v + down);
        return page.$$eval("#spot dd", ([x, y, z]) => [x, y, z].map(({ textContent }) => Number(textContent)));
    };
    const [above, below] = [await height(-100), await height(100)];
    assert.ok(above[2] > below[2] + 1, `${above} above ${below}: z is up`);
    for (const [x, y, z] of [above, below]) {
        const off = Math.min(...[x, 1 - x, y, 1 - y, z, 4 - z].map(Math.abs));
        assert.ok(off < 1e-2 && x > -0.01 && x < 1.01 && y > -0.01 && y < 1.01 && z > -0.01 && z < 4.01, `${[x, y, z]} is on the tower`);
    }
    assert.equal(await page.$eval("#up", ({ textContent }) => textContent), "y up");
    await page.close();
});
