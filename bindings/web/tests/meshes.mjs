/** Meshes for the tests: those of packaging/answers.c, number for number. */

/** Numbers between -1 and 1, always the same. */
function noises(seed) {
    let state = seed >>> 0;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return (state >>> 8) / 8388608 - 1;
    };
}

function place(s, u, v, dented, noise) {
    const q = u * u + v * v;
    const z = dented ? s.dent * (1 + 0.3 * noise()) : 0;
    const p =
        s.shape === 0
            ? [(2 * u) / (1 + q), (2 * v) / (1 + q), (1 - q) / (1 + q) - z]
            : [u, v, (s.shape === 1 ? 0.4 * (u * u - v * v) + 0.1 * u * v * v : 0.3 * q + 0.1 * q * q) - z];
    if (s.turned) p[2] = -p[2];
    p[2] += s.height;
    return p;
}

/** Adds a square sheet to a mesh, free where it is not in the frame; with `hole`, without the triangles there. */
function addSheet(mesh, s, hole, noise) {
    const { side: n, frame } = s;
    const base = mesh.free.length;
    const step = (2 * s.reach) / (n - 1);
    for (let j = 0; j < n; j++) {
        for (let i = 0; i < n; i++) {
            const outer = i === 0 || j === 0 || i === n - 1 || j === n - 1;
            const inner = i >= frame && j >= frame && i + frame < n && j + frame < n;
            let u = step * i - s.reach;
            let v = step * j - s.reach;
            if (!outer) {
                u += s.shaken * step * noise();
                v += s.shaken * step * noise();
            }
            mesh.free.push(inner && !hole ? 1 : 0);
            mesh.positions.push(...place(s, u, v, inner && !hole, noise));
        }
    }
    for (let j = 0; j + 1 < n; j++) {
        for (let i = 0; i + 1 < n; i++) {
            if (hole && i >= frame && j >= frame && i + 1 + frame < n && j + 1 + frame < n) continue;
            const a = base + n * j + i;
            const [b, c, d] = [a + 1, a + 1 + n, a + n];
            mesh.triangles.push(...(s.turned ? [a, c, b, a, d, c] : [a, b, c, a, c, d]));
        }
    }
}

/** One or several sheets, as typed arrays. */
export function sheets(all, { hole = false, seed = 1 } = {}) {
    const mesh = { positions: [], triangles: [], free: [] };
    const noise = noises(seed);
    for (const given of all) {
        addSheet(mesh, { reach: 0.4, shaken: 0, dent: 0, shape: 0, turned: false, side: 25, frame: 6, height: 0, ...given }, hole, noise);
    }
    return {
        positions: Float64Array.from(mesh.positions),
        triangles: Uint32Array.from(mesh.triangles),
        free: Uint8Array.from(mesh.free),
    };
}

/** A part of the unit sphere with a dent. */
export const dent = (side = 25, frame = 6) => sheets([{ side, frame, dent: 0.1 }]);

/** The ten inputs of packaging/answers.c. */
export function input(which) {
    const rows = [
        [0.4, 0.0, 0.1, 0, 0, 25, 6, 0],
        [0.4, 0.2, 0.1, 0, 0, 151, 10, 0],
        [0.5, 0.3, 0.1, 0, 0, 41, 6, 0],
        [1.0, 0.2, 0.2, 1, 0, 33, 6, 0],
        [0.6, 0.1, 0.1, 2, 0, 37, 10, 0],
        [0.4, 0.1, 0.05, 0, 0, 33, 7, 1000],
        [0.4, 0.1, 0.05, 0, 0, 21, 5, 0],
        [0.5, 0.0, 0.0, 0, 0, 25, 9, 0],
        [1.0, 0.3, 0.0, 1, 0, 33, 11, 0],
        [0.3, 0.05, 0.0, 0, 0, 21, 8, -0.2],
    ];
    const [reach, shaken, dented, shape, turned, side, frame, height] = rows[which - 1];
    const first = { reach, shaken, dent: dented, shape, turned: turned === 1, side, frame, height };
    const all = which === 10 ? [first, { ...first, turned: true, height: 0.2 - 0.5 }] : [first];
    return sheets(all, { hole: which > 7, seed: which });
}

/** How far the farthest vertex is from the unit sphere. */
export function offSphere(positions) {
    let most = 0;
    for (let k = 0; k < positions.length; k += 3) most = Math.max(most, Math.abs(Math.hypot(...positions.subarray(k, k + 3)) - 1));
    return most;
}

/** Two tubes of radius 1 about the z axis with a gap between them, open at all ends; chains run around. */
export function tubes({ around = 32, rings = 8, gap = 1 } = {}) {
    const positions = [];
    const triangles = [];
    const step = (2 * Math.PI) / around;
    for (const bottom of [gap / 2, -gap / 2 - (rings - 1) * step]) {
        const base = positions.length / 3;
        for (let j = 0; j < rings; j++) {
            for (let i = 0; i < around; i++) positions.push(Math.cos(i * step), Math.sin(i * step), bottom + j * step);
        }
        for (let j = 0; j + 1 < rings; j++) {
            for (let i = 0; i < around; i++) {
                const [a, b] = [base + around * j + i, base + around * j + ((i + 1) % around)];
                triangles.push(a, b, b + around, a, b + around, a + around);
            }
        }
    }
    return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** The cube from -1 to 1, each face in n x n squares. Vertices on its edges are there for each face. */
export function cube(n) {
    const positions = [];
    const triangles = [];
    for (let axis = 0; axis < 3; axis++) {
        for (const side of [-1, 1]) {
            const base = positions.length / 3;
            for (let j = 0; j <= n; j++) {
                for (let i = 0; i <= n; i++) {
                    const p = [];
                    p[axis] = side;
                    p[(axis + 1) % 3] = (2 * i) / n - 1;
                    p[(axis + 2) % 3] = (2 * j) / n - 1;
                    positions.push(...p);
                    if (i === n || j === n) continue;
                    const [a, b] = [base + (n + 1) * j + i, base + (n + 1) * (j + 1) + i];
                    triangles.push(...(side > 0 ? [a, a + 1, b + 1, a, b + 1, b] : [a, b + 1, a + 1, a, b, b + 1]));
                }
            }
        }
    }
    return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}
