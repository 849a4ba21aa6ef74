/** One thing at a time that takes long: its progress, Stop, and what came of it. */

import type { Watched } from "../../src/index.js";
import { element, say, told } from "./page.js";

let stop: AbortController | null = null;

/** Whether something is under way. */
export const isBusy = (): boolean => stop !== null;

const bar = () => element<HTMLProgressElement>("progress");

/** Does it, says how it went, and lets Stop end it. False where it failed or was stopped. */
export async function work(what: string, run: (watched: Watched) => Promise<string>): Promise<boolean> {
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
        const result = await run({ signal: mine.signal, progress: ({ fraction }) => void (bar().value = fraction) });
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
