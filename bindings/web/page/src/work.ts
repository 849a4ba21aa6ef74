/** One thing at a time that takes long: its progress, Stop, and what came of it. */

import type { Watched } from "../../src/index.js";
import { type Cost, costText, isLarge, took } from "./costs.js";
import { element, say, told } from "./page.js";

let stop: AbortController | null = null;

/** Whether something is under way. */
export const isBusy = (): boolean => stop !== null;

const bar = () => element<HTMLProgressElement>("progress");

/** Asks before it takes long: until Go on is pressed, or Stop. */
async function agreed(what: string, cost: Cost, signal: AbortSignal): Promise<void> {
    say(`${what}: this takes ${costText(cost)}. Go on?`);
    element("go").hidden = false;
    bar().hidden = true;
    try {
        await new Promise((done, failed) => {
            element("go").addEventListener("click", done, { once: true, signal });
            signal.addEventListener("abort", () => failed(signal.reason), { once: true });
        });
    } finally {
        element("go").hidden = true;
        bar().hidden = false;
    }
}

/** Does it, says how it went, and lets Stop end it; first tells what it costs if that is much. False where it failed or was stopped. */
export async function work(what: string, run: (watched: Watched) => Promise<string>, costs?: () => Promise<Cost>): Promise<boolean> {
    if (stop !== null) {
        say("Something else is still being done: wait, or stop it.", true);
        return false;
    }
    const mine = (stop = new AbortController());
    element("stop").hidden = bar().hidden = false;
    bar().value = 0;
    document.body.setAttribute("aria-busy", "true");
    say(`${what}…`);
    try {
        const cost = await costs?.();
        if (cost !== undefined && isLarge(cost)) await agreed(what, cost, mine.signal);
        mine.signal.throwIfAborted();
        say(`${what}…`);
        const start = performance.now();
        const result = await run({ signal: mine.signal, progress: ({ fraction }) => void (bar().value = fraction) });
        if (cost !== undefined) took(cost, (performance.now() - start) / 1000);
        say(`${what}: ${result}.`);
        return true;
    } catch (why) {
        if (mine.signal.aborted) say(`${what}: stopped, nothing has changed.`);
        else say(told(why), true);
        return false;
    } finally {
        stop = null;
        element("stop").hidden = bar().hidden = true;
        document.body.removeAttribute("aria-busy");
    }
}

element("stop").addEventListener("click", () => stop?.abort());
