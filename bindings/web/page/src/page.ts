/** The controls of the page, by their ids, and what it says. */

import { worded } from "./words.js";

/** An element that the page has. */
export function element<T extends HTMLElement>(id: string): T {
    return document.getElementById(id) as T;
}

export const input = (id: string): HTMLInputElement => element(id);
export const select = (id: string): HTMLSelectElement => element(id);

/** Says what has happened; `isBad` where something has to be done about it. */
export function say(text: string, isBad = false): void {
    const status = element("status");
    status.textContent = text;
    status.classList.toggle("bad", isBad);
}

/** An error with what can be done about it, as one text. */
export function told(why: unknown): string {
    const { message, remedy, status } = why as { message?: string; remedy?: string; status?: string };
    const sentence = (text: string) => text.charAt(0).toUpperCase() + text.slice(1).replace(/\.$/, "") + ".";
    if (status !== undefined) return sentence(worded(status, message!.split(";")[0]!));
    return sentence(message ?? String(why)) + (remedy ? ` ${sentence(remedy)}` : "");
}

/** Whether a text is in the clipboard now. Pages that are files may have no other way than a field that is copied from. */
export async function copied(text: string): Promise<boolean> {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        const field = document.body.appendChild(document.createElement("textarea"));
        const focused = document.activeElement as HTMLElement | null;
        field.value = text;
        field.select();
        const isDone = document.execCommand("copy");
        field.remove();
        focused?.focus();
        return isDone;
    }
}

/** A text that stands for the value of a slider, for the eye and for a screen reader. */
export function label(id: string, text: string): void {
    input(id).setAttribute("aria-valuetext", text);
    document.querySelector(`output[for="${id}"]`)!.textContent = text;
}

/** Which of the radio buttons of a name is chosen. */
export function chosen(name: string): string {
    return document.querySelector<HTMLInputElement>(`input[name="${name}"]:checked`)!.value;
}

export function choose(name: string, value: string): void {
    document.querySelector<HTMLInputElement>(`input[name="${name}"][value="${value}"]`)!.checked = true;
}

export function onChoice(name: string, then: (value: string) => void): void {
    for (const button of document.querySelectorAll<HTMLInputElement>(`input[name="${name}"]`)) button.addEventListener("change", () => then(button.value));
}

/** Fills a list to choose from. */
export function options(id: string, entries: readonly (readonly [value: string, text: string])[]): void {
    select(id).replaceChildren(...entries.map(([value, text]) => new Option(text, value)));
}
