#!/bin/bash
# Opens the studio's window on a virtual display, drags a body with the mouse, saves the mesh through
# the dialog and quits, all by real X events; then checks the file that was written.
#   studio_window.sh WINSLOW MESH OUTPUT_FOLDER
# Leaves studio_window.png in OUTPUT_FOLDER. Exit code 77: there is no Xvfb here.
set -euo pipefail
winslow=$(realpath "$1") mesh=$2 out=$(realpath "$3")

command -v Xvfb > /dev/null || { echo "skipped: Xvfb is not installed"; exit 77; }
command -v xdotool > /dev/null || { echo "xdotool is missing (Debian: xdotool)"; exit 1; }

work=$(mktemp -d)
studio='' server=''
cleanup() {
  if [ -n "$studio" ]; then kill "$studio" 2> /dev/null || true; fi
  if [ -n "$server" ]; then kill "$server" 2> /dev/null || true; fi
  rm -rf "$work"
}
trap cleanup EXIT
fail() { echo "FAILED: $1"; cat "$work/log" 2> /dev/null || true; exit 1; }

Xvfb -displayfd 3 -screen 0 1440x900x24 -nolisten tcp 3> "$work/display" 2> /dev/null &
server=$!
for _ in $(seq 100); do [ -s "$work/display" ] && break; sleep 0.1; done
[ -s "$work/display" ] || fail "Xvfb does not start"
DISPLAY=:$(cat "$work/display")
export DISPLAY
unset WAYLAND_DISPLAY
export WINSLOW_PROFILE="$work/profile"

cp "$mesh" "$work/mesh.su2"
cd "$work"
"$winslow" studio mesh.su2 > log 2>&1 &
studio=$!
window=$(timeout 60 xdotool search --sync --onlyvisible --name winslow | head -1) ||
  fail "no window appears"
for _ in $(seq 200); do
  [ "$(xdotool getwindowname "$window")" = "mesh.su2 - winslow" ] && break
  sleep 0.1
done
[ "$(xdotool getwindowname "$window")" = "mesh.su2 - winslow" ] || fail "the mesh is not opened"
sleep 1

# The body is in the middle of the viewport; the panels around it have fixed sizes.
x=704 y=358
xdotool mousemove "$x" "$y"
sleep 0.3
xdotool mousedown 1
for step in 1 2 3 4 5 6; do
  xdotool mousemove $((x + 12 * step)) $((y - 6 * step))
  sleep 0.05
done
xdotool mouseup 1
# An edit that is not saved shows as an asterisk once the solver has converged.
for _ in $(seq 600); do
  [ "$(xdotool getwindowname "$window")" = "* mesh.su2 - winslow" ] && break
  sleep 0.1
done
[ "$(xdotool getwindowname "$window")" = "* mesh.su2 - winslow" ] || fail "the drag moved nothing"
sleep 0.5
xdotool key F12
for _ in $(seq 100); do [ -s winslow-001.png ] && break; sleep 0.1; done
[ -s winslow-001.png ] || fail "F12 writes no picture"
mv winslow-001.png "$out/studio_window.png"

xdotool key ctrl+shift+s
sleep 1
xdotool type --delay 60 moved.su2
xdotool key Return
for _ in $(seq 100); do
  [ "$(xdotool getwindowname "$window")" = "moved.su2 - winslow" ] && break
  sleep 0.1
done
import -window root "$out/studio_saved.png" 2> /dev/null || true
[ -s moved.su2 ] || fail "the dialog saves nothing"

xdotool key ctrl+q
for _ in $(seq 100); do kill -0 "$studio" 2> /dev/null || break; sleep 0.1; done
kill -0 "$studio" 2> /dev/null && fail "Ctrl+Q does not quit"
wait "$studio" || fail "the studio ends with exit code $?"
studio=''

"$winslow" quality moved.su2 > quality.txt || fail "the saved mesh is not valid"
/usr/bin/env python3 - mesh.su2 moved.su2 << 'EOF' || fail "the saved mesh is not the dragged one"
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
