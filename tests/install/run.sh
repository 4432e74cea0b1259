#!/usr/bin/env bash
# Installs a build into a temporary place and builds somebody else's project on it, with OpenGL and
# everything graphical hidden from CMake. Usage: run.sh BUILD_FOLDER
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >/dev/null
hidden=()
for package in OpenGL glfw3 glm PNG PkgConfig nlohmann_json pugixml; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cmake -S "$here/consumer" -B "$work/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" "${hidden[@]}" >"$work/log" || { cat "$work/log"; exit 1; }
cmake --build "$work/consumer" -v >"$work/log" || { cat "$work/log"; exit 1; }

graphical='lib(GL|EGL|OpenGL|OSMesa|glfw|X11|imgui|png)[^a-z]|-l(GL|EGL|glfw|imgui)|winslow_gui|winslow_io'
if grep -nE "$graphical" "$work/log" "$work/consumer/build.ninja"; then
  echo "winslow::core links graphics"
  exit 1
fi
if ldd "$work/consumer/consumer" | grep -E "$graphical"; then
  echo "the consumer loads graphics at run time"
  exit 1
fi
"$work/consumer/consumer"
if [[ -x $work/prefix/bin/winslow ]]; then
  (cd "$work" && ./prefix/bin/winslow --version)
  # The studio's bundled meshes come with it.
  for mesh in naca0012 three_element circle quads; do
    test -s "$work/prefix/share/winslow/$mesh.su2" -a -s "$work/prefix/share/winslow/coarse/$mesh.su2"
  done
  # So do its manual page and the completions.
  for page in man/man1/winslow.1 bash-completion/completions/winslow zsh/site-functions/_winslow \
    fish/vendor_completions.d/winslow.fish; do
    grep -q formulation "$work/prefix/share/$page"
  done
fi
echo "The installed winslow::core serves another project, without graphics."
