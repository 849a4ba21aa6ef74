#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Records Fair Live in the window of Debian's Blender, with the zip of build.sh: bindings/blender/images/live.gif. recording.sh [ZIP]
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${CARGO_TARGET_DIR:-$PWD/target}/blender
. bindings/blender/tools.sh
install_blender
zip=${1:-$(bindings/blender/build.sh)}
rm -rf "$out/recording"
SIZE=800x560 bindings/blender/tests/gui.sh "$zip" "$out/recording" record_live >/dev/null
to=bindings/blender/images/live.gif
convert -delay 12 "$out"/recording/live_*.png -crop 800x514+0+18 +repage -resize 640x -dither None -colors 96 -layers OptimizePlus -layers OptimizeTransparency "$to"
rm -rf "$out/recording"
[ "$(stat -c %s "$to")" -lt 1500000 ] || { echo "$to is larger than 1.5 MB" >&2 && exit 1; }
