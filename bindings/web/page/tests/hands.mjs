/** What hands do on the page: files, tools, places. */

import { said } from "./browser.mjs";

export const upload = async (page, path) => {
    await (await page.$("#file")).uploadFile(path);
    await page.waitForFunction("!document.querySelector('#status').textContent.endsWith('…')");
    return said(page);
};

export const radio = (page, name, value) => page.$eval(`input[name=${name}][value=${value}]`, (button) => button.click());

/** How many triangles are chosen. */
export const chosen = (page) => page.evaluate("fairmesh.region().reduce((sum, x) => sum + x, 0)");

/** The middle of the view. */
export const middle = async (page) => {
    const { x, y, width, height } = await page.$eval("#canvas", (canvas) => canvas.getBoundingClientRect().toJSON());
    return [x + width / 2, y + height / 2];
};
