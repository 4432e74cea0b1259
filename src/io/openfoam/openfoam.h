#pragma once

#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// Meshes of OpenFOAM: the folder constant/polyMesh of a case, with the files points, faces, owner,
/// neighbour and boundary; OpenFOAM User Guide, "Mesh description". ASCII; each file may be
/// compressed. A path may be the folder, its case, or an (empty) file NAME.foam in the case, as
/// ParaView needs it.
namespace winslow::io::openfoam {

/// The files of a mesh, in the order in which they are read.
constexpr std::array<const char*, 5> file_names{"points", "faces", "owner", "neighbour",
                                                "boundary"};

/// The texts of the mesh's files. They are written back unchanged while nodes only move.
struct Details : MarkerDetails {
  std::array<std::string, 5> texts;  ///< for points only the text before the list
  std::string points_end;
  bool compressed = false;
};

extern const MeshFormat format;

ParsedMesh read(Source& source);
std::vector<OutputFile> files(const std::filesystem::path& path, const Mesh& mesh,
                              const FormatDetails* details, const WriteOptions& options,
                              std::vector<std::string>& warnings);

}  // namespace winslow::io::openfoam
