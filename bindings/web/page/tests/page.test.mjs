/** The page as people use it, in Chromium: LIVE_PAGE=FILE node --test page.test.mjs */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";
import { ADDRESS, DESKTOP, difference, drag, launched, offSphere, opened, PHONE, positions, press, said, saved, settled, take, triangles } from "./browser.mjs";
import { BAD, file, fin, openSphere } from "./files.mjs";
import { chosen, middle, radio, upload } from "./hands.mjs";

const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

/** Drops a file on the page. */
const dropped = async (page, name, content) => {
    await page.evaluate((name, content) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([content], name));
        document.body.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    }, name, content);
    await page.waitForFunction("/triangles, /.test(document.querySelector('#status').textContent)");
    return said(page);
};
/** Numbers of the lines of a PLY file behind its header. */
const vertices = (bytes) => {
    const [head, body] = bytes.toString().split("end_header\n");
    return body.split("\n").slice(0, Number(/element vertex (\d+)/.exec(head)[1])).flatMap((line) => line.trim().split(" ").map(Number));
};

/** The page as it starts at the quickest of three: the others tell what else the machine had to do. */
async function quickest(browser) {
    let least = await opened(browser);
    for (let again = 0; again < 2 && least.seconds >= 3; again += 1) {
        const next = await opened(browser);
        const [kept, closed] = next.seconds < least.seconds ? [next, least] : [least, next];
        await closed.page.close();
        least = kept;
    }
    return least;
}

test("it starts in three seconds from disk, and asks nothing of the network, then or later", async () => {
    const { page, seen, seconds } = await quickest(browser);
    assert.ok(seconds < 3, `${seconds} s at the quickest of three`);
    await press(page, "fair");
    await drag(page, 0, [30, -30], 5);
    await saved(page, "ply");
    const elsewhere = seen.requests.filter((url) => !/^(data|blob):/.test(url));
    assert.deepEqual(elsewhere.map((url) => url.split("#")[0]), [page.url().split("#")[0]]);
    // It could not even if it wanted to.
    assert.equal(await page.evaluate("fetch('https://example.org/').then(() => 'sent', () => 'refused')"), "refused");
    assert.deepEqual(seen.errors, []);
    console.log(`starts in ${seconds.toFixed(2)} s`);
    await page.close();
});

test("a faired sphere is a sphere in the file that is saved, and so is it when its hole is filled", async () => {
    const { page } = await opened(browser);
    await take(page, "sphere");
    assert.ok(offSphere(await positions(page)) > 0.1, "it begins with bumps");
    assert.match(await press(page, "fair"), /^Faired: 5,000 vertices, \d+ iterations: tolerance met, and the surface is sound\.$/);
    const written = vertices(await saved(page, "ply"));
    assert.ok(offSphere(written) < 1e-9, String(offSphere(written)));
    assert.match(await press(page, "fill"), /^Holes: 1 of 1 filled by [\d,]+ triangles: tolerance met/);
    assert.ok(offSphere(await positions(page)) < 1e-3, String(offSphere(await positions(page))));
    await page.close();
});

test("a dragged arrow is followed frame by frame, and going back gives the fair surface again", async () => {
    const { page, seen } = await opened(browser);
    await press(page, "fair");
    const fair = await positions(page);
    const frames = await drag(page, 2, [60, -60]);
    assert.ok(frames >= 10, `${frames} frames for 30 movements`);
    const [edit] = await page.evaluate("fairmesh.edits()");
    assert.ok(edit.kind === "tilt" && Math.abs(edit.angle) > 0.1, JSON.stringify(edit));
    const tilted = await positions(page);
    assert.ok(difference(tilted, fair) > 0.02, "the surface has followed");
    const [loop] = await page.evaluate("fairmesh.arrows().map(({ loop }) => loop)");
    assert.equal(loop, 0);
    await press(page, "undo");
    assert.deepEqual(await page.evaluate("fairmesh.edits()"), []);
    assert.ok(difference(await positions(page), fair) < 1e-7, String(difference(await positions(page), fair)));
    assert.deepEqual(seen.errors, []);
    console.log(`${frames} frames for 30 movements, drawn by software`);
    await page.close();
});

test("arrows move a loop, a slider bulges the surface, and the falloff keeps the far side of a loop", async () => {
    const { page } = await opened(browser);
    await press(page, "fair");
    const fair = await positions(page);
    await radio(page, "edit", "move");
    await drag(page, 1, [40, 10], 8);
    const [move] = await page.evaluate("fairmesh.edits()");
    assert.equal(move.kind, "move");
    const moved = await positions(page);
    for (const vertex of move.vertices.slice(0, 5)) {
        for (let c = 0; c < 3; c++) assert.ok(Math.abs(moved[3 * vertex + c] - fair[3 * vertex + c] - move.translation[c]) < 1e-9);
    }
    await press(page, "reset");
    await settled(page);
    await page.$eval("#bulge", (slider) => {
        slider.value = "0.1";
        slider.dispatchEvent(new Event("input"));
        slider.dispatchEvent(new Event("change"));
    });
    await settled(page);
    assert.equal((await page.evaluate("fairmesh.edits()"))[0].kind, "bulge");
    assert.ok(difference(await positions(page), fair) > 0.01);
    await page.close();
});

