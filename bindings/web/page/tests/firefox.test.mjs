/** The page in Firefox: it starts, fairs a sphere, and follows a drag. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { difference, drag, launched, offSphere, opened, positions, press, take } from "./browser.mjs";

let browser;
before(async () => (browser = await launched("firefox")));
after(() => browser.close());

test("Firefox starts it from disk, fairs a sphere and follows a drag", async () => {
    const { page, seen, seconds } = await opened(browser);
    await take(page, "sphere");
    assert.match(await press(page, "fair"), /^Faired: 5,000 vertices/);
    assert.ok(offSphere(await positions(page)) < 1e-9);
    await take(page, "blend");
    await press(page, "fair");
    const fair = await positions(page);
    const frames = await drag(page, 2, [60, -60]);
    assert.ok(frames >= 5, `${frames} frames`);
    assert.ok(difference(await positions(page), fair) > 0.02);
    assert.deepEqual(seen.errors, []);
    console.log(`${await browser.version()}: starts in ${seconds.toFixed(2)} s, ${frames} frames for 30 movements`);
});
