#!/usr/bin/env bash
# Builds a target once more, from a clone in another folder, and compares the bytes of its archives with those in target/packaging/dist:
#   packaging/check_again.sh [TARGET]      linux-x86_64 by default
set -euo pipefail
. "$(dirname "$0")/tools.sh"
target=${1:-linux-x86_64}
again=$out/again
grep -q " $(git -C "$root" rev-parse HEAD)," "$dist/MANIFEST" || fail "MANIFEST is of another commit: packaging/manifest.sh"
rm -rf "$again"
git clone -q "$root" "$again"
CARGO_TARGET_DIR=$again/target "$again/packaging/build.sh" "$target" >"$out/again.log" 2>&1 || fail "$(tail -40 "$out/again.log")"
for file in "$again"/target/packaging/dist/*; do
    cmp "$file" "$dist/${file##*/}" || fail "${file##*/} has other bytes when it is made again"
done
echo "$target: the same bytes of $(find "$again/target/packaging/dist" -type f | wc -l) files, twice"
rm -rf "$again"
