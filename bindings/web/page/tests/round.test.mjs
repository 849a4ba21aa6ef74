/** Sharp edges that are rounded on the page, in Chromium. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launched, opened, positions, press, said, take, triangles } from "./browser.mjs";
import { file, openSphere } from "./files.mjs";
import { upload } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

const widen = async (page, percent) => {
    await page.$eval("#width", (slider, value) => {
        slider.value = value;
        slider.dispatchEvent(new Event("input"));
        slider.dispatchEvent(new Event("change"));
    }, String(percent));
    return said(page);
};

/** The diagonal of the bracket. */
const DIAGONAL = 3;

/** Vertices near the middle of its long upright edge, where x = y = -1, as distances from the axis of a cylinder of this radius in it. */
const aroundEdge = (points, radius) => {
    const found = [];
    for (let k = 0; k < points.length; k += 3) {
        const [x, y, z] = points.subarray(k, k + 3);
        if (Math.abs(z) < 0.2 && x < -1 + radius - 1e-9 && y < -1 + radius - 1e-9) found.push(Math.hypot(x + 1 - radius, y + 1 - radius));
    }
    return found;
};

test("all edges of a bracket are rounded, and another width takes the place of that", async () => {
    const { page, seen } = await opened(browser);
    await take(page, "bracket");
    const sharp = await positions(page);
    assert.equal(await press(page, "round"), "Rounded: 18 edges rounded.");
    for (const percent of [3, 5]) {
        if (percent !== 3) assert.equal(await widen(page, percent), "Rounded: 18 edges rounded.");
        const radius = (percent / 100) * DIAGONAL;
        const around = aroundEdge(await positions(page), radius);
        assert.ok(around.length > 5 && around.every((distance) => Math.abs(distance - radius) < 2e-3), `${percent} %: ${around}`);
    }
    await press(page, "undo");
    assert.deepEqual(await positions(page), sharp, "the first width has been undone before");
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("a chosen region has only its own edges rounded, and a link tells of it", async () => {
    const { page } = await opened(browser);
    await take(page, "bracket");
    // The two outer sides that meet where x = y = -1.
    await page.evaluate(() => {
        const [points, corners] = [fairmesh.positions(), fairmesh.triangles()];
        const on = (t, axis) => [0, 1, 2].every((k) => points[3 * corners[3 * t + k] + axis] === -1);
        fairmesh.choose(Uint8Array.from({ length: corners.length / 3 }, (_, t) => (on(t, 0) || on(t, 1) ? 1 : 0)));
    });
    assert.equal(await press(page, "round"), "Rounded: 1 edge rounded.");
    const one = await positions(page);
    await page.waitForFunction("!fairmesh.isBusy()");
    await press(page, "link");
    const { page: other } = await opened(browser, { hash: await page.evaluate("location.hash") });
    assert.deepEqual(await positions(other), one);
    await other.close();
    await page.close();
});

test("another region is rounded besides, not in place of the one before", async () => {
    const { page } = await opened(browser);
    await take(page, "bracket");
    /** The two sides on planes of these axes, where the coordinate is -1 or that given. */
    const choose = (first, second) => page.evaluate((planes) => {
        const [points, corners] = [fairmesh.positions(), fairmesh.triangles()];
        const on = (t, [axis, at]) => [0, 1, 2].every((k) => points[3 * corners[3 * t + k] + axis] === at);
        fairmesh.choose(Uint8Array.from({ length: corners.length / 3 }, (_, t) => (planes.some((plane) => on(t, plane)) ? 1 : 0)));
    }, [first, second]);
    await choose([0, -1], [1, -1]);
    assert.equal(await press(page, "round"), "Rounded: 1 edge rounded.");
    const radius = 0.03 * DIAGONAL;
    assert.ok(aroundEdge(await positions(page), radius).length > 5);
    await choose([0, 1], [1, -0.5]);
    assert.equal(await press(page, "round"), "Rounded: 1 edge rounded.");
    const points = await positions(page);
    assert.ok(aroundEdge(points, radius).length > 5, "the first one is still round");
    assert.ok(!points.some((x, k) => k % 3 === 0 && x === 1 && points[k + 1] === -0.5 && Math.abs(points[k + 2]) < 0.4), "the second one is, too");
    await press(page, "undo");
    assert.ok(aroundEdge(await positions(page), radius).length > 5);
    await page.close();
});

test("where nothing is sharp, that is told, and nothing changes", async () => {
    const { page } = await opened(browser);
    await upload(page, file("sphere.stl", openSphere()));
    const before = await triangles(page);
    assert.match(await press(page, "round"), /^No edge bends enough to be rounded\. Choose the triangles/);
    assert.deepEqual(await triangles(page), before);
    await page.close();
});
