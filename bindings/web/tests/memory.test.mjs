/** What a large job takes of the module's memory. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "fairmesh";

/** A bowl of rings of triangles of one shape, around a hole. */
function bowl(around, rings) {
    const grow = 1 + (0.87 * 2 * Math.PI) / around;
    const positions = new Float64Array(3 * around * (rings + 1));
    const triangles = new Uint32Array(6 * around * rings);
    for (let i = 0; i <= rings; i++) {
        const r = grow ** i;
        for (let j = 0; j < around; j++) {
            const turn = (2 * Math.PI * (j + 0.5 * (i % 2))) / around;
            positions.set([r * Math.cos(turn), r * Math.sin(turn), 0.1 * r * r], 3 * (around * i + j));
        }
    }
    for (let i = 0; i < rings; i++) {
        for (let j = 0; j < around; j++) {
            const [a, b] = [around * i + j, around * i + ((j + 1) % around)];
            const [c, d] = [a + around, b + around];
            triangles.set(i % 2 === 0 ? [a, b, c, b, d, c] : [a, d, c, a, b, d], 6 * (around * i + j));
        }
    }
    return { positions, triangles };
}

test("a hole of 987 edges in half a million triangles is filled within 1 GB", async () => {
    const mesh = bowl(987, 258);
    assert.ok(mesh.triangles.length / 3 > 508_000);
    const library = await load();
    const filled = library.fillHoles(mesh, { loops: [0] });
    assert.equal(filled.loops[0].outcome, "faired");
    assert.ok(filled.newVertexCount > 50_000, `${filled.newVertexCount}`);
    assert.ok(library.memoryBytes < 2 ** 30, `${library.memoryBytes}`);
});

test("the memory that is needed is told before, and holds", async () => {
    const mesh = bowl(300, 60);
    const library = await load();
    const free = Array.from({ length: 300 * 59 }, (_, k) => k + 300);
    const [fairing, filling] = [library.memoryNeeded(mesh, free), library.memoryNeededToFill(mesh, { loops: [0] })];
    assert.ok(fairing > 1e6 && filling > 1e6, `${fairing}, ${filling}`);
    assert.ok(library.memoryNeeded(mesh, free.slice(0, 3000)) < fairing / 3, "a smaller region needs less");
    const before = library.memoryBytes;
    library.fair(mesh, free);
    const grown = library.memoryBytes - before;
    // What the arguments take, and what is set aside, come on top.
    assert.ok(grown > 0.2 * fairing && grown < 2 * fairing + 2 ** 25, `${grown} of ${fairing}`);
    assert.throws(() => library.memoryNeeded(mesh, free, { speed: 3 }), /speed/);
});
