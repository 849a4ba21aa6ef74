#!/usr/bin/env bash
# Makes target/blender/fairmesh_blender-<version>.zip, which Blender 3.4 to 4.1 installs as an add-on and 4.2 and later
# as an extension. Linux x86_64; needs cargo, binutils and python3 with venv. The library inside needs glibc 2.28 or newer.
set -euo pipefail
cd "$(dirname "$0")/../.."
PATH=$PATH:$HOME/.cargo/bin
out=${CARGO_TARGET_DIR:-$PWD/target}/blender

version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
# One version everywhere: Cargo.toml, the extension's manifest, the add-on's bl_info.
grep -q "^version = \"$version\"$" bindings/blender/addon/blender_manifest.toml
grep -q "\"version\": (${version//./, })," bindings/blender/addon/__init__.py

library=$(bindings/python/build_library.sh)

tree=$out/tree
rm -rf "$tree"
# Not "fairmesh": as an add-on it is a top-level module of Python, and would hide the Python package of that name.
top=$tree/fairmesh_blender
mkdir -p "$top/lib/linux-x64" "$top/fairmesh"
cp bindings/blender/addon/*.py bindings/blender/addon/blender_manifest.toml bindings/blender/addon/LICENSE "$top"
cp bindings/python/src/fairmesh/*.py LICENSE-MIT LICENSE-APACHE "$top/fairmesh"
python3 packaging/third_party.py fairmesh-capi x86_64-unknown-linux-gnu >"$top/lib/THIRD-PARTY.txt"
cp "$library" "$top/lib/linux-x64/libfairmesh.so"
. bindings/blender/tools.sh
venv manual markdown==3.7
"$out/manual/bin/python" bindings/blender/manual_page.py "$top/manual"

zip=$out/fairmesh_blender-$version.zip
rm -f "$zip"
(cd "$tree" && python3 -m zipfile -c "$zip" fairmesh_blender)
echo "$zip"
