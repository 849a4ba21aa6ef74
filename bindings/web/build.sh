#!/usr/bin/env bash
# Makes the npm package, as a folder, of a module that is built already: build.sh fairmesh.wasm FOLDER
# Needs node 18 or newer with npm; the compiler of TypeScript is taken from npm, as package-lock.json has it, into target/web.
set -euo pipefail
module=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
cd "$(dirname "$0")"
root=$(cd ../.. && pwd)
for tool in node npm; do
    command -v $tool >/dev/null || { echo "$tool was not found: apt-get install nodejs npm" >&2; exit 1; }
done
mkdir -p "${CARGO_TARGET_DIR:-$root/target}/web/tools"
tools=$(cd "${CARGO_TARGET_DIR:-$root/target}/web/tools" && pwd)
if ! cmp -s package-lock.json "$tools/installed"; then
    cp package.json package-lock.json "$tools"
    npm --prefix "$tools" ci --silent --no-audit --no-fund
    cp package-lock.json "$tools/installed"
fi

rm -rf "${folder:?}"/*
"$root/bindings/declarations.sh" web
"$tools/node_modules/.bin/tsc" -p . --outDir "$folder/dist"
cp "$module" "$folder/dist/fairmesh.wasm"
cp README.md "$root/LICENSE-MIT" "$root/LICENSE-APACHE" "$folder"
python3 "$root/packaging/third_party.py" fairmesh-capi wasm32-unknown-unknown >"$folder/THIRD-PARTY.txt"
# Version and address are those of the library. npm compares the address with where a package comes from.
stated() { sed -n "s/^$1 = \"\(.*\)\"/\1/p" "$root/Cargo.toml" | head -1; }
node -e '
    const { readFileSync, writeFileSync } = require("node:fs");
    const { name, devDependencies, ...rest } = JSON.parse(readFileSync("package.json", "utf8"));
    const [path, version, address] = process.argv.slice(1);
    const repository = { type: "git", url: `git+${address}.git` };
    const links = { homepage: address, bugs: `${address}/issues` };
    writeFileSync(path, JSON.stringify({ name, version, ...rest, ...links, repository }, null, 4) + "\n");
' "$folder/package.json" "$(stated version)" "$(stated repository)"
