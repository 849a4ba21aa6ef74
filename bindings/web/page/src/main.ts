/** The page: puts its parts together. */

import { Dragging } from "./dragging.js";
import { FIRST, SHAPES, type ShapeName } from "./embedded.js";
import { costOfFile, costText, opened } from "./costs.js";
import { type Format, readMesh, save, written } from "./files.js";
import { fromText, maskOf, runsOf, type State, toText } from "./link.js";
import { Model } from "./model.js";
import type { Part } from "./parts.js";
import { choose, chosen, copied, element, input, label, onChoice, options, say, select, told } from "./page.js";
import { Pointer } from "./pointer.js";
import { gradient, scaleOf, type Shading } from "./shading.js";
import { Spot } from "./spot.js";
import { Story } from "./story.js";
import { Viewer } from "./viewer.js";
import { unable } from "./unable.js";
import { REMEDIES, TEXTS } from "./words.js";
import { isBusy, work } from "./work.js";

/** For tests, and for whoever wants to measure: what is seen, in numbers. */
interface Hook {
    positions(): Float64Array;
    triangles(): Uint32Array;
    region(): Uint8Array;
    choose(region: Uint8Array): void;
    /** Frames of the live surface since the page was loaded. */
    frames(): number;
    /** Whether something is under way, or about to be. */
    isBusy(): boolean;
    /** Tips of the arrows in the window. */
    arrows(): { loop: number; x: number; y: number }[];
    edits(): unknown[];
    /** What the page says that can be done, by the library's names. */
    remedies: Record<string, string>;
    /** What it says in place of the library's sentences. */
    texts: Record<string, string>;
    view(): number[];
}

class Page {
    readonly #model: Model;
    readonly #viewer: Viewer;
    readonly #dragging: Dragging;
    readonly #pointer: Pointer;
    readonly #story: Story;
    readonly #spot: Spot;
    #scale = 1;
    #isCurvatureShown = false;
    /** What the colours and the lists were made for. */
    #coloured: unknown = null;
    #listed: unknown = null;
    #told: unknown = null;
    #estimated: unknown = null;
    #estimating: ReturnType<typeof setTimeout> | undefined;
    #isWaking = false;
    #linking: ReturnType<typeof setTimeout> | undefined;

