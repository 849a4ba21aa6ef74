/** Sharp edges of a region, and what is said of blends in their place. */

import type { RoundResult } from "../../src/index.js";
import { saysOf } from "./parts.js";
import type { Surface } from "./surface.js";

/** Edges of a chosen region that bend by more than so many degrees are sharp. Half: the facets of a round pillar are; double: those of a wedge are not. */
const SHARP = 25;

/** Sharp edges between two triangles of a region: pairs of vertices, one after the other. */
export function sharpEdges(region: Uint8Array, surface: Surface): number[] {
    const { triangles } = surface;
    const beside = new Map<string, number>();
    const found: number[] = [];
    triangles.forEach((from, corner) => {
        const t = Math.floor(corner / 3);
        if (!region[t]) return;
        const to = triangles[corner % 3 === 2 ? corner - 2 : corner + 1]!;
        const other = beside.get(`${to} ${from}`);
        if (other === undefined) beside.set(`${from} ${to}`, t);
        else if (surface.normal(t).angleTo(surface.normal(other)) > (SHARP * Math.PI) / 180) found.push(from, to);
    });
    return found;
}

const times = (count: number, one: string, more: string) => `${count} ${count === 1 ? one : more}`;

/** What has become of the edges. */
export function saysOfBlends({ creases, sharpCorners, report, isSuccess }: RoundResult): string {
    const done = creases.filter(({ isRounded }) => isRounded);
    const sharp = creases.filter(({ isUnsolved }) => isUnsolved).length;
    const narrow = done.filter(({ part }) => part < 0.999);
    const told = [times(done.length, "edge rounded", "edges rounded")];
    if (narrow.length > 0) told.push(`${narrow.length} narrower, as there is less room: down to ${Math.round(100 * Math.min(...narrow.map(({ part }) => part)))} %`);
    if (sharp > 0) told.push(`${times(sharp, "stays", "stay")} sharp, as no sound blend was found: take less width`);
    if (sharpCorners.length > 0) told.push(`${times(sharpCorners.length, "corner stays", "corners stay")} sharp`);
    if (report.looseReason === "sharp_edge") told.push("edges that are not rounded end at blends: “Undo”, and choose more");
    else if (!isSuccess && sharp + sharpCorners.length === 0) told.push(saysOf(report));
    return told.join("; ");
}
