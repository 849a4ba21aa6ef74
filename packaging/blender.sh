#!/usr/bin/env bash
# Makes the Blender add-on for one platform, of what build.sh has built, into target/packaging/dist. Needs python3 with venv.
#   packaging/blender.sh linux-x86_64|windows-x86_64|macos-x86_64|macos-aarch64
# One zip is the add-on for Blender 3.4 to 4.1 and the extension for 4.2 and later. It is named as Blender's own builder does with
# --split-platforms.
set -euo pipefail
. "$(dirname "$0")/tools.sh"
target=${1-}
platform=$(blender_platform "$target")
file=$(library_file "$target")
cd "$root"
. bindings/blender/tools.sh
. bindings/blender/tree.sh
tree=$out/stage/$target/fairmesh-$version-$target
[ -e "$tree/$file" ] || fail "$tree is not there: packaging/build.sh $target"
out=$out/blender
mkdir -p "$out"
addon_zip "$platform" "$tree/$file" "$tree/share/doc/fairmesh/THIRD-PARTY.txt" \
    "$dist/fairmesh_blender-$version-${platform//-/_}.zip"
