#!/usr/bin/env bash
# Makes target/blender/fairmesh_blender-<version>.zip for this machine, which Blender 3.4 to 4.1 installs as an add-on and 4.2 and later
# as an extension. Linux x86_64; needs cargo, binutils and python3 with venv. The library inside needs glibc 2.28 or newer.
# What is published is made by packaging/blender.sh, for each platform.
set -euo pipefail
cd "$(dirname "$0")/../.."
PATH=$PATH:$HOME/.cargo/bin
out=${CARGO_TARGET_DIR:-$PWD/target}/blender
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -1)
. bindings/blender/tools.sh
. bindings/blender/tree.sh

library=$(bindings/python/build_library.sh)
mkdir -p "$out"
python3 packaging/third_party.py fairmesh-capi x86_64-unknown-linux-gnu >"$out/THIRD-PARTY.txt"
addon_zip linux-x64 "$library" "$out/THIRD-PARTY.txt" "$out/fairmesh_blender-$version.zip"
