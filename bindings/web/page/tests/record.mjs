/** Pictures of a drag, one a step: LIVE_PAGE=FILE node record.mjs FOLDER. By steps, not by the clock: the same surfaces every time. */

import { join } from "node:path";
import { launched, opened, press, said } from "./browser.mjs";

const folder = process.argv[2];
const STEPS = 22;
const browser = await launched();
const { page } = await opened(browser, { viewport: { width: 1100, height: 700 } });
let count = 0;
const shot = () => page.screenshot({ path: join(folder, `${String(count++).padStart(3, "0")}.png`) });

/** The pointer is not in the pictures of the browser. */
await page.evaluate(() => {
    const pointer = document.createElement("div");
    pointer.id = "pointer";
    pointer.style.cssText = "position:fixed;width:18px;height:18px;border-radius:9px;border:3px solid #b3126b;translate:-50% -50%;pointer-events:none";
    document.body.append(pointer);
});
const place = (x, y) => page.$eval("#pointer", (pointer, x, y) => Object.assign(pointer.style, { left: `${x}px`, top: `${y}px` }), x, y);

await press(page, "fair");
await page.$eval("input[name=shading][value=lines]", (button) => button.click());
for (const [number, [right, down]] of [[2, [70, -60]], [2, [-110, 80]]]) {
    const { x, y } = (await page.evaluate("fairmesh.arrows()"))[number];
    await place(x, y);
    for (let k = 0; k < 3; k++) await shot();
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let k = 1; k <= STEPS; k++) {
        const part = (1 - Math.cos((Math.PI * k) / STEPS)) / 2;
        await page.mouse.move(x + right * part, y + down * part);
        await place(x + right * part, y + down * part);
        await page.waitForFunction("!fairmesh.isBusy()");
        await new Promise((done) => setTimeout(done, 60));
        await shot();
    }
    await page.mouse.up();
    await said(page);
    await shot();
}
await browser.close();
