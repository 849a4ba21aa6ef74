#!/usr/bin/env bash
# Makes the npm package of the WebAssembly module that build.sh wasm32 has staged: target/packaging/dist/fairmesh-VERSION.tgz
#   packaging/npm.sh
# Needs node 18 or newer with npm. Two builds of one commit give the same bytes: npm packs with a time of its own.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
need npm "nodejs npm"
tree=$out/stage/wasm32/fairmesh-$version-wasm32
[ -e "$tree/lib/fairmesh.wasm" ] || fail "$tree/lib/fairmesh.wasm is not there: packaging/build.sh wasm32"
package=$out/npm/package
"$root/bindings/web/build.sh" "$tree/lib/fairmesh.wasm" "$package"
find "$package" -type f -exec chmod 644 {} +
mkdir -p "$dist"
npm pack --silent --pack-destination "$dist" "$package" >/dev/null
echo "$dist/fairmesh-$version.tgz"
