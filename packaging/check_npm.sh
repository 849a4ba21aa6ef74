#!/usr/bin/env bash
# Checks the npm package that npm.sh has made, from the archive alone: its size and entries, its tests in node, as Chromium, Firefox,
# Node 18, Deno, Bun and two bundlers see it, the places of all fields as a C compiler has them, and that its ten answers are those of the other targets.
#   packaging/check_npm.sh
set -euo pipefail
. "$(dirname "$0")/tools.sh"
# Those of its dependencies are what npm finds: they judge the package, and do not get into it.
TOOLS="publint@0.3.25 @arethetypeswrong/cli@0.18.5 puppeteer-core@24.8.2 vite@8.3.8 webpack@5.112.2 webpack-cli@7.3.1 deno@2.9.6 bun@1.4.5 node@18.20.8"
GZIPPED=$((1500 * 1000))
archive=$dist/fairmesh-$version.tgz
work=$out/check/npm
tools=$out/npm/tools

say() { echo "npm: $*"; }

need node nodejs
need npm npm
need chromium chromium
need firefox-esr firefox-esr
[ -e "$archive" ] || fail "$archive is not there: packaging/npm.sh"
if [ "$(cat "$tools/installed" 2>/dev/null)" != "$TOOLS" ]; then
    rm -rf "$tools"
    mkdir -p "$tools"
    echo '{ "private": true }' >"$tools/package.json"
    # shellcheck disable=SC2086
    npm --prefix "$tools" install --silent --no-audit --no-fund $TOOLS
    echo "$TOOLS" >"$tools/installed"
fi
bin=$tools/node_modules/.bin

rm -rf "$work"
mkdir -p "$work"
echo '{ "private": true, "type": "module" }' >"$work/package.json"
npm --prefix "$work" install --silent --no-audit --no-fund --offline "$archive"
package=$work/node_modules/fairmesh

size=$(gzip -9c "$package/dist/fairmesh.wasm" | wc -c)
[ "$size" -le $GZIPPED ] || fail "fairmesh.wasm has $size bytes gzipped, more than $GZIPPED"
say "fairmesh.wasm: $size bytes gzipped, the archive: $(wc -c <"$archive")"
if grep -raqF -e "$root" -e "$HOME/" "$package"; then fail "a path of this machine is in the package"; fi
[ "$(node -p "require('$package/package.json').version")" = "$version" ] || fail "the package is of another version"
again=$(mktemp -d)
cp "$archive" "$again/first.tgz"
"$root/packaging/npm.sh" >/dev/null
cmp "$archive" "$again/first.tgz" || fail "the package has other bytes when it is made again"
rm -r "$again"
say "the same bytes twice"

# Paths of exports, and types, as the several ways to resolve them see them. There is no CommonJS.
"$bin/publint" --strict "$archive"
"$bin/attw" --profile esm-only --exclude-entrypoints fairmesh.wasm -- "$archive"

install_zig
node "$root/bindings/web/tests/layouts.mjs" "$package/dist/abi.js" >"$work/layouts.c"
zig cc -target wasm32-wasi -std=c11 -c "-I$root/include" "$work/layouts.c" -o "$work/layouts.o"
say "$(grep -c offsetof "$work/layouts.c") fields are where the C compiler has them"

"$root/bindings/web/run_tests.sh" "$work" >"$work/tests.log" || { cat "$work/tests.log"; exit 1; }
say "tests: $(grep -E '^(# pass|ℹ pass)' "$work/tests.log")"

cd "$work"
node answers.mjs "$work/answers"
for other in "$out/answers"/*/; do
    [ -e "${other}1" ] || continue
    python3 "$root/packaging/compare.py" "${other%/}" "$work/answers" || fail "the answers have to be the same"
done
for k in 1 2 3 4 5 6 7 8 9 10; do say "$k $(sha256sum <"$work/answers/$k" | cut -d' ' -f1) $(head -1 "$work/answers/$k")"; done

program=$out/stage/linux-x86_64/fairmesh-cli-$version-linux-x86_64/fairmesh
[ ! -x "$program" ] || node speed.mjs "$program"

# The oldest Node that package.json promises.
"$tools/node_modules/node/bin/node" --test calls.test.mjs runs.test.mjs worker.test.mjs >old.log || { cat old.log; exit 1; }
say "$("$tools/node_modules/node/bin/node" --version): $(grep '^# pass' old.log)"
deno="$bin/deno run --allow-read --node-modules-dir=manual"
for host in "$deno" "$bin/bun"; do
    # shellcheck disable=SC2086
    $host readme.mjs | diff readme.log -
    # shellcheck disable=SC2086
    [ "$($host host.mjs)" = "converged true AbortError" ] || fail "$host has not faired a mesh in a worker"
done
say "Deno and Bun have faired meshes, here and in a worker"

mkdir -p bundled
cp bundled.html bundled/index.html
"$bin/vite" build --logLevel warn --base ./ --outDir ../bundle --emptyOutDir bundled
sed -n '/import/,/^<.script>/p' bundled.html | sed '$d' >bundled/main.mjs
"$bin/webpack" --mode production --entry ./bundled/main.mjs -o webpack >webpack.log || { cat webpack.log; exit 1; }
echo '<!doctype html><title>bundled</title><script defer src="main.js"></script>' >webpack/index.html
ln -sfn "$tools/node_modules/puppeteer-core" node_modules/puppeteer-core
for browser in chrome firefox; do node browser.mjs $browser; done
say "passed"
