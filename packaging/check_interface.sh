#!/usr/bin/env bash
# What has to agree before a release: files that are made of others are not old, the header's version is Cargo.toml's, the shared library has
# the SONAME of the major version, and its binary interface is the committed one. All that are tests of the C interface, and are run here.
#   packaging/check_interface.sh [TAG]    with the tag of the last release: programs made for that one run with this one as well
# Needs a C and a C++ compiler, make, binutils and abigail-tools.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
last=${1-}
work=$out/interface
mkdir -p "$work"
stored=packaging/libfairmesh.so.$major.abi
TESTS="generated exported_symbols_are_the_functions_of_the_header the_binary_interface_is_still_the_first_one"

for part in MAJOR=0 MINOR=1 PATCH=2; do
    IFS=. read -ra numbers <<<"$version"
    grep -qx "#define FAIRMESH_VERSION_${part%=*} ${numbers[${part#*=}]}" include/fairmesh.h || fail "include/fairmesh.h has another version"
done
[ -e "$stored" ] || fail "$stored is not there: FAIRMESH_WRITE_ABI=1 (CONTRIBUTING.md)"
need abidiff abigail-tools
# shellcheck disable=SC2086
cargo test --release --locked -p fairmesh-capi --test capi -- $TESTS 2>&1 | tee "$work/log"
for name in $TESTS; do
    grep -qE "^test .*$name.* ok$" "$work/log" || fail "there is no test $name any more"
done
if [ -n "$last" ] && git show "$last:$stored" >"$work/last.abi" 2>/dev/null; then
    # 8 of its exit code: changes that break programs. Structs that grow at their ends are none.
    code=0
    abidiff --no-show-locs --no-added-syms "$work/last.abi" "$stored" >"$work/abidiff.log" || code=$?
    if [ $((code & 11)) -ne 0 ]; then
        cat "$work/abidiff.log" >&2
        fail "programs made for $last do not run with $version: it needs another major version"
    fi
    echo "programs made for $last run with $version"
fi
