#!/usr/bin/env bash
# Makes target/blender/fairmesh_blender-<version>.zip, which Blender 3.4 to 4.1 installs as an add-on and 4.2 and later
# as an extension. Linux x86_64; needs cargo and python3 with venv. The library inside needs glibc 2.28 or newer.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$PWD
out=$root/target/blender
. bindings/blender/tools.sh

version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
# One version everywhere: Cargo.toml, the extension's manifest, the add-on's bl_info.
grep -q "^version = \"$version\"$" bindings/blender/addon/blender_manifest.toml
grep -q "\"version\": (${version//./, })," bindings/blender/addon/__init__.py

# zig's linker knows the C library of each version; the machine's own would ask for the machine's own.
venv tools cargo-zigbuild==0.24.0 ziglang==0.17.0
export ZIG_GLOBAL_CACHE_DIR=$out/zig CARGO_ZIGBUILD_CACHE_DIR=$out/zigbuild
PATH=$out/tools/bin:$PATH cargo-zigbuild zigbuild --release --locked --quiet --lib --no-default-features --features capi \
    --target x86_64-unknown-linux-gnu.2.28
built=${CARGO_TARGET_DIR:-target}/x86_64-unknown-linux-gnu/release/libfairmesh.so

# What the file asks of the C library: nothing newer than 2.28.
newest=$(objdump -T "$built" | grep -o 'GLIBC_[0-9.]*' | sort -Vu | tail -1)
[ "$(printf '%s\n' "$newest" GLIBC_2.28 | sort -V | tail -1)" = GLIBC_2.28 ] || {
    echo "$built needs $newest" >&2
    exit 1
}

stage=$out/stage
rm -rf "$stage"
# Not "fairmesh": as an add-on it is a top-level module of Python, and would hide the Python package of that name.
top=$stage/fairmesh_blender
mkdir -p "$top/lib/linux-x64" "$top/fairmesh"
cp bindings/blender/addon/*.py bindings/blender/addon/blender_manifest.toml bindings/blender/addon/LICENSE "$top"
cp bindings/python/src/fairmesh/*.py LICENSE-MIT LICENSE-APACHE "$top/fairmesh"
objcopy --strip-debug "$built" "$top/lib/linux-x64/libfairmesh.so"

zip=$out/fairmesh_blender-$version.zip
rm -f "$zip"
(cd "$stage" && python3 -m zipfile -c "$zip" fairmesh_blender)
echo "$zip"
