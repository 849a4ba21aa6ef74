#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the add-on: the zip, installed by Blender's own operators in Debian's Blender 3.4 and in the modules bpy 4.2 and 5.0,
# then its window under Xvfb. Debian 12 with Rust and Python 3.11; installs what is missing. bpy is fetched once (350 MB each).
set -euo pipefail
cd "$(dirname "$0")/../.."
mkdir -p "${CARGO_TARGET_DIR:-target}/blender"
out=$(cd "${CARGO_TARGET_DIR:-target}/blender" && pwd)
tests=bindings/blender/tests
. bindings/blender/tools.sh

install_blender
# The modules bpy 4.2 and 5.0 are made for Python 3.11, that of Debian 12.
PYTHON=$(command -v python3.11)
venv ruff ruff==0.17.5
"$out/ruff/bin/ruff" check --quiet bindings/blender
"$out/ruff/bin/ruff" format --check --quiet bindings/blender
"$PYTHON" $tests/test_platforms.py --quiet
zip=$(bindings/blender/build.sh)

for suite in test_lifecycle test_messages test_sidebar test_normals test_fair test_live test_fill test_join test_round; do
    check "Blender 3.4, $suite" blender -b --factory-startup --python-exit-code 7 --python $tests/$suite.py -- "$zip"
done

for bpy in 4.2.23 5.0.1; do
    venv bpy-${bpy%.*} bpy==$bpy
    python=$out/bpy-${bpy%.*}/bin/python
    valid "$bpy" "$zip"
    for suite in test_lifecycle test_messages test_sidebar test_normals test_fair test_live test_fill test_join test_round; do
        check "bpy $bpy, $suite" "$python" $tests/$suite.py "$zip"
    done
done

printf -- '-- Blender 3.4, the window\n'
# Software OpenGL takes long for large windows: what is measured is measured in a small one.
in_window() {
    SIZE=$1 $tests/gui.sh "$zip" "$out/gui" "$2" | grep -v '^Info\|^Modules\|^addon_utils'
}
in_window 1280x800 gui
in_window 1280x800 start
in_window 900x640 live
in_window 640x480 live_frames
