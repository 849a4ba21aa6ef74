#!/usr/bin/env bash
# Sets the version of fairmesh in every file that states it:
#   packaging/set_version.sh 0.2.0
# What is not here derives it: the Makefile, pkg-config, CMake's package and Python's wheel read Cargo.toml.
# Needs GNU sed.
set -euo pipefail
cd "$(dirname "$0")/.."

version=${1-}
number='(0|[1-9][0-9]*)'
if [ $# -ne 1 ] || ! [[ $version =~ ^$number\.$number\.$number$ ]]; then
    echo "usage: packaging/set_version.sh MAJOR.MINOR.PATCH, three plain numbers" >&2
    exit 2
fi
IFS=. read -r major minor patch <<< "$version"

# replace PATTERN TEXT FILE...: every file has to state the version.
replace() {
    local pattern=$1 text=$2 file
    shift 2
    for file in "$@"; do
        if ! grep -Eq "$pattern" "$file"; then
            echo "$file: no version where it is expected" >&2
            exit 1
        fi
        sed -E -i "s/$pattern/$text/" "$file"
    done
}

mapfile -t manifests < <(find . -name Cargo.toml -not -path './target/*' | sort)
for manifest in "${manifests[@]}"; do
    # The members of a workspace may take the version from Cargo.toml at the top.
    if grep -q '^version = "' "$manifest"; then
        replace '^version = ".*"' "version = \"$version\"" "$manifest"
    fi
    sed -E -i "s/(path = \"[^\"]*\", version = \")[^\"]*/\1$version/" "$manifest"
    name=$(sed -n 's/^name = "\(.*\)"/\1/p' "$manifest" | head -1)
    sed -i "/^name = \"$name\"\$/{n;s/.*/version = \"$version\"/}" Cargo.lock
done

replace '^version = ".*"' "version = \"$version\"" bindings/blender/addon/blender_manifest.toml
replace '^(    "version": ).*' "\1($major, $minor, $patch)," bindings/blender/addon/__init__.py
for part in MAJOR=$major MINOR=$minor PATCH=$patch; do
    replace "(VERSION_${part%=*}( |: u32 = | = ))[0-9]+" "\\1${part#*=}" \
        include/fairmesh.h src/capi/about.rs
done
replace '^version: .*' "version: $version" CITATION.cff
replace 'fairmesh_blender-[0-9.]+\.zip' "fairmesh_blender-$version.zip" \
    README.md bindings/blender/README.md docs/start.md
replace "^Version [0-9.]+[0-9]\\." "Version $version." docs/README.md
replace 'fairmesh-[0-9.]+\.tgz' "fairmesh-$version.tgz" bindings/web/README.md docs/start.md
replace 'fairmesh-[0-9.]+-py3' "fairmesh-$version-py3" bindings/python/README.md
replace 'find_package\(fairmesh [0-9.]+ ' "find_package(fairmesh $major.$minor " \
    docs/c-api.md examples/*/CMakeLists.txt meshlab_plugin/CMakeLists.txt
echo "$version"
