#!/usr/bin/env bash
# Runs all tests; installs Rust if it is not there (Debian, Ubuntu). Stops at the first failure.
set -euo pipefail
cd "$(dirname "$0")"

step() {
    printf '\n== %s\n' "$*"
    "$@"
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
step cargo --version
step cargo fmt --check
step cargo clippy --release --locked --all-targets -- -D warnings
step cargo clippy --release --locked --all-targets --no-default-features -- -D warnings
RUSTDOCFLAGS="-D warnings" step cargo doc --release --locked --no-deps --lib
step cargo build --release --locked --no-default-features
step cargo test --release --locked --no-default-features
step cargo build --release --locked
step check_demo
step cargo test --release --locked
printf '\nAll tests have passed.\n'
