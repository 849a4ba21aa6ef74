#!/usr/bin/env bash
# Compiles everything with the oldest Rust that Cargo.toml promises (`rust-version`). Needs rustup.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
oldest=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
rustup toolchain install "$oldest" --profile minimal --no-self-update
# OpenMesh's bindings are for tests, and need its library.
CARGO_TARGET_DIR=$out/oldest cargo "+$oldest" check --locked --workspace --exclude openmesh-sys
