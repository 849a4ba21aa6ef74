/** The package in other hosts than node and browsers: here and in a worker. */

import { createWorker, load } from "fairmesh";
import { dent } from "./meshes.mjs";

const mesh = dent();
const library = await load();
const worker = await createWorker();
let told = 0;
const there = await worker.fair(mesh, mesh.free, { progress: () => told++ });
const here = library.fair(mesh, mesh.free, { progress: () => told++ });
if (!there.positions.every((x, k) => x === here.positions[k])) throw new Error("the worker finds something else");
const stop = new AbortController();
const large = dent(401, 10);
const why = await worker.fair(large, large.free, { signal: stop.signal, progress: () => stop.abort() }).catch(({ name }) => name);
console.log(there.outcome, told > 10, why);
worker.close();
