/**
 * How long a fairing takes, beside the native program on one thread: node speed.mjs PROGRAM. By turns, and the shortest of
 * each: other programs on the machine slow both down. Of the program the time of the fairing alone is taken, as it tells it.
 */

import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { load } from "fairmesh";
import { dent } from "./meshes.mjs";

const mesh = dent(131, 8);
const library = await load();
const rows = (values) => Array.from({ length: values.length / 3 }, (_, k) => Array.from(values.subarray(3 * k, 3 * k + 3)));
const lines = [...rows(mesh.positions).map((p) => `v ${p.join(" ")}`), ...rows(mesh.triangles).map((t) => `f ${t.map((v) => v + 1).join(" ")}`)];
writeFileSync("speed.obj", `${lines.join("\n")}\n`);
const free = Array.from(mesh.free.keys()).filter((v) => mesh.free[v]);
writeFileSync("speed.txt", `${free.join("\n")}\n`);
const OPTIONS = ["fair", "speed.obj", "--free", "speed.txt", "--threads", "1", "--json", "-", "-o", "speed_out.obj"];

let [here, native] = [Infinity, Infinity];
for (let k = 0; k < 12; k++) {
    const begin = performance.now();
    if (!library.fair(mesh, mesh.free).report.isSuccess) throw new Error("it has to converge");
    here = Math.min(here, (performance.now() - begin) / 1000);
    native = Math.min(native, JSON.parse(execFileSync(process.argv[2], OPTIONS, { encoding: "utf8" })).seconds.solve);
}
const times = here / native;
console.log(`npm: ${free.length} free vertices in ${here.toFixed(3)} s, natively on one thread in ${native.toFixed(3)} s: ${times.toFixed(1)} times as long`);
if (!(times < 3)) throw new Error("more than three times as long as the native program");
