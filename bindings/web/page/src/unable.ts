/** Where the page cannot work: it says what is missing and what can be done, and no button pretends. */

import { element, say, told } from "./page.js";

/** What is missing, and where it is had again. */
class Missing extends Error {
    constructor(
        message: string,
        readonly remedy: string,
    ) {
        super(message);
    }
}

/** What is missing, if it is that. */
function missing(why: unknown): unknown {
    if (typeof WebAssembly !== "object") return new Missing("this browser has no WebAssembly, in which the surface is computed", "take another browser, or allow it in the settings");
    if (typeof Worker !== "function" || typeof DecompressionStream !== "function") return new Missing("this browser is too old", "take one of 2023 or later");
    if (document.createElement("canvas").getContext("webgl2") === null) {
        return new Missing(
            "this browser draws nothing in three dimensions: WebGL 2 is switched off, or the graphics driver is blocked",
            "switch on hardware acceleration in the browser's settings and load the page anew, or take another browser; the command line needs none of it",
        );
    }
    return why;
}

/** Says why, and switches everything off. */
export function unable(why: unknown): void {
    const text = told(missing(why));
    element("unable").hidden = false;
    document.querySelector("#unable p")!.textContent = text;
    for (const control of document.querySelectorAll<HTMLInputElement>("button, select, input, fieldset")) control.disabled = true;
    element("canvas").hidden = true;
    for (const label of document.querySelectorAll(".button")) label.setAttribute("aria-disabled", "true");
    say(`The page cannot work here: ${text}`, true);
}
