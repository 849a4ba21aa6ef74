#!/usr/bin/env bash
# What has to agree before a release: files that are made of others are not old, the header's version is Cargo.toml's, the shared library has
# its SONAME, and its binary interface is the committed one. All that are tests of the C interface, and are run here.
#   packaging/check_interface.sh [TAG]    with the tag of the last release: programs made for that one run with this one as well
# Needs a C and a C++ compiler, make, binutils and abigail-tools.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
cd "$root"
last=${1-}
work=$out/interface
mkdir -p "$work"
stored=packaging/libfairmesh.so.$interface.abi
TESTS="generated exported_symbols_are_the_functions_of_the_header the_binary_interface_is_still_the_first_one"

for part in MAJOR=0 MINOR=1 PATCH=2; do
    IFS=. read -ra numbers <<<"$version"
    grep -qx "#define FAIRMESH_VERSION_${part%=*} ${numbers[${part#*=}]}" include/fairmesh.h || fail "include/fairmesh.h has another version"
done
[ -e "$stored" ] || fail "$stored is not there: FAIRMESH_WRITE_ABI=1 (CONTRIBUTING.md)"
need abidiff abigail-tools
if [ -n "$last" ]; then
    git rev-parse -q --verify "refs/tags/$last" >/dev/null || fail "there is no tag $last"
    if git show "$last:$stored" >"$work/last.abi" 2>/dev/null; then
        # Structs may grow at their ends; new functions are no change.
        python3 packaging/grown_structs.py "$work/last.abi" "$stored" >"$work/growth"
        abidiff --no-show-locs --no-added-syms --suppr "$work/growth" "$work/last.abi" "$stored" >&2 ||
            fail "programs made for $last do not run with $version: it needs another major version, or before 1.0 a minor one"
        echo "programs made for $last run with $version"
    else
        echo "$last had another SONAME"
    fi
fi
# shellcheck disable=SC2086
cargo test --release --locked -p fairmesh-capi --test capi -- $TESTS 2>&1 | tee "$work/log"
for name in $TESTS; do
    grep -qE "^test .*$name.* ok$" "$work/log" || fail "no test $name has passed"
done
