#!/usr/bin/env bash
# A program with graphics on a machine without EGL: all that draws nothing works, and what draws says which
# package is missing. Usage: no_egl.sh PROGRAM MESH
set -euo pipefail
program=$(realpath "$1")
mesh=$(realpath "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

if objdump -p "$program" | grep -E 'NEEDED +lib(GL|EGL|OpenGL|GLX)'; then
  echo "it cannot start without EGL"
  exit 1
fi
# A file that is no library stands for the one that is missing.
echo "no library" >libEGL.so.1
export LD_LIBRARY_PATH=$work
unset DISPLAY WAYLAND_DISPLAY
"$program" --version
"$program" move "$mesh" -o moved.su2 --marker airfoil --rotate -10 --quiet
if "$program" render moved.su2 -o picture.png 2>said; then
  echo "it drew without EGL"
  exit 1
fi
grep -q 'libegl1' said
