#!/bin/bash
# Opens the studio's window on a virtual display, drags a body with the mouse, saves the mesh through
# the dialog and quits, all by real X events; then checks the file that was written.
#   studio_window.sh WINSLOW MESH OUTPUT_FOLDER
# Leaves studio_window.png in OUTPUT_FOLDER. Exit code 77: there is no Xvfb here.
set -euo pipefail
winslow=$(realpath "$1") mesh=$(realpath "$2") out=$(realpath "$3")
# shellcheck source=tests/xvfb/support.sh
. "$(dirname "${BASH_SOURCE[0]}")/support.sh"

start_display
cp "$mesh" "$work/mesh.su2"
start_studio mesh.su2
wait_title "mesh.su2 - winslow"
wait_picture "the mesh"

# The body is in the middle of the viewport; the panels around it have fixed sizes.
x=704 y=358
xdotool mousemove --sync "$x" "$y" mousedown 1
for step in 1 2 3 4 5 6; do
  xdotool mousemove --sync $((x + 12 * step)) $((y - 6 * step))
done
xdotool mouseup 1
# An edit that is not saved shows as an asterisk once the solver has converged.
wait_title "* mesh.su2 - winslow"
wait_picture "the body is moved"
xdotool key F12
until_true 60 test -s winslow-001.png || fail "F12 writes no picture"
mv winslow-001.png "$out/studio_window.png"

xdotool key ctrl+shift+s
wait_picture "the dialog"
xdotool type --delay 20 moved.su2
xdotool key Return
wait_title "moved.su2 - winslow"
keep_picture studio_saved
[ -s moved.su2 ] || fail "the dialog saves nothing"

xdotool key ctrl+q
until_true 30 gone || fail "Ctrl+Q does not quit"
wait "$studio" || fail "the studio ends with exit code $?"
studio=''

"$winslow" quality moved.su2 > quality.txt || fail "the saved mesh is not valid"
/usr/bin/python3 - mesh.su2 moved.su2 << 'EOF' || fail "the saved mesh is not the dragged one"
import sys


def read(path):
    points, markers, expect, marker = [], {}, 0, None
    for line in open(path):
        words = line.split()
        if line.startswith("NPOIN"):
            expect = int(line.split("=")[1].split()[0])
        elif expect:
            points.append((float(words[0]), float(words[1])))
            expect -= 1
        elif line.startswith("MARKER_TAG"):
            marker = line.split("=")[1].strip()
            markers[marker] = set()
        elif marker and len(words) >= 3 and words[0] == "3":
            markers[marker].update(int(w) for w in words[1:3])
    return points, markers


(before, markers), (after, same_markers) = read(sys.argv[1]), read(sys.argv[2])
assert markers == same_markers and len(before) == len(after), "connectivity changed"
moves = {
    name: {(round(after[n][0] - before[n][0], 9), round(after[n][1] - before[n][1], 9)) for n in nodes}
    for name, nodes in markers.items()
}
print({name: sorted(m)[:3] for name, m in moves.items()})
assert moves["farfield"] == {(0.0, 0.0)}, "the far field moved"
assert len(moves["circle"]) == 1, "the circle did not move as one"
((dx, dy),) = moves["circle"]
assert dx > 0 and abs(dx - 2 * dy) < 0.02 * dx, "the circle did not follow the mouse"
EOF
echo "passed"
