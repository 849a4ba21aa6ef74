#!/usr/bin/env bash
# SPDX-License-Identifier: MIT OR Apache-2.0
# Drives the real MeshLab 2020.09 under Xvfb: menu, dialog, preview, apply, error box. Fails if the program's log does not say what it
# has to. Pictures go to the folder given; docs/ has some of them.
#   gui.sh FOLDER      after build.sh debian and test.sh, which make the program's folder and a Python with numpy
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
work=$(cd "$here/../../target/meshlab" && pwd)
out=$1
mkdir -p "$out" "$work/runtime"
chmod 700 "$work/runtime"
log=$work/gui.log

# The same settings every time, and none of the user's.
export HOME=$work/runtime XDG_RUNTIME_DIR=$work/runtime XDG_CONFIG_HOME=$work/runtime LIBGL_ALWAYS_SOFTWARE=1
coproc SCREEN { exec Xvfb -displayfd 1 -screen 0 1200x800x24 +extension GLX 2>/dev/null; }
screen=$SCREEN_PID
read -r number <&"${SCREEN[0]}"
export DISPLAY=:$number
trap 'kill ${meshlab:-} $screen 2>/dev/null || true' EXIT

fail() {
    import -window root "$out/failed.png" || true
    printf 'gui.sh: %s (see %s)\n' "$*" "$out/failed.png" >&2
    tail -5 "$log" >&2
    exit 1
}
# appears NAME SECONDS: waits for a window and sets $window.
appears() {
    for _ in $(seq $((4 * $2))); do
        window=$(xdotool search --onlyvisible --name "$1" 2>/dev/null | tail -1) || true
        if [ -n "$window" ]; then return; fi
        sleep 0.25
    done
    return 1
}
window() {
    appears "$1" 60 || fail "no window '$1'"
}
# logged COUNT TEXT: waits until the program's log has the text so often.
logged() {
    for _ in $(seq 240); do
        if [ "$(grep -c -- "$2" "$log")" -ge "$1" ]; then return; fi
        sleep 0.25
    done
    fail "the log does not say '$2' $1 times"
}
shot() { sleep 1 && import -window root "$out/$1.png"; }
# click FROM_LEFT FROM_BOTTOM: in the dialog.
click() {
    local HEIGHT
    eval "$(xdotool getwindowgeometry --shell "$dialog" | grep HEIGHT)"
    xdotool mousemove --window "$dialog" "$1" $((HEIGHT - $2)) click 1
}
# A screen of 768 rows has room for so many, besides a title and a panel.
ROOM=700
# fits NAME: the dialog has room, and so its buttons can be reached.
fits() {
    local HEIGHT
    eval "$(xdotool getwindowgeometry --shell "$dialog" | grep HEIGHT)"
    printf '%s: %d pixels high\n' "$1" "$HEIGHT"
    [ "$HEIGHT" -le $ROOM ] || fail "the dialog '$1' is $HEIGHT pixels high, more than $ROOM"
}
# button QUARTER FROM_BOTTOM: in the dialog, at this quarter of its width.
button() {
    local WIDTH
    eval "$(xdotool getwindowgeometry --shell "$dialog" | grep WIDTH)"
    click $(($1 * WIDTH / 4)) "$2"
}
# open TEXT WINDOW: the first hit of MeshLab's own search. A busy program may lose keys.
open() {
    for _ in 1 2 3; do
        xdotool windowfocus "$main" key ctrl+f
        sleep 1
        xdotool type --delay 40 "$1"
        sleep 1
        xdotool key Down Return
        if appears "$2" 20; then return; fi
        xdotool key Escape Escape
    done
    fail "no window '$2'"
}

"$work/venv-pymeshlab/bin/python" "$here/gui_mesh.py" "$work/dent.ply"
"$work/host-debian/bin/meshlab" "$work/dent.ply" >"$log" 2>&1 &
meshlab=$!
window 'MeshLab 2020.09 - '
main=$window
logged 1 'All files opened'
xdotool windowmove "$main" 0 0 windowsize "$main" 1200 800
sleep 1
shot start

# The menu of the filters, and in it that of smoothing.
menu() {
    xdotool windowfocus "$main" mousemove 121 10 click 1
    sleep 1
    xdotool mousemove 240 236 click 1
    sleep 1
}
menu
shot menu
xdotool key Escape Escape Escape

open 'fair selected' 'Fairmesh: Fair Selected Region'
dialog=$window
xdotool windowmove "$dialog" 660 40
shot dialog
fits 'Fair Selected Region'
click 17 83 # Preview
logged 1 'Fairing converged'
shot preview
click 17 83 # off again: the dent is back
shot preview_off
click 401 22 # Apply
logged 2 'Fairing converged'
logged 1 'Applied filter Fairmesh: Fair Selected Region'
shot applied

click 338 133 # the number of iterations
xdotool key ctrl+a type 0
click 401 22 # Apply
window 'Filter Failure'
xdotool windowmove "$window" 60 250
shot error
xdotool windowfocus "$window" key Return
logged 1 'Filter failed: Parameter max_iterations is 0'
button 1 22 # Close
sleep 1
# The first of them in the menu.
entry=212
for name in 'Bridge Boundaries' 'Close Holes' 'Erase and Fill'; do
    menu
    xdotool mousemove 612 $entry click 1
    entry=$((entry + 25))
    window "Fairmesh: $name"
    dialog=$window
    xdotool windowmove "$dialog" 660 0
    shot "dialog ${name,,}"
    fits "$name"
    button 3 53 # Help
    xdotool windowmove "$dialog" 100 0
    shot "help ${name,,}"
    fits "$name, with help"
    button 1 22 # Close
    sleep 1
done
kill -0 $meshlab || fail "MeshLab has ended"
printf 'gui.sh: menu, dialog, preview, apply and error box are as they have to be\n'
