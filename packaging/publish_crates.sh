#!/usr/bin/env bash
# Hands the crates to a registry, each after those that it needs, but for those that are there: packaging/publish_crates.sh [--dry-run]
# Needs CARGO_REGISTRY_TOKEN. FAIRMESH_CRATES_INDEX is the address of a sparse index, by default crates.io's; another one is a registry `stand-in` of
# cargo's configuration. Crates were compiled when they were packed (crates.sh).
set -euo pipefail
. "$(dirname "$0")/tools.sh"
need curl curl
index=${FAIRMESH_CRATES_INDEX:-https://index.crates.io}
to=()
[ -z "${FAIRMESH_CRATES_INDEX-}" ] || to=(--registry stand-in)
cd "$root"

# Whether a crate is there in this version: a line for each version, in a file that is found by the first letters of the name.
is_there() {
    local name=$1 answer
    answer=$(curl -sS --retry 3 -w '\n%{http_code}' "$index/${name:0:2}/${name:2:2}/$name")
    case ${answer##*$'\n'} in
    200) grep -q "\"vers\":\"$version\"" <<<"$answer" ;;
    404 | 410 | 451) return 1 ;;
    *) fail "$index cannot be asked for $name: $answer" ;;
    esac
}

for crate in "${CRATES[@]}"; do
    if is_there "$crate"; then
        echo "$crate $version is there"
    else
        # It waits until the index has it.
        cargo publish --locked --no-verify -p "$crate" "${to[@]}" "$@"
    fi
done
