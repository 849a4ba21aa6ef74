#!/usr/bin/env bash
# Builds everything for the targets given (by default all of them) with build.sh and what packs its results, and lists what is in target/packaging/dist
# with sizes and SHA-256 in target/packaging/dist/MANIFEST. With --list it lists what is there, and builds nothing.
#   packaging/manifest.sh [--list] [TARGET...]
set -euo pipefail
. "$(dirname "$0")/tools.sh"
if [ "${1-}" != --list ]; then
    read -ra targets <<<"${*:-$TARGETS}"
    for target in "${targets[@]}"; do
        begin=$SECONDS
        "$root/packaging/build.sh" "$target" >&2
        [[ $target != linux-* ]] || "$root/packaging/deb.sh" "$target" >&2
        [ "$target" != wasm32 ] || "$root/packaging/npm.sh" >&2
        [ "$target" = wasm32 ] || "$root/packaging/wheel.sh" "$target" >&2
        case $target in linux-x86_64 | windows-* | macos-*) "$root/packaging/blender.sh" "$target" >&2 ;; esac
        [ "$target" != linux-x86_64 ] || "$root/packaging/meshlab.sh" >&2
        echo "$target: $((SECONDS - begin)) s" >&2
    done
    # Of no target.
    [ $# -gt 0 ] || "$root/packaging/crates.sh" >&2
    "$root/packaging/source.sh" >&2
fi
cd "$dist"
{
    printf '# fairmesh %s, %s, %s\n# SHA-256, bytes, file\n' "$version" \
        "$(git -C "$root" rev-parse HEAD 2>/dev/null || echo 'no commit')" "$(rustc --version)"
    for file in $(printf '%s\n' * | grep -v '^MANIFEST$' | LC_ALL=C sort); do
        printf '%s %9d %s\n' "$(sha256sum "$file" | cut -d' ' -f1)" "$(wc -c <"$file")" "$file"
    done
} >MANIFEST.part
grep -v MANIFEST.part MANIFEST.part >MANIFEST
rm MANIFEST.part
cat MANIFEST
