#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# gui.sh ZIP FOLDER [TEST]: tests/gui.py, or another TEST.py, in a window of Debian's Blender, on a display of its own of
# $SIZE pixels. Pictures go to FOLDER.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
zip=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
user=$(mktemp -d)
trap 'rm -rf "$user"' EXIT
mkdir -p "$user/scripts/addons"
export BLENDER_USER_RESOURCES=$user BLENDER_USER_SCRIPTS=$user/scripts BLENDER_USER_CONFIG=$user/config
export LIBGL_ALWAYS_SOFTWARE=1
size=${SIZE:-1280x800}
timeout 400 xvfb-run -a -s "-screen 0 ${size}x24 +extension GLX" \
    blender --factory-startup --enable-event-simulate --window-geometry 0 0 "${size%x*}" "${size#*x}" \
    --python "$here/${3:-gui}.py" -- "$zip" "$folder" 2>&1 | tee "$folder/log"
grep -q '^The window test has passed$' "$folder/log"
