/** The page of `fairmesh --report`: the place under the pointer, as the command line takes it. */

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { launched } from "./browser.mjs";

const folder = mkdtempSync(join(tmpdir(), "report-"));
const program = (...words) => execFileSync(process.env.LIVE_PROGRAM, words, { cwd: folder, encoding: "utf8" });
/** Where the sphere is: digits have to be those of its size, not of its place. */
const CENTRE = [1000, -2000, 500];
let browser, page;

before(async () => {
    program("generate", "sphere-cap", "-o", "cap.obj", "--vertices", "2000", "--outside", "8", "--free", "free.txt");
    const text = readFileSync(join(folder, "cap.obj"), "utf8");
    const moved = text.replace(/^v (\S+) (\S+) (\S+)$/gm, (_, ...xyz) => `v ${CENTRE.map((c, k) => c + 10 * Number(xyz[k])).join(" ")}`);
    writeFileSync(join(folder, "far.obj"), moved);
    program("fair", "far.obj", "-o", "fair.obj", "--ball", [CENTRE[0], CENTRE[1], CENTRE[2] + 10, 5].join(","), "--report", "report.html", "-q");
    browser = await launched();
    page = await browser.newPage();
    await page.setViewport({ width: 1280, height: 900 });
    await page.goto(pathToFileURL(join(folder, "report.html")).href);
    await page.waitForFunction("[...document.querySelectorAll('figure[data-depths]')].every((figure) => figure.dataset.ready)");
});
after(() => browser?.close());

/** The middle of a picture. */
async function middle(number) {
    const image = (await page.$$("figure img"))[number];
    await image.scrollIntoView();
    const { x, y, width, height } = await image.boundingBox();
    return { x: x + width / 2, y: y + height / 2 };
}

const told = (number) => page.$$eval("figure output", (all, k) => all[k].textContent, number);

test("the place under the pointer is on the surface", async () => {
    for (const number of [0, 1, 3, 5]) {
        const { x, y } = await middle(number);
        await page.mouse.move(x, y);
        const place = (await told(number)).split(",").map(Number);
        const radius = Math.hypot(...place.map((p, k) => p - CENTRE[k]));
        assert.ok(Math.abs(radius - 10) < 0.05, `${number}: ${place}`);
        assert.ok((await told(number)).length < 36, await told(number));
    }
    await page.mouse.move(1, 1);
    assert.equal(await told(1), "");
});

test("a click keeps it, and what is copied is what the command line takes", async () => {
    const { x, y } = await middle(1);
    await page.mouse.click(x + 60, y);
    await page.mouse.move(1, 1);
    const place = await told(1);
    assert.equal(place.split(",").length, 3);
    for (const [flag, count] of [["ball", 4], ["bump", 3], ["geodesic", 4]]) {
        await (await page.$$(`button[data-flag=${flag}]`))[1].click();
        await page.waitForFunction((flag) => document.querySelectorAll("figure output")[1].textContent.includes(`copied: --${flag} `), {}, flag);
        const words = (await told(1)).split("copied: ")[1].split(" ");
        assert.ok(words[1].startsWith(place) && words[1].split(",").length === count, words.join(" "));
        if (flag === "bump") continue;
        assert.match(program("select", "fair.obj", "-o", "list.txt", ...words), /faces/);
    }
});