test("the curves of the tetra thing stay where they are, and are dragged as boundaries are", async () => {
    const { page } = await opened(browser);
    await take(page, "tetra");
    const before = await positions(page);
    assert.match(await press(page, "fair"), /^Faired: 4,812 vertices, \d+ iterations: all 4: tolerance met, and the surface is sound\.$/);
    const fair = await positions(page);
    const stay = Array.from({ length: fair.length / 3 }, (_, v) => [0, 1, 2].every((c) => fair[3 * v + c] === before[3 * v + c]));
    assert.equal(stay.filter(Boolean).length, 228, "six circles of 38");
    assert.equal(await page.evaluate("new Set(fairmesh.arrows().map(({ loop }) => loop)).size"), 6);
    await drag(page, 0, [30, -30], 5);
    assert.equal((await page.evaluate("fairmesh.edits()"))[0].kind, "tilt");
    assert.ok(difference(await positions(page), fair) > 1e-3);
    await page.close();
});

test("bad files are answered by what is wrong and what can be done, and the surface stays", async () => {
    const { page, seen } = await opened(browser);
    const before = await positions(page);
    for (const [name, content, expected] of BAD) {
        const told = await upload(page, file(name, content));
        assert.match(told, expected, name);
        assert.ok(await page.$eval("#status", (status) => status.classList.contains("bad")), name);
    }
    assert.deepEqual(await positions(page), before);
    // The library's own message, with its advice.
    await upload(page, file("fin.obj", fin()));
    await press(page, "all");
    assert.match(await press(page, "fair"), /^Edge \(\d+, \d+\) has more than two triangles.*\. “Unpaint” the triangles there, or repair the file\.$/);
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("an own STL file becomes one surface, which is painted, lassoed, filled and joined", async () => {
    const { page } = await opened(browser);
    assert.match(await dropped(page, "sphere.stl", openSphere()), /^Sphere\.stl: 768 triangles, 2 boundaries/i);
    assert.equal((await positions(page)).length / 3, 17 * 24, "corners at one place are one vertex");
    assert.match(await press(page, "fair"), /No region is chosen/);
    const [u, v] = await middle(page);
    await radio(page, "tool", "paint");
    await page.mouse.click(u, v);
    const painted = await chosen(page);
    assert.ok(painted > 5 && painted < 300, String(painted));
    await page.$eval("#grow", (button) => button.click());
    await page.waitForFunction((before) => fairmesh.region().reduce((sum, x) => sum + x, 0) > before, {}, painted);
    await press(page, "clear");
    await radio(page, "tool", "lasso");
    await page.mouse.move(u - 90, v - 90);
    await page.mouse.down();
    for (const [a, b] of [[90, -90], [90, 90], [-90, 90]]) await page.mouse.move(u + a, v + b, { steps: 4 });
    await page.mouse.up();
    const lassoed = await chosen(page);
    assert.ok(lassoed > 10 && lassoed < 300, `${lassoed}: the far side is not taken`);
    assert.match(await press(page, "fair"), /^Faired: /);
    assert.match(await press(page, "fill"), /^Holes: 2 of 2 filled/);
    const count = (await triangles(page)).length / 3;
    assert.ok(count > 768);
    assert.equal((await saved(page, "stl")).length, 84 + 50 * count);
    const again = file("again.obj", await saved(page, "obj"));
    const closed = await positions(page);
    await press(page, "undo");
    assert.equal((await triangles(page)).length / 3, 768);
    assert.match(await press(page, "bridge"), /^Joined: /);
    assert.match(await upload(page, again), new RegExp(`^Again\\.obj: ${count.toLocaleString("en")} triangles, closed`, "i"));
    assert.deepEqual((await positions(page)).sort(), closed.sort(), "nothing is lost in a file of text");
    await page.close();
});

test("the address has the whole state, and a damaged one is told", async () => {
    const { page } = await opened(browser);
    await press(page, "fair");
    await drag(page, 3, [40, -20], 5);
    await radio(page, "shading", "lines");
    await press(page, "link");
    const [there, edits] = [await positions(page), await page.evaluate("fairmesh.edits()")];
    const view = await page.evaluate("fairmesh.view()");
    const hash = new URL(page.url()).hash;
    await page.close();
    const again = await opened(browser, { hash });
    assert.ok(difference(await positions(again.page), there) < 1e-7);
    assert.deepEqual(await again.page.evaluate("fairmesh.edits()"), edits);
    assert.ok(difference(await again.page.evaluate("fairmesh.view()"), view) < 1e-3);
    assert.equal(await again.page.$eval("input[name=shading]:checked", ({ value }) => value), "lines");
    await again.page.close();
    const damaged = await opened(browser, { hash: hash.slice(0, 40) });
    assert.match(await said(damaged.page), /^The link is damaged/);
    await damaged.page.close();
});

test("a run is stopped, nothing has changed, and the next one works", async () => {
    const { page } = await opened(browser);
    await take(page, "blend13k");
    const before = await positions(page);
    await page.evaluate("document.getElementById('fair').click(), setTimeout(() => document.getElementById('stop').click(), 60)");
    await page.waitForFunction("document.querySelector('#status').textContent === 'Faired: stopped, nothing has changed.'");
    assert.deepEqual(await positions(page), before);
    assert.match(await press(page, "fair"), /tolerance met/);
    // The worker is another one then, and has to make its solver anew.
    await page.evaluate("document.getElementById('range').click(), setTimeout(() => document.getElementById('stop').click(), 200)");
    await page.waitForFunction("document.querySelector('#status').textContent === 'How far it can bulge: stopped, nothing has changed.'");
    await drag(page, 0, [20, -20], 5);
    assert.match(await said(page), /^Edited surface: tolerance met/);
    await page.close();
});

/** Presses Tab until an element has the focus, which is to be seen. */
async function tabTo(page, id) {
    for (let k = 0; k < 60; k++) {
        await page.keyboard.press("Tab");
        const found = await page.evaluate(() => {
            const { id, name, tagName } = document.activeElement;
            const shown = [document.activeElement, document.activeElement.closest("label"), document.activeElement.previousElementSibling];
            // Behind the last one there is the browser, which is nothing of the page.
            return { id: id || name, isSeen: tagName === "BODY" || shown.some((each) => each && getComputedStyle(each).outlineStyle !== "none") };
        });
        assert.ok(found.isSeen, `the focus on ${found.id} is not seen`);
        if (found.id === id) return;
    }
    assert.fail(`Tab does not lead to ${id}`);
}

test("all can be done from the keyboard", async () => {
    const { page, seen } = await opened(browser);
    await tabTo(page, "shape");
    await page.keyboard.press("ArrowUp");
    await page.waitForFunction("document.querySelector('#status').textContent.startsWith('Sphere')");
    await tabTo(page, "canvas");
    const view = await page.evaluate("fairmesh.view()");
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("+");
    assert.ok(difference(await page.evaluate("fairmesh.view()"), view) > 0.01);
    await tabTo(page, "tool");
    await page.keyboard.press("ArrowRight");
    await tabTo(page, "clear");
    await page.keyboard.press("Enter");
    await page.keyboard.down("Shift");
    for (let k = 0; k < 40 && (await page.evaluate("document.activeElement.id")) !== "canvas"; k++) await page.keyboard.press("Tab");
    await page.keyboard.up("Shift");
    await page.keyboard.press("Space");
    assert.ok((await page.evaluate("fairmesh.region().reduce((sum, x) => sum + x, 0)")) > 10, "painted at the cross");
    await tabTo(page, "fair");
    await page.keyboard.press("Enter");
    await page.waitForFunction("document.querySelector('#status').textContent.startsWith('Faired: ')");
    await said(page);
    await tabTo(page, "angle");
    for (let k = 0; k < 8; k++) await page.keyboard.press("ArrowRight");
    await settled(page);
    const [edit] = await page.evaluate("fairmesh.edits()");
    assert.ok(Math.abs(edit.angle - (8 * Math.PI) / 180) < 1e-12, JSON.stringify(edit));
    await page.keyboard.down("Control");
    await page.keyboard.press("z");
    await page.keyboard.up("Control");
    await page.waitForFunction("fairmesh.edits().length === 0");
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("a finger on a phone drags an arrow, and nothing is wider than the screen", async () => {
    const { page, seen } = await opened(browser, { viewport: PHONE });
    await press(page, "fair");
    const { scrollWidth, clientWidth } = await page.$eval("html", ({ scrollWidth, clientWidth }) => ({ scrollWidth, clientWidth }));
    assert.equal(scrollWidth, clientWidth);
    const before = await positions(page);
    const { x, y } = (await page.evaluate("fairmesh.arrows()"))[0];
    await page.touchscreen.touchStart(x, y);
    for (let k = 1; k <= 10; k++) await page.touchscreen.touchMove(x + 3 * k, y - 2 * k);
    await page.touchscreen.touchEnd();
    await settled(page);
    assert.equal((await page.evaluate("fairmesh.edits()")).length, 1);
    assert.ok(difference(await positions(page), before) > 1e-3);
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("axe-core finds nothing against it, on a desktop in light and on a phone in dark, before and after", async () => {
    for (const [viewport, scheme] of [[DESKTOP, "light"], [PHONE, "dark"]]) {
        const { page } = await opened(browser, { viewport });
        await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
        for (const id of ["bad", "fair"]) {
            if (id === "fair") await press(page, "fair");
            else await upload(page, file("x.ply", "no"));
            await radio(page, "shading", "curvature");
            await page.evaluate(AXE);
            const { violations, passes } = await page.evaluate("axe.run()");
            assert.ok(passes.length > 15);
            const found = violations.map(({ id, impact, nodes }) => `${impact} ${id}: ${nodes.map(({ html }) => html.slice(0, 100)).join(" | ")}`);
            assert.deepEqual(found, [], `${scheme}, ${viewport.width}`);
        }
        await page.close();
    }
});
