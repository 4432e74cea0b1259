#!/usr/bin/env bash
# Installs a build into a place of its own and builds somebody else's projects on it: one on winslow::core
# with OpenGL and everything graphical hidden from CMake, and the examples. Usage: run.sh BUILD_FOLDER
set -euo pipefail
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# Not a new place every time: the compiler cache then knows what was compiled there.
work=$build/tests/install/work
rm -rf "$work"
mkdir -p "$work"
export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER-$(command -v ccache || true)}

# run LOG COMMAND...: quietly, unless it fails.
run() {
  local log=$work/$1.log
  shift
  "$@" >"$log" 2>&1 || { cat "$log"; echo "failed: $*"; exit 1; }
}

run install cmake --install "$build" --prefix "$work/prefix"
hidden=()
for package in OpenGL glfw3 glm PNG PkgConfig nlohmann_json pugixml; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
run configure cmake -S "$here/consumer" -B "$work/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix" "${hidden[@]}"
run build cmake --build "$work/consumer" -v

graphical='lib(GL|EGL|OpenGL|OSMesa|glfw|X11|imgui|png)[^a-z]|-l(GL|EGL|glfw|imgui)|winslow_gui|winslow_io'
if grep -nE "$graphical" "$work/build.log" "$work/consumer/build.ninja"; then
  echo "winslow::core links graphics"
  exit 1
fi
if ldd "$work/consumer/consumer" | grep -E "$graphical"; then
  echo "the consumer loads graphics at run time"
  exit 1
fi
"$work/consumer/consumer"

program=$work/prefix/bin/winslow
if [[ -x $program ]]; then
  (cd "$work" && [[ $("$program" --version) == "winslow $("$work/consumer/consumer" version)" ]])
  # The studio's bundled meshes and the pictures of its demos come with it.
  for mesh in naca0012 three_element circle quads; do
    test -s "$work/prefix/share/winslow/$mesh.su2" -a -s "$work/prefix/share/winslow/coarse/$mesh.su2"
  done
  test -s "$work/prefix/share/winslow/coarse/wing.su2.gz" -a -s "$work/prefix/share/winslow/demos/A.png"
  # So do its manual page, the completions, the licence and the pages that one reads.
  for page in man/man1/winslow.1 bash-completion/completions/winslow zsh/site-functions/_winslow \
    fish/vendor_completions.d/winslow.fish; do
    grep -q formulation "$work/prefix/share/$page"
  done
  for page in LICENSE README.md docs/library.md docs/command-line.md docs/pictures/head.png; do
    test -s "$work/prefix/share/doc/winslow/$page"
  done
fi

# The examples, as they were installed. They want mesh files.
if [[ -n $(find "$work/prefix" -name 'libwinslow_io.*') ]]; then
  run examples-configure cmake -S "$work/prefix/share/winslow/examples" -B "$work/examples" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Wconversion -Werror" \
    -DCMAKE_PREFIX_PATH="$work/prefix"
  run examples-build cmake --build "$work/examples"
  python3 -B "$here/header_examples.py" "$work/prefix/include/winslow" >"$work/header_examples.cpp"
  run headers-configure cmake -S "$here/headers" -B "$work/headers" -G Ninja \
    -DCMAKE_BUILD_TYPE=Debug "-DHEADER_EXAMPLES=$work/header_examples.cpp" -DCMAKE_PREFIX_PATH="$work/prefix"
  run headers-build cmake --build "$work/headers"
  if [[ -x $program ]]; then
    run examples ctest --test-dir "$work/examples" --output-on-failure
    grep -E 'tests passed' "$work/examples.log"
    run turns-configure cmake -S "$here/../../bench/library" -B "$work/turns" -G Ninja \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
    run turns-build cmake --build "$work/turns"
    run turns "$work/turns/turns" "$work/prefix/share/winslow/coarse/wing.su2.gz" 2 -1
  fi
fi
echo "The installed winslow serves other projects, winslow::core without graphics."
