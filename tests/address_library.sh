#!/usr/bin/env bash
# Builds the static library under AddressSanitizer, with the coverage that fuzzers need, and prints its path. The stable
# compiler's sanitizers are unlocked by RUSTC_BOOTSTRAP; the libraries that are installed are not built so. It has the
# hooks of the tests, which do nothing unless they are called: one library for tests and fuzzing.
set -euo pipefail
cd "$(dirname "$0")/.."
host=$(rustc -vV | sed -n 's/^host: //p')
export RUSTC_BOOTSTRAP=1
export RUSTFLAGS="-Zsanitizer=address -Cforce-frame-pointers=yes -Cpasses=sancov-module \
-Cllvm-args=-sanitizer-coverage-level=4 -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
-Cllvm-args=-sanitizer-coverage-pc-table"
cargo rustc --release --locked --quiet -p fairmesh-capi --features hooks --crate-type staticlib \
    --target "$host" --target-dir target/asan >&2
echo "target/asan/$host/release/libfairmesh.a"
