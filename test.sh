#!/usr/bin/env bash
# Runs all tests; installs Rust if it is not there (Debian, Ubuntu). Stops at the first failure.
set -euo pipefail
cd "$(dirname "$0")"

step() {
    local begin=$SECONDS
    printf '\n== %s\n' "$*"
    "$@"
    printf '== %s s\n' $((SECONDS - begin))
}

install_packages() {
    local as_root=""
    [ "$(id -u)" -eq 0 ] || as_root=sudo
    $as_root apt-get update -qq
    $as_root apt-get install -y -qq --no-install-recommends "$@"
}

install_rust() {
    command -v cc >/dev/null || install_packages build-essential
    [ -e "$HOME/.cargo/env" ] && . "$HOME/.cargo/env"
    if ! command -v cargo >/dev/null; then
        command -v curl >/dev/null || install_packages curl ca-certificates
        curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y --no-modify-path
        . "$HOME/.cargo/env"
    fi
    cargo fmt --version >/dev/null 2>&1 && cargo clippy --version >/dev/null 2>&1 ||
        rustup component add rustfmt clippy
}

# What the tests of the C interface need besides a compiler.
install_c_tools() {
    local missing=()
    command -v cmake >/dev/null || missing+=(cmake)
    command -v make >/dev/null || missing+=(make)
    command -v pkg-config >/dev/null || missing+=(pkg-config)
    command -v valgrind >/dev/null || missing+=(valgrind)
    command -v abidw >/dev/null || missing+=(abigail-tools)
    command -v c++ >/dev/null || missing+=(g++)
    # OpenMesh, and libclang for bindgen: for bindings/openmesh-sys only.
    pkg-config --exists openmesh 2>/dev/null || missing+=(libopenmesh-dev)
    compgen -G '/usr/lib/llvm-*/lib/libclang[.-][0-9s]*' >/dev/null &&
        compgen -G '/usr/lib/llvm-*/lib/clang/*/include/stddef.h' >/dev/null || missing+=(libclang-dev)
    [ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
}

# The one command that README.md promises, and what it has to leave behind.
check_demo() {
    local out
    out=$(mktemp -d)
    cargo run --release --locked --quiet -- demo "$out"
    [ "$(ls "$out" | sort | tr '\n' ' ')" = "blend.png result.ply start.ply " ]
    for file in start.ply result.ply blend.png; do
        [ -s "$out/$file" ]
    done
    head -c 3 "$out/result.ply" | grep -q '^ply'
    cargo run --release --locked --quiet -- fair docs/dented.ply -o "$out/sphere.ply" --selection free
    rm -r "$out"
}

install_rust
install_c_tools
step cargo --version
step cargo fmt --all --check
step cargo clippy --release --locked --workspace --all-targets -- -D warnings
step cargo clippy --release --locked -p fairmesh-capi --all-targets --features hooks -- -D warnings
RUSTDOCFLAGS="-D warnings" step cargo doc --release --locked --no-deps --lib
step cargo build --release --locked
step check_demo
# With bindings/openmesh-sys, in one build.
step cargo test --release --locked --workspace
step bindings/python/test.sh
step bindings/blender/test.sh
step tests/sanitize.sh
step meshlab_plugin/test.sh gui
step fuzz/run.sh 60
printf '\nAll tests have passed.\n'
