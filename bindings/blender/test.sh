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
zip=$(bindings/blender/build.sh)

# User files go to a folder of their own.
fresh() {
    user=$(mktemp -d)
    mkdir -p "$user/scripts/addons"
    export BLENDER_USER_RESOURCES=$user BLENDER_USER_SCRIPTS=$user/scripts BLENDER_USER_CONFIG=$user/config
}

# check NAME COMMAND...: a test file's output has to end with "N of N tests have passed".
check() {
    printf -- '-- %s\n' "$1"
    fresh
    local status=0
    timeout 600 "${@:2}" >"$out/log" 2>&1 || status=$?
    rm -rf "$user"
    grep -E '^(ok|FAILED|Fatal|Segm)|^        |tests have passed' "$out/log" || true
    if [ $status -ne 0 ] || ! grep -qE '^([1-9][0-9]*) of \1 tests have passed$' "$out/log"; then
        tail -40 "$out/log"
        echo "$1: failed with $status" >&2
        exit 1
    fi
}

for suite in test_lifecycle test_fair test_fill test_join; do
    check "Blender 3.4, $suite" blender -b --factory-startup --python-exit-code 7 --python $tests/$suite.py -- "$zip"
done

for bpy in 4.2.23 5.0.1; do
    venv bpy-${bpy%.*} bpy==$bpy
    python=$out/bpy-${bpy%.*}/bin/python
    # Blender's own validator of extensions.
    "$python" "$(echo "$out"/bpy-${bpy%.*}/lib/python3.11/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py)" \
        validate "$zip" >"$out/log" 2>&1 || { cat "$out/log"; exit 1; }
    printf -- '-- bpy %s: the extension is valid\n' $bpy
    for suite in test_lifecycle test_fair test_fill test_join; do
        check "bpy $bpy, $suite" "$python" $tests/$suite.py "$zip"
    done
done

printf -- '-- Blender 3.4, the window\n'
$tests/gui.sh "$zip" "$out/gui" | grep -v '^Info\|^Modules\|^addon_utils'
