#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "io/parsed_mesh.h"

/// Legacy VTK files: unstructured grids and polygon data, versions 1 to 5, ASCII and binary.
namespace winslow::io::vtk {

ParsedMesh read_legacy(Source& source);
/// Writes version 3.0, which every reader understands.
std::vector<std::string> write_legacy(std::ostream& out, const Mesh& mesh,
                                      const FormatDetails* source, bool binary);

}  // namespace winslow::io::vtk
