#!/usr/bin/env bash
# Tests the npm package: builds the WebAssembly module, makes the package, and runs its tests with node, in target/web; then the page
# of live fairing, which is target/web/live.html afterwards, in Chromium.
# Installs what it needs (Debian, Ubuntu).
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd ../.. && pwd)
mkdir -p "${CARGO_TARGET_DIR:-$root/target}/web"
target=$(cd "${CARGO_TARGET_DIR:-$root/target}" && pwd)

. "$root/packaging/install.sh"

missing=()
command -v node >/dev/null || missing+=(nodejs)
command -v npm >/dev/null || missing+=(npm)
command -v chromium >/dev/null || missing+=(chromium)
python3 -m pip --version >/dev/null 2>&1 || missing+=(python3-pip)
[ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
triple=wasm32-unknown-unknown
rustup target list --installed | grep -qx $triple || rustup target add $triple

# As packaging/build.sh does.
(cd "$root" && RUSTFLAGS="-C target-feature=+simd128 -C link-arg=--strip-all -C llvm-args=-inline-threshold=50" cargo build --release --locked --quiet --target $triple -p fairmesh-capi \
    --config 'profile.release.lto="fat"')
run=$target/web/run
rm -rf "$run"
mkdir -p "$run/node_modules/fairmesh"
./build.sh "$target/$triple/release/fairmesh.wasm" "$run/node_modules/fairmesh"
./run_tests.sh "$run"
page/test.sh "$run/node_modules/fairmesh"
