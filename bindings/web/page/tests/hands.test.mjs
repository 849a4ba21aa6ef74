/** Painting and dragging beside each other, in Chromium. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { difference, drag, launched, opened, positions, press, settled } from "./browser.mjs";
import { chosen, middle, radio } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

const edits = (page) => page.evaluate("fairmesh.edits()");

test("with every tool an arrow can be taken: it is dragged, and the region stays", async () => {
    const { page } = await opened(browser);
    const count = await chosen(page);
    for (const tool of ["paint", "erase", "lasso"]) {
        await radio(page, "tool", tool);
        const before = await positions(page);
        await drag(page, 2, [40, -40], 8);
        assert.equal((await edits(page)).length, 1, tool);
        assert.ok(difference(await positions(page), before) > 0.005, tool);
        assert.equal(await chosen(page), count, tool);
        await drag(page, 2, [-30, 30], 8);
    }
    await page.close();
});

test("painting keeps what was dragged, at once and when the new region is faired; Undo brings the arrows back", async () => {
    const { page, seen } = await opened(browser);
    const fair = await positions(page);
    const count = await chosen(page);
    await drag(page, 2, [60, -60]);
    const [tilt] = await edits(page);
    const dragged = await positions(page);
    await radio(page, "tool", "erase");
    await page.mouse.click(...(await middle(page)));
    await page.waitForFunction((count) => fairmesh.region().reduce((sum, x) => sum + x, 0) < count, {}, count);
    assert.deepEqual(await positions(page), dragged, "nothing moves while a region is chosen");
    await press(page, "undo");
    await settled(page);
    assert.deepEqual(await edits(page), [tilt], "its arrows are back");
    assert.ok(difference(await positions(page), dragged) < 1e-7);
    await page.mouse.click(...(await middle(page)));
    await page.waitForFunction((count) => fairmesh.region().reduce((sum, x) => sum + x, 0) < count, {}, count);
    assert.match(await press(page, "fair"), /tolerance met/);
    assert.deepEqual(await edits(page), [tilt], "what was turned stays turned");
    const off = difference(await positions(page), dragged);
    assert.ok(off < 0.1 * difference(dragged, fair), `${off} of ${difference(dragged, fair)}`);
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("who paints before the hand has come to rest loses nothing", async () => {
    const { page } = await opened(browser);
    await radio(page, "tool", "erase");
    const count = await chosen(page);
    const { x, y } = (await page.evaluate("fairmesh.arrows()"))[2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 40, y - 40, { steps: 5 });
    await page.mouse.up();
    await page.mouse.click(...(await middle(page)));
    await page.waitForFunction((count) => fairmesh.region().reduce((sum, x) => sum + x, 0) < count, {}, count);
    const there = await positions(page);
    await press(page, "undo");
    await settled(page);
    assert.equal((await edits(page)).length, 1);
    assert.ok(difference(await positions(page), there) < 1e-7, "it was that to the last digit");
    await page.close();
});
