#!/usr/bin/env bash
# src/core includes no OpenGL, no ImGui, no file format and nothing of the layers above it;
# src/io no OpenGL, no ImGui, no gui and no app.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
graphics='GL/|GLES|glad|EGL/|GLFW|imgui|glm/|epoxy|png\.h'
formats='nlohmann|pugixml|zlib\.h|OpenMesh/Core/IO|cgnslib|fstream|filesystem'
status=0
forbid() { # FOLDER PATTERN
  if grep -rnE "#\s*include\s*[<\"]($2)" "$1"; then
    echo "$1 must not include these"
    status=1
  fi
}
forbid src/core "$graphics|$formats|io/|gui/|app/"
forbid src/io "$graphics|gui/|app/"
forbid src/gui "app/|CLI/"
# Linear solvers know matrices alone; outer solvers know problems alone, no mesh and no formulation.
mesh='core/(mesh/[^c]|quality/[^v]|vcv|motion|layers|formulation|strategy|command)'
forbid src/core/linear "core/(mesh|quality|vcv|problem|outer)"
forbid src/core/problem "$mesh|core/outer"
forbid src/core/outer "$mesh"
[[ $(find src/core -name '*.h' | wc -l) -gt 10 ]] # the folders are where this test looks
[[ $status -eq 0 ]] && echo "Layers hold."
exit $status