    constructor(model: Model, viewer: Viewer) {
        [this.#model, this.#viewer] = [model, viewer];
        viewer.changed = () => this.#remember();
        this.#dragging = new Dragging(model, this.#viewer, () => ({ meanCurvature: this.#isCurvatureShown }));
        this.#pointer = new Pointer(model, this.#viewer, this.#dragging);
        this.#spot = new Spot(model, this.#viewer, this.#dragging);
        this.#story = new Story(this.#dragging);
        this.#dragging.taken = () => this.#story.end(true);
        model.changed = () => this.#changed();
        this.#listen();
        (window as unknown as { fairmesh: Hook }).fairmesh = {
            positions: () => model.surface.positions,
            triangles: () => model.surface.triangles,
            region: () => model.region,
            choose: (region) => model.choose(region),
            frames: () => model.frames,
            isBusy: () => this.#isWaking || isBusy() || model.isFollowing || this.#dragging.isPending,
            arrows: () => this.#dragging.handles.places(),
            edits: () => model.live?.edits ?? [],
            remedies: REMEDIES,
            texts: TEXTS,
            view: () => this.#viewer.view,
        };
    }

    #listen(): void {
        const click = (id: string, then: () => unknown) => element(id).addEventListener("click", () => void then());
        document.querySelector<HTMLElement>("#legend i")!.style.background = gradient();
        options("shape", [...Object.entries(SHAPES), ["file", "Own file"]]);
        select("shape").addEventListener("change", () => void this.#take(select("shape").value));
        input("file").addEventListener("change", () => void this.#open(input("file").files?.[0]));
        this.#listenToDrops();
        click("undo", () => this.#undo());
        click("save", () => this.#save());
        click("link", () => this.#copyLink());
        click("grow", () => this.#spread("grow"));
        click("shrink", () => this.#spread("shrink"));
        click("all", () => this.#choose(1));
        click("clear", () => this.#choose(0));
        click("fair", () => this.#needing(() => work("Faired", (watched) => this.#model.fair(watched), () => this.#model.cost())));
        click("fill", () => work("Holes", (watched) => this.#model.fill(watched, null), () => this.#model.costToFill(null)));
        click("erase-fill", () => this.#needing(() => work("Region", (watched) => this.#model.refill(watched), () => this.#model.costToRefill())));
        click("remesh", () => this.#needing(() => work("Region", (watched) => this.#model.remesh(watched))));
        click("bridge", () => this.#join());
        click("round", () => this.#round());
        input("width").addEventListener("input", () => label("width", `${input("width").value} %`));
        input("width").addEventListener("change", () => this.#model.canRoundAgain && this.#round());
        label("width", `${input("width").value} %`);
        click("up", () => this.#turnUp(this.#viewer.up === "y" ? "z" : "y"));
        click("fit", () => this.#viewer.fit(this.#model.surface));
        onChoice("shading", () => void this.#shade());
        input("wires").addEventListener("change", () => void this.#shade());
        input("swipe").addEventListener("input", () => this.#swipe());
        input("brush").addEventListener("input", () => label("brush", `${input("brush").value} %`));
        label("brush", `${input("brush").value} %`);
        document.addEventListener("keydown", (event) => {
            if ((event.ctrlKey || event.metaKey) && event.key === "z") void this.#undo();
        });
        window.addEventListener("hashchange", () => void this.start());
    }

    #listenToDrops(): void {
        const body = document.body;
        body.addEventListener("dragover", (event) => (event.preventDefault(), body.classList.add("dropping")));
        body.addEventListener("dragleave", () => body.classList.remove("dropping"));
        body.addEventListener("drop", (event) => {
            event.preventDefault();
            body.classList.remove("dropping");
            void this.#open(event.dataTransfer?.files[0]);
        });
    }

    /** Begins with what the address says, or with the first shape. */
    async start(): Promise<void> {
        const text = location.hash.slice(1);
        if (text !== "" && text === this.#written) return;
        const state = text === "" ? null : await fromText(text);
        if (state === null) {
            await this.#welcome();
            if (text !== "") say("The link is damaged: here is the first shape.", true);
        } else await this.#resume(state);
    }

    /** The first shape, faired already, with an arrow that invites. */
    async #welcome(): Promise<void> {
        const { awake } = await this.#model.welcome();
        this.#begun(FIRST);
        say("Drag an arrow: the surface follows. Or choose another shape, or open a file of your own.");
        this.#isWaking = true;
        // Whoever has taken another shape meanwhile needs no story.
        void awake.then(() => this.#story.begin(), () => undefined).finally(() => (this.#isWaking = false));
    }

    async #resume(state: State): Promise<void> {
        const isKnown = state.shape in SHAPES;
        await this.#take(isKnown ? state.shape : FIRST);
        if (!isKnown) return say("The link names a shape that is not here: here is another one.", true);
        const count = () => this.#model.surface.triangles.length / 3;
        await work("Link", async (watched) => {
            await this.#model.replay(state.steps, watched);
            return "its surface is here";
        });
        if (this.#model.live === null) this.#model.choose(maskOf(state.region, count()));
        choose("shading", state.shading);
        input("wires").checked = state.wires;
        this.#viewer.look(state.view, this.#model.surface.geometry.boundingSphere!.radius);
        await this.#shade();
    }

    async #take(name: string): Promise<void> {
        if (name === "file") return input("file").click();
        try {
            await this.#model.take(name as ShapeName);
            this.#begun(name);
            const chosen = this.#model.region.some((x) => x === 1);
            const invites = name === "bracket" ? "press “Round edges”, and try other widths." : "paint a region, then fair it.";
            say(`${SHAPES[name as ShapeName]}: ${chosen ? "the coloured region is chosen. Fair it, or choose another one." : invites}`);
        } catch (why) {
            say(told(why), true);
        }
    }

    /** The button says what it would do. */
    #turnUp(axis: "y" | "z"): void {
        this.#viewer.up = axis;
        element("up").textContent = axis === "y" ? "z up" : "y up";
        this.#viewer.show(this.#model.surface, this.#model.before);
        this.#viewer.fit(this.#model.surface);
    }

    #begun(name: string, up: "y" | "z" = "y"): void {
        select("shape").value = name;
        input("swipe").value = "0";
        this.#swipe();
        this.#turnUp(up);
    }

    async #open(file: File | undefined): Promise<void> {
        input("file").value = "";
        if (file === undefined) {
            select("shape").value = this.#model.shape ?? "file";
            return;
        }
        const done = await work(file.name, async () => {
            const start = performance.now();
            const mesh = readMesh(file.name, await file.arrayBuffer());
            const loops = await this.#model.open(mesh);
            opened(mesh.triangles.length / 3, (performance.now() - start) / 1000);
            const boundaries = loops === 0 ? "closed" : `${loops} ${loops === 1 ? "boundary" : "boundaries"}`;
            return `${(mesh.triangles.length / 3).toLocaleString("en")} triangles, ${boundaries}. Paint a region, then fair it`;
        }, async () => costOfFile(file.name.toLowerCase(), file.size, await file.slice(0, 4096).text()));
        // Machines that print have z upwards.
        if (done) this.#begun("file", file.name.toLowerCase().endsWith(".stl") ? "z" : "y");
        else select("shape").value = this.#model.shape ?? "file";
    }

    async #undo(): Promise<void> {
        if (isBusy() || !this.#model.canUndo) return;
        await this.#model.undo();
        if (this.#model.live !== null) await this.#dragging.settle();
        else say("Undone.");
    }

    #save(): void {
        const format = select("format").value as Format;
        save(written(this.#model.mesh, format), `fairmesh.${format}`);
        say(`Saved as fairmesh.${format}.`);
    }

    async #copyLink(): Promise<void> {
        await this.#writeLink();
        if (this.#model.shape === null) return say("Your own file is not part of a link: save it, and hand it over.", true);
        say(`The link to what you see is in the ${(await copied(location.href)) ? "clipboard" : "address bar"}.`);
    }

    async #spread(kind: "grow" | "shrink"): Promise<void> {
        await this.#dragging.rest();
        if (isBusy()) return;
        try {
            await this.#model.spread(kind);
            say(`${this.#model.region.reduce((sum, x) => sum + x, 0).toLocaleString("en")} triangles are chosen.`);
        } catch (why) {
            say(told(why), true);
        }
    }

    async #choose(value: 0 | 1): Promise<void> {
        await this.#dragging.rest();
        if (isBusy()) return;
        this.#model.choose(new Uint8Array(this.#model.region.length).fill(value));
        say(value === 1 ? "All triangles are chosen." : "No triangle is chosen.");
    }

    #needing(then: () => Promise<unknown>): void {
        if (this.#model.region.some((x) => x === 1)) void then();
        else say("No region is chosen: paint one, draw a lasso around it, or take All.", true);
    }

    /** Where sharp edges have been rounded last, by another width in place of that. */
    #round(): Promise<boolean> {
        return work("Rounded", (watched) => this.#model.round(watched, Number(input("width").value) / 100));
    }

    async #join(): Promise<void> {
        const [start, end] = [Number(select("start").value), Number(select("end").value)];
        if (start === end) return say("The two holes are the same: choose another one to join it to.", true);
        await work("Joined", (watched) => this.#model.fill(watched, [start, end]), () => this.#model.costToFill([start, end]));
    }

    /** Shows the model as it is now. */
    #changed(): void {
        const { surface, before, canUndo } = this.#model;
        this.#viewer.show(surface, before);
        input("swipe").disabled = before === null;
        element<HTMLButtonElement>("undo").disabled = !canUndo;
        this.#swipe();
        this.#dragging.refresh();
        this.#pointer.mark();
        this.#tell();
        this.#estimate();
        if (this.#listed !== surface || this.#model.isFollowing) this.#spot.forget();
        if (this.#coloured !== surface) void this.#shade();
        if (this.#listed !== surface) void this.#list();
        this.#remember();
    }

    /** What fairing the region would cost, when the hand rests. */
    #estimate(): void {
        if (this.#estimated === this.#model.region) return;
        this.#estimated = this.#model.region;
        clearTimeout(this.#estimating);
        element("cost").hidden = true;
        this.#estimating = setTimeout(() => void this.#price(), 300);
    }

    async #price(): Promise<void> {
        const region = this.#model.region;
        if (isBusy() || !region.includes(1)) return;
        const cost = await this.#model.cost();
        if (this.#model.region !== region) return;
        element("cost").hidden = cost.vertices === 0;
        element("cost").textContent = `${cost.vertices.toLocaleString("en")} vertices move: ${costText(cost)}.`;
    }

    /** What has become of each part, where there are several: a click chooses one. */
    #tell(): void {
        const { parts } = this.#model;
        if (this.#told === parts) return;
        this.#told = parts;
        element("parts").hidden = parts.length < 2;
        element("parts").replaceChildren(...(parts.length < 2 ? [] : parts.map((part) => this.#line(part))));
    }

    #line({ name, says, isGood, triangles }: Part): HTMLElement {
        const [line, button] = [document.createElement("li"), document.createElement("button")];
        Object.assign(button, { type: "button", textContent: name, disabled: triangles === null, title: "Choose it as the region" });
        button.addEventListener("click", () => {
            if (isBusy() || triangles === null) return;
            this.#model.choose(triangles.slice());
            say(`${name} is the region: ${says}.`, !isGood);
        });
        line.append(button, ` ${isGood ? "fair and sound" : says}`);
        line.classList.toggle("bad", !isGood);
        return line;
    }

    /** The holes that can be joined. */
    async #list(): Promise<void> {
        const surface = (this.#listed = this.#model.surface);
        const loops = await this.#model.loops();
        if (this.#listed !== surface) return;
        element("joining").hidden = loops.length < 2;
        const entries = loops.map(({ vertexCount }, k) => [String(k), `${k + 1} (${vertexCount} edges)`] as const);
        for (const id of ["start", "end"]) options(id, entries);
        if (loops.length > 1) select("end").value = "1";
    }

    async #shade(): Promise<void> {
        const shading = chosen("shading") as Shading;
        const { surface, before } = this.#model;
        this.#isCurvatureShown = shading === "curvature";
        element("scene").classList.toggle("curved", this.#isCurvatureShown);
        element("legend").hidden = !this.#isCurvatureShown;
        if (this.#isCurvatureShown) {
            this.#coloured = surface;
            const values = await this.#model.meanCurvature(this.#model.mesh);
            surface.paint("curvature", values);
            this.#scale = scaleOf(values);
            if (before !== null) before.paint("curvature", await this.#model.meanCurvature({ positions: before.positions, triangles: before.triangles }));
        }
        this.#legend();
        this.#viewer.shade(shading, this.#scale, input("wires").checked);
        this.#remember();
    }

    /** The numbers of the scale. */
    #legend(): void {
        const short = (x: number) => String(Number(x.toPrecision(3))).replace("-", "−");
        document.querySelectorAll("#legend div span").forEach((tick, k) => (tick.textContent = short((k / 2 - 1) * this.#scale)));
        element("legend-radius").textContent = short(1 / this.#scale);
        element("legend-inverse").textContent = short(this.#scale);
    }

    #swipe(): void {
        const part = this.#model.before === null ? 0 : Number(input("swipe").value) / 100;
        this.#viewer.swipe(part);
        label("swipe", `${Math.round(100 * part)} %`);
        element("divider").hidden = part === 0;
        element("divider").style.left = `${100 * part}%`;
    }

    #written = "";

    /** Writes the state into the address, soon. */
    #remember(): void {
        clearTimeout(this.#linking);
        this.#linking = setTimeout(() => void this.#writeLink(), 300);
    }

    async #writeLink(): Promise<void> {
        const { shape, steps, region } = this.#model;
        clearTimeout(this.#linking);
        if (isBusy()) return this.#remember();
        const look = { view: this.#viewer.view, shading: chosen("shading") as Shading, wires: input("wires").checked };
        this.#written = shape === null ? "" : await toText({ shape, steps, region: runsOf(region), ...look });
        history.replaceState(null, "", `#${this.#written}`);
    }
}

try {
    const viewer = new Viewer(element("canvas"));
    await new Page(await Model.start(), viewer).start();
    document.documentElement.dataset["ready"] = "yes";
} catch (why) {
    unable(why);
}
