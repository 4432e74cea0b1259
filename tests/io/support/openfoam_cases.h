#pragma once

#include <filesystem>
#include <string>

#include "io/support/files.h"

/// Small cases of OpenFOAM.
namespace winslow::test {

/// The unit cube, as blockMesh writes it: one cell, three patches.
inline const std::string cube_points =
    "/* a comment */\nFoamFile\n{\n    format ascii; // text\n    class vectorField;\n"
    "    location \"constant/polyMesh\";\n}\n"
    "8\n(\n(0 0 0)\n(1 0 0)\n(0 1 0)\n(1 1 0)\n(0 0 1)\n(1 0 1)\n(0 1 1)\n(1 1 1)\n)\n// end\n";
inline const std::string cube_faces =
    "6\n(\n4(0 4 6 2)\n4(1 3 7 5)\n4(0 1 5 4)\n4(2 6 7 3)\n4(0 2 3 1)\n4(4 5 7 6)\n)\n";
inline const std::string cube_boundary =
    "3\n(\n    inlet { type patch; nFaces 1; startFace 0; }\n    outlet\n    {\n        type "
    "patch;\n"
    "        inGroups 1(out);\n        nFaces 1;\n        startFace 1;\n    }\n"
    "    sides { type wall; nFaces 4; startFace 2; }\n)\n";

/// Writes the cube into a case. Returns its folder polyMesh.
inline std::filesystem::path write_cube_case(const std::filesystem::path& root,
                                             const std::string& points = cube_points,
                                             const std::string& faces = cube_faces,
                                             const std::string& boundary = cube_boundary) {
  const std::filesystem::path mesh = root / "constant/polyMesh";
  std::filesystem::create_directories(mesh);
  write_text(mesh / "points", points);
  write_text(mesh / "faces", faces);
  write_text(mesh / "owner", "6(0 0 0 0 0 0)");
  write_text(mesh / "neighbour", "0()");
  write_text(mesh / "boundary", boundary);
  return mesh;
}

}  // namespace winslow::test
