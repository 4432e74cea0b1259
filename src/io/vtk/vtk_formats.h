#pragma once

#include "io/format/mesh_format.h"

/// Legacy VTK files: unstructured grids and polygon data, versions 1 to 5, ASCII and binary.
namespace winslow::io::vtk {

extern const MeshFormat legacy_format;

ParsedMesh read_legacy(Source& source);
/// Writes version 3.0, which every reader understands.
std::vector<std::string> write_legacy(std::ostream& out, const Mesh& mesh,
                                      const FormatDetails* source, bool binary);

/// VTK XML unstructured grids (.vtu).

extern const MeshFormat vtu_format;

/// Reads ASCII, inline base64, and appended raw or base64 data, compressed by zlib or not.
ParsedMesh read_vtu(Source& source);
/// Writes ASCII or, if `binary`, appended raw data.
std::vector<std::string> write_vtu(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                                   bool binary);

}  // namespace winslow::io::vtk
