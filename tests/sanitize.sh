#!/usr/bin/env bash
# The C test programs under AddressSanitizer and UndefinedBehaviorSanitizer (C side), and under ThreadSanitizer.
#   tests/sanitize.sh [address|thread]      default: both
set -euo pipefail
cd "$(dirname "$0")/.."
host=$(rustc -vV | sed -n 's/^host: //p')
libs="-lgcc_s -lutil -lrt -lpthread -lm -ldl"
strict="-std=c11 -Wall -Wextra -pedantic -Werror -O1 -g -Iinclude"

address() {
    local library out=target/asan
    library=$(tests/address_library.sh)
    for program in calls bad_inputs threads memory; do
        cc $strict -fsanitize=address,undefined -fno-sanitize-recover=all tests/c/$program.c "$library" $libs -o $out/$program
        # Allocations that are too large are an answer, not an error.
        ASAN_OPTIONS=allocator_may_return_null=1:detect_leaks=1 $out/$program
    done
    c++ -std=c++17 -Wall -Wextra -pedantic -Werror -O1 -g -Iinclude -fsanitize=address,undefined \
        -fno-sanitize-recover=all tests/cpp/wrapper.cpp "$library" $libs -o $out/wrapper
    $out/wrapper
}

thread() {
    # With the standard library: without its source, its locks and channels are not seen, and races found that are none.
    rustup component add rust-src
    RUSTC_BOOTSTRAP=1 RUSTFLAGS="-Zsanitizer=thread -Cunsafe-allow-abi-mismatch=sanitizer" \
        cargo rustc -Zbuild-std --release --locked --quiet -p fairmesh-capi --features hooks \
        --crate-type staticlib --target "$host" --target-dir target/tsan
    local out=target/tsan runtime
    runtime=$(ls "$(rustc --print sysroot)/lib/rustlib/$host/lib/"librustc-*_rt.tsan.a)
    # As compilers define it that instrument C, too.
    cc $strict -D__SANITIZE_THREAD__ -c tests/c/threads.c -o $out/threads.o
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
