#!/usr/bin/env bash
# A program without graphics, for cluster nodes: it loads no library that draws, does all else, and says of
# what draws what is missing. Usage: no_graphics.sh PROGRAM MESH
set -euo pipefail
program=$(realpath "$1")
mesh=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

if ldd "$program" | grep -E 'lib(GL|EGL|OpenGL|GLX|OSMesa|glfw|X11|xcb|wayland|cairo|freetype|png)'; then
  echo "it loads libraries that draw"
  exit 1
fi
"$program" --version
if "$program" --help | grep -E '^  (render|studio) '; then
  echo "the help offers what it does not have"
  exit 1
fi
"$program" move "$mesh" -o moved.su2 --marker airfoil --rotate -10 --quiet
"$program" quality moved.su2 >/dev/null
for command in "render moved.su2 -o picture.png" "studio moved.su2" "studio --screenshot picture.png"; do
  # shellcheck disable=SC2086
  if "$program" $command 2>said; then
    echo "winslow $command succeeded"
    exit 1
  fi
  grep -q 'built without graphics' said && grep -q 'WINSLOW_BUILD_GUI=ON' said
done
test ! -e picture.png
