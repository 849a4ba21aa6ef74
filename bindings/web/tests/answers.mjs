/** Prints what packaging/answers.c prints: node answers.mjs 3. Without a number, writes all ten into the folder given: node answers.mjs FOLDER */

import { mkdirSync, writeFileSync } from "node:fs";
import { load } from "fairmesh";
import { input } from "./meshes.mjs";

const OPTIONS = {
    4: { innerFairness: "conformal" },
    5: { continuity: 1 },
    7: { discretization: "paper" },
};

/** Numbers in hexadecimal, three a line. */
function bits(values) {
    const view = new DataView(Float64Array.from(values).buffer);
    let text = "";
    for (let k = 0; k < values.length; k++) {
        text += view.getBigUint64(8 * k, true).toString(16).padStart(16, "0") + (k % 3 === 2 ? "\n" : " ");
    }
    return text;
}

function answer(library, which) {
    const { positions, triangles, free } = input(which);
    const options = OPTIONS[which] ?? {};
    if (which <= 7) {
        const given = which === 6 ? Float32Array.from(positions) : positions;
        const { outcome, report, positions: found } = library.fair({ positions: given, triangles }, free, options);
        return `${outcome}, ${report.iterations} iterations\n${bits(found)}`;
    }
    const filled = library.fillHoles({ positions, triangles }, which === 10 ? { join: "auto" } : {});
    return `${filled.newVertexCount} new vertices\n${bits(filled.positions)}`;
}

const library = await load();
const asked = process.argv[2] ?? "";
if (/^\d+$/.test(asked)) {
    process.stdout.write(answer(library, Number(asked)));
} else {
    mkdirSync(asked, { recursive: true });
    for (let which = 1; which <= 10; which++) writeFileSync(`${asked}/${which}`, answer(library, which));
}
