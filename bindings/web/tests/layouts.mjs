/** Prints a program in C that compiles only if all structs are laid out as abi.js says: node layouts.mjs dist/abi.js */

import { pathToFileURL } from "node:url";

const { structs } = await import(pathToFileURL(process.argv[2]));
/** `fillOptions`: `fill_options`. */
const snake = (name) => name.replace(/[A-Z]/g, (c) => `_${c.toLowerCase()}`);

console.log("#include <fairmesh.h>");
for (const [name, { size, align, fields }] of Object.entries(structs)) {
    const struct = `fairmesh_${snake(name)}`;
    const holds = (what) => console.log(`_Static_assert(${what}, "${struct}");`);
    holds(`sizeof(${struct}) == ${size}`);
    holds(`_Alignof(${struct}) == ${align}`);
    for (const [field, [at]] of Object.entries(fields)) holds(`offsetof(${struct}, ${snake(field)}) == ${at}`);
}
