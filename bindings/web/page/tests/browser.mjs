/** The page in a browser, as the tests open it: from disk, without a server. */

import { mkdtempSync, readdirSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const PROGRAMS = { chrome: "/usr/bin/chromium", firefox: "/usr/bin/firefox-esr" };
/** Software draws: machines that test have no screen. Containers have little shared memory. */
const CHROME = ["--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
/** Software draws every pixel: fewer of them, where the size does not matter. */
const USUAL = { width: 900, height: 600 };
export const DESKTOP = { width: 1280, height: 800 };
export const PHONE = { width: 390, height: 844, hasTouch: true, isMobile: true };
export const ADDRESS = pathToFileURL(resolve(process.env.LIVE_PAGE)).href;

/** Starts a browser. Without a window Firefox has no WebGL here: its window is on a screen of xvfb. */
export function launched(name = "chrome", more = []) {
    const preferences = { "webgl.force-enabled": true };
    return puppeteer.launch({ browser: name, executablePath: PROGRAMS[name], headless: name === "chrome", args: name === "chrome" ? [...CHROME, ...more] : [], extraPrefsFirefox: preferences });
}

/** Opens the page; whatever it throws, and whatever it asks of the network, is kept. */
export async function opened(browser, { viewport = USUAL, hash = "", isStoryTold = false, features = [] } = {}) {
    const page = await browser.newPage();
    if (features.length > 0) await page.emulateMediaFeatures(features);
    const seen = { errors: [], requests: [] };
    page.on("pageerror", (why) => seen.errors.push(why.message));
    page.on("request", (request) => seen.requests.push(request.url()));
    await page.setViewport(viewport);
    const start = performance.now();
    await page.goto(ADDRESS + hash, { waitUntil: "commit" }).catch(() => page.goto(ADDRESS + hash));
    await page.waitForFunction("document.documentElement.dataset.ready === 'yes'", { timeout: 30_000 });
    const seconds = (performance.now() - start) / 1000;
    if (!isStoryTold) await page.keyboard.press("Shift");
    if (!isStoryTold) await page.waitForFunction("!fairmesh.isBusy()");
    return { page, seen, seconds };
}

/** What the page says, once nothing is under way. */
export async function said(page) {
    await page.waitForFunction("!fairmesh.isBusy()", { timeout: 60_000 });
    return page.$eval("#status", (status) => status.textContent);
}

/** Presses a button by its id, and waits until what it does is done. */
export async function press(page, id) {
    await page.$eval(`#${id}`, (button) => button.click());
    return said(page);
}

/** Chooses a shape. */
export async function take(page, name) {
    await page.select("#shape", name);
    await page.waitForFunction((name) => document.querySelector("#status").textContent.startsWith(name), {}, await page.$eval(`#shape [value=${name}]`, (option) => option.text));
}

export const positions = async (page) => Float64Array.from(await page.evaluate("Array.from(fairmesh.positions())"));
export const triangles = async (page) => Uint32Array.from(await page.evaluate("Array.from(fairmesh.triangles())"));

/** The largest distance from the unit sphere. */
export function offSphere(points) {
    let most = 0;
    for (let k = 0; k < points.length; k += 3) most = Math.max(most, Math.abs(Math.hypot(points[k], points[k + 1], points[k + 2]) - 1));
    return most;
}

/** The largest difference of two lists of numbers of the same length. */
export function difference(a, b) {
    if (a.length !== b.length) throw new Error(`${a.length} and ${b.length} numbers`);
    return a.reduce((most, x, k) => Math.max(most, Math.abs(x - b[k])), 0);
}

/** Drags the arrow of a number; how many frames were shown. */
export async function drag(page, number, [right, down], steps = 30) {
    const { x, y } = (await page.evaluate("fairmesh.arrows()"))[number];
    const before = await page.evaluate("fairmesh.frames()");
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let k = 1; k <= steps; k++) {
        await page.mouse.move(x + (right * k) / steps, y + (down * k) / steps);
        await new Promise((done) => setTimeout(done, 10));
    }
    const frames = (await page.evaluate("fairmesh.frames()")) - before;
    await page.mouse.up();
    await settled(page);
    return frames;
}

/** Waits until the surface is that of the edits to the last digit. */
export async function settled(page) {
    await page.waitForFunction("/^(Edited|Fair) surface: (?!other)/.test(document.querySelector('#status').textContent) && !fairmesh.isBusy()", { timeout: 60_000 });
    return said(page);
}

/** Saves the surface by the page's own button, and reads what was written. */
export async function saved(page, format) {
    const folder = mkdtempSync(join(tmpdir(), "saved-"));
    const session = await page.createCDPSession();
    await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder, eventsEnabled: true });
    const done = new Promise((end) => session.on("Browser.downloadProgress", ({ state }) => state === "completed" && end()));
    await page.select("#format", format);
    await page.$eval("#save", (button) => button.click());
    await done;
    return readFileSync(join(folder, readdirSync(folder)[0]));
}
