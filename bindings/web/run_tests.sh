#!/usr/bin/env bash
# Tests the package that is installed in a folder's node_modules: run_tests.sh FOLDER
# The program of its README, its types as TypeScript sees them, and all calls.
set -euo pipefail
folder=$(realpath "$1")
cd "$(dirname "$0")"
tools=$(cd "${CARGO_TARGET_DIR:-../../target}/web/tools" && pwd)
[ -e "$folder/node_modules/fairmesh/package.json" ] || { echo "$folder has no package fairmesh" >&2; exit 1; }
cp tests/* ../../tests/answers.json "$folder"
ln -sfn "$tools/node_modules/@types" "$folder/node_modules/@types"
cd "$folder"
# In pages, and where only Node is known.
for lib in ES2022,DOM,DOM.Iterable ES2022; do
    types=()
    [ $lib != ES2022 ] || types=(--types node)
    "$tools/node_modules/.bin/tsc" --noEmit --strict --exactOptionalPropertyTypes --target ES2022 --module nodenext --lib $lib "${types[@]}" types.mts
done
# The README's programs, one after the other: they are one module.
# shellcheck disable=SC2016
sed -n '/^```js$/,/^```$/p' node_modules/fairmesh/README.md | grep -v '^```' >readme.mjs
node readme.mjs >readme.log
# shellcheck disable=SC2016
sed -n '/^```text$/,/^```$/p' node_modules/fairmesh/README.md | grep -v '^```' | diff - readme.log
node --test answers.test.mjs calls.test.mjs live.test.mjs runs.test.mjs worker.test.mjs
