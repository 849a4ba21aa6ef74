# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2154
# Sourced by the scripts here. $out: where everything goes that is made or fetched.

. "$(dirname "${BASH_SOURCE[0]}")/../../packaging/install.sh"

# venv NAME PACKAGE==VERSION...: a virtual environment $out/NAME with these packages, made once. $PYTHON makes it.
venv() {
    local folder=$out/$1 wanted="${*:2}"
    [ "$(cat "$folder/fairmesh-packages" 2>/dev/null)" = "$wanted" ] && return
    rm -rf "$folder"
    "${PYTHON:-python3}" -m venv "$folder"
    # shellcheck disable=SC2086
    PIP_CACHE_DIR=$out/pip "$folder/bin/pip" install --quiet --disable-pip-version-check $wanted
    echo "$wanted" >"$folder/fairmesh-packages"
}

# What Blender 3.4 of Debian, its display and the pictures need.
install_blender() {
    local missing=()
    command -v blender >/dev/null || missing+=(blender python3-numpy libgl1-mesa-dri)
    command -v xvfb-run >/dev/null || missing+=(xvfb xauth)
    command -v import >/dev/null || missing+=(imagemagick)
    python3 -c 'import venv, ensurepip' 2>/dev/null || missing+=(python3-venv)
    [ ${#missing[@]} -eq 0 ] && return
    install_packages "${missing[@]}"
}

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

# valid BPY ZIP: by the validator of extensions in bpy of this version, which a venv has, with the tags that Blender knows.
valid() {
    local home=$out/bpy-${1%.*} scripts
    scripts=$(echo "$home"/lib/python3.11/site-packages/bpy/*/scripts)
    "$home/bin/python" "$scripts/addons_core/bl_pkg/cli/blender_ext.py" validate \
        --valid-tags "$scripts/modules/_bpy_internal/extensions/tags.py" "$2" >"$out/log" 2>&1 || { cat "$out/log" && exit 1; }
    printf -- '-- bpy %s: the extension is valid\n' "$1"
}
