#!/bin/bash
# The studio's window by its keyboard: the palette, the list of keys, a drag, saving into another
# folder by a typed path, and leaving with unsaved changes asked for.
#   studio_keys.sh WINSLOW MESH OUTPUT_FOLDER
# Leaves keys_*.png in OUTPUT_FOLDER. Exit code 77: there is no Xvfb here.
set -euo pipefail
winslow=$(realpath "$1") mesh=$(realpath "$2") out=$(realpath "$3")
# shellcheck source=tests/xvfb/support.sh
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"

start_display
cp "$mesh" "$work/mesh.su2"
mkdir "$work/results"
start_studio mesh.su2
wait_title "mesh.su2 - winslow"
wait_picture "the mesh"

xdotool key question
wait_picture "? shows the keys"
keep_picture keys_help
xdotool key Escape
wait_picture "Esc puts the keys away"

xdotool key ctrl+p
wait_picture "Ctrl+P shows the palette"
xdotool type --delay 20 "save pict"
wait_picture "typing filters the palette"
keep_picture keys_palette
xdotool key Return
until_true 60 test -s winslow-001.png || fail "the palette runs nothing"

# The body is in the middle of the viewport; the panels around it have fixed sizes.
xdotool mousemove --sync 704 358 mousedown 1
for step in 1 2 3 4; do xdotool mousemove --sync $((704 + 14 * step)) 358; done
xdotool mouseup 1
wait_title "* mesh.su2 - winslow"

wait_picture "the body is moved"
xdotool key ctrl+q
wait_picture "unsaved changes are asked for"
keep_picture keys_unsaved
gone && fail "it leaves without asking"
xdotool key Escape
wait_picture "Esc stays"

xdotool key ctrl+shift+s
wait_picture "the dialog"
xdotool key ctrl+a
xdotool type --delay 20 "results/"
wait_picture "a typed folder is gone into"
keep_picture keys_dialog
xdotool type --delay 20 "moved.vtu"
xdotool key Return
wait_title "moved.vtu - winslow"
[ -s results/moved.vtu ] || fail "nothing was written"
"$winslow" quality results/moved.vtu > quality.txt || fail "the saved mesh is not valid"

xdotool key ctrl+q
until_true 30 gone || fail "Ctrl+Q does not quit"
wait "$studio" || fail "the studio ends with exit code $?"
studio=''
grep -q moved.vtu "$WINSLOW_PROFILE/settings.json" || fail "the recent file is not kept"
echo "passed"
