#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "io/format/mesh_format.h"

/// Legacy VTK files: unstructured grids and polygon data, versions 1 to 5, ASCII and binary.
namespace winslow::io::vtk {

extern const MeshFormat legacy_format;

ParsedMesh read_legacy(Source& source);
/// Writes version 3.0, which every reader understands.
std::vector<std::string> write_legacy(std::ostream& out, const Mesh& mesh,
                                      const FormatDetails* source, bool binary);

}  // namespace winslow::io::vtk
