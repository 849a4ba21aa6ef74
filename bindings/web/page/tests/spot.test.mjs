/** The place under the pointer, in Chromium, and the command line's answer to what is copied of it: LIVE_PROGRAM is the program fairmesh. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";
import { drag, launched, opened, said, saved, take } from "./browser.mjs";
import { file, openSphere } from "./files.mjs";
import { middle, upload } from "./hands.mjs";

let browser;
before(async () => (browser = await launched()));
after(() => browser.close());

/** The sphere somewhere else, and larger: with coordinates of its own. */
const CENTRE = [-120, 45, 300];
const moved = () => openSphere(40, 60).replace(/vertex ([^\n]+)/g, (_, at) => `vertex ${at.split(" ").map((x, k) => 10 * Number(x) + CENTRE[k]).join(" ")}`);

/** What the clipboard has, pasted with the keyboard, when the page says that it was copied. */
async function pasted(page, flag) {
    await page.waitForFunction((flag) => document.querySelector("#status").textContent.startsWith(`Copied: --${flag} `), {}, flag);
    await page.evaluate(() => document.body.append(Object.assign(document.createElement("textarea"), { id: "paste" })));
    await page.focus("#paste");
    await page.keyboard.down("Control");
    await page.keyboard.press("v");
    await page.keyboard.up("Control");
    const text = await page.$eval("#paste", (field) => field.value);
    await page.$eval("#paste", (field) => field.remove());
    return text;
}
/** How many faces the command line selects with it. */
const selected = (path, text) => Number(/: (\d+) faces/.exec(execFileSync(process.env.LIVE_PROGRAM, ["select", path, ...text.split(" ")], { encoding: "utf8" }))[1]);
const shown = (page) => page.$$eval("#spot dd", (all) => all.map(({ textContent }) => Number(textContent)));

test("the place under the pointer is told in the file's coordinates, and the command line takes what is copied by key and by click", async () => {
    const { page, seen } = await opened(browser);
    const path = file("moved.stl", moved());
    await upload(page, path);
    const [u, v] = await middle(page);
    await page.mouse.move(u, v);
    const [x, y, z, radius] = await shown(page);
    const off = Math.hypot(x - CENTRE[0], y - CENTRE[1], z - CENTRE[2]);
    assert.ok(off > 9.9 && off < 10.01, `${off} from the centre`);
    const counts = {};
    await page.keyboard.press("b");
    const ball = await pasted(page, "ball");
    assert.match(ball, /^--ball -?[\d.]+,-?[\d.]+,-?[\d.]+,[\d.]+$/, "as the command line documents it");
    assert.equal(ball, `--ball ${x},${y},${z},${radius}`);
    assert.equal(await said(page), `Copied: ${ball}`);
    counts.ball = selected(path, ball);
    // Fixed by a click, so that the pointer can go to the buttons.
    await page.mouse.click(u, v);
    await page.click("#copy-geodesic");
    const geodesic = await pasted(page, "geodesic");
    assert.equal(geodesic, `--geodesic ${x},${y},${z},${radius}`);
    counts.geodesic = selected(path, geodesic);
    assert.ok(counts.ball > 10 && counts.geodesic > 10 && counts.geodesic <= counts.ball, JSON.stringify(counts));
    await page.click("#copy-bump");
    assert.equal(await pasted(page, "bump"), `--bump ${x},${y},${z}`);
    assert.deepEqual(seen.errors, []);
    await page.close();
});

test("a bump that is pointed at is the one that the command line takes away", async () => {
    const { page } = await opened(browser);
    await take(page, "sphere");
    const path = file("bumps.ply", await saved(page, "ply"));
    const [u, v] = await middle(page);
    // The bump at the right of the first view.
    await page.mouse.move(u + 120, v - 20);
    await page.keyboard.press("u");
    const count = selected(path, await pasted(page, "bump"));
    assert.ok(count > 50 && count < 3000, String(count));
    await page.close();
});

test("off the surface, over an arrow and while the view turns there is no place; the cross stays with the surface", async () => {
    const { page } = await opened(browser);
    const hidden = () => page.$eval("#spot", ({ hidden }) => hidden);
    const [u, v] = await middle(page);
    await page.mouse.move(u, v);
    assert.equal(await hidden(), false);
    const { x, y } = (await page.evaluate("fairmesh.arrows()"))[2];
    await page.mouse.move(x, y);
    assert.equal(await hidden(), true);
    await page.mouse.move(20, 100);
    assert.equal(await hidden(), true);
    await page.mouse.click(u, v);
    const at = () => page.$eval("#mark", ({ style }) => style.translate);
    const before = [await at(), ...(await shown(page))];
    await page.focus("#canvas");
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction((before) => document.querySelector("#mark").style.translate !== before, {}, before[0]);
    assert.deepEqual(await shown(page), before.slice(1));
    await drag(page, 2, [30, -30], 5);
    assert.equal(await hidden(), true, "the surface has moved away from it");
    await page.close();
});
