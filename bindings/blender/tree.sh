# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2154
# Sourced by build.sh and packaging/blender.sh, in the repository's folder: what is in a zip of the add-on. Needs $out and $version, and tools.sh.

# addon_zip PLATFORM LIBRARY LICENCES ZIP: for the platform that Blender calls so, with this shared library and the licences of what is in it.
# Blender 3.4 to 4.1 installs the zip as an add-on, which takes one folder in it; 4.2 and later as an extension, which may have one.
# Zips of one commit have the same bytes.
addon_zip() {
    local platform=$1 library=$2 licences=$3 zip=$4 tree=$out/tree-$1 file=libfairmesh.so website
    website=$(sed -n 's/^repository = "\(.*\)"/\1/p' Cargo.toml)
    case $platform in
    windows-*) file=fairmesh.dll ;;
    macos-*) file=libfairmesh.dylib ;;
    esac
    # One version everywhere: Cargo.toml, the extension's manifest, the add-on's bl_info.
    grep -q "^version = \"$version\"$" bindings/blender/addon/blender_manifest.toml
    grep -q "\"version\": (${version//./, })," bindings/blender/addon/__init__.py
    # Not "fairmesh": as an add-on it is a top-level module of Python, and would hide the Python package of that name.
    local top=$tree/fairmesh_blender
    rm -rf "$tree"
    mkdir -p "$top/lib/$platform" "$top/fairmesh"
    cp -r bindings/blender/addon/*.py bindings/blender/addon/preset_files bindings/blender/addon/LICENSE "$top"
    sed -e "s/^platforms = .*/platforms = [\"$platform\"]/" -e "s|^website = .*|website = \"$website\"|" \
        bindings/blender/addon/blender_manifest.toml >"$top/blender_manifest.toml"
    bindings/declarations.sh python
    cp bindings/python/src/fairmesh/*.py LICENSE-MIT LICENSE-APACHE "$top/fairmesh"
    # They read meshes of other packages, which Blender does not have.
    rm "$top"/fairmesh/_host_*.py
    cp "$licences" "$top/lib/THIRD-PARTY.txt"
    cp "$library" "$top/lib/$platform/$file"
    python3 bindings/blender/icon.py "$top/icons/fairmesh.live.dat"
    venv manual markdown==3.7
    "$out/manual/bin/python" bindings/blender/manual_page.py "$top/manual"
    SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 1704067200)} \
        python3 packaging/archive.py "$top" "$zip"
}
