#!/usr/bin/env bash
# The C test programs under AddressSanitizer and UndefinedBehaviorSanitizer (C side), and under ThreadSanitizer. The stable
# compiler's sanitizers are unlocked by RUSTC_BOOTSTRAP; the libraries that are installed are not built so.
#   tests/sanitize.sh [address|thread]      default: both
set -euo pipefail
cd "$(dirname "$0")/.."
host=$(rustc -vV | sed -n 's/^host: //p')
export RUSTC_BOOTSTRAP=1
libs="-lgcc_s -lutil -lrt -lpthread -lm -ldl"
strict="-std=c11 -Wall -Wextra -pedantic -Werror -O1 -g -Iinclude"

# build <directory> <flags of rustc> [flags of cargo]: the static library with test hooks.
build() {
    RUSTFLAGS="$2" cargo rustc ${3:-} --release --locked --quiet --lib --no-default-features --features capi-hooks \
        --crate-type staticlib --target "$host" --target-dir "target/$1"
}

address() {
    build asan "-Zsanitizer=address -Cforce-frame-pointers=yes"
    local out=target/asan
    for program in calls bad_inputs threads memory; do
        cc $strict -fsanitize=address,undefined -fno-sanitize-recover=all tests/c/$program.c \
            $out/$host/release/libfairmesh.a $libs -o $out/$program
        # Allocations that are too large are an answer, not an error.
        ASAN_OPTIONS=allocator_may_return_null=1:detect_leaks=1 $out/$program
    done
    c++ -std=c++17 -Wall -Wextra -pedantic -Werror -O1 -g -Iinclude -fsanitize=address,undefined \
        -fno-sanitize-recover=all tests/cpp/wrapper.cpp $out/$host/release/libfairmesh.a $libs -o $out/wrapper
    $out/wrapper
}

thread() {
    # With the standard library: without its source, its locks and channels are not seen, and races found that are none.
    rustup component add rust-src
    build tsan "-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer" -Zbuild-std
    local out=target/tsan runtime
    runtime=$(ls "$(rustc --print sysroot)/lib/rustlib/$host/lib/"librustc-*_rt.tsan.a)
    cc $strict -c tests/c/threads.c -o $out/threads.o
    cc $out/threads.o $out/$host/release/libfairmesh.a -Wl,--whole-archive "$runtime" -Wl,--no-whole-archive \
        -lstdc++ $libs -o $out/threads
    TSAN_OPTIONS=halt_on_error=1 $out/threads
}

case "${1:-both}" in
address) address ;;
thread) thread ;;
both)
    address
    thread
    ;;
esac
