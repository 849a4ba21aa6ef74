#!/usr/bin/env bash
# Fuzzes every function of the C interface: structured meshes and raw bytes, with AddressSanitizer and coverage.
#   fuzz/run.sh [seconds for each target, default 60] [structured|raw]     new inputs go to target/fuzz/
# FUZZ_SEED=0 draws another sequence every time; the default is one that can be repeated.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
if ! command -v clang >/dev/null || ! ls "$(clang -print-resource-dir)"/lib/linux/libclang_rt.fuzzer-*.a >/dev/null 2>&1; then
    . packaging/install.sh
    install_packages clang libclang-rt-14-dev
fi
out=target/fuzz
library=$(tests/address_library.sh)
mkdir -p $out
for target in ${2:-structured raw}; do
    clang -std=c11 -O1 -g -Wall -Wextra -Werror -fsanitize=fuzzer,address -Iinclude fuzz/$target.c \
        "$library" -lgcc_s -lutil -lrt -lpthread -lm -ldl -o $out/$target
    mkdir -p $out/corpus-$target
    $out/$target -max_total_time="$seconds" -timeout=60 -seed="${FUZZ_SEED:-1}" -rss_limit_mb=2048 -max_len=1024 -len_control=0 \
        -print_final_stats=1 -artifact_prefix=$out/ $out/corpus-$target fuzz/corpus/$target 2>&1 |
        grep -v "^#.*\(NEW\|REDUCE\|RELOAD\|pulse\|INITED\|READ\)\|NEW_FUNC\|# Uses" | tail -9
done
