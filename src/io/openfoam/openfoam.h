#pragma once

#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"
#include "io/openfoam/poly_mesh.h"
#include "io/openfoam/thin_mesh.h"

/// Meshes of OpenFOAM: the folder constant/polyMesh of a case, with the files points, faces, owner,
/// neighbour and boundary, in text or binary, each of which may be compressed; OpenFOAM User Guide,
/// "Mesh description". A path may be that folder, its case, the folder of a time in which points
/// have moved, or an (empty) file NAME.foam in the case, as ParaView needs it.
namespace winslow::io::openfoam {

/// The files of a mesh, in the order in which they are read.
constexpr std::array<const char*, 5> file_names{"points", "faces", "owner", "neighbour",
                                                "boundary"};

/// The mesh as it was read. While nodes only move, all but its points is written back unchanged.
struct Details : MarkerDetails {
  PolyMesh mesh;  ///< without the lists of faces and cells
  MeshPlace place;
  std::shared_ptr<const ThinMesh> thin;  ///< null: a volume mesh
};

extern const MeshFormat format;

ParsedMesh read(Source& source, const std::filesystem::path& path, const std::string& time);
std::vector<OutputFile> files(const std::filesystem::path& path, const Mesh& mesh,
                              const FormatDetails* details, const WriteOptions& options,
                              std::vector<std::string>& warnings);

}  // namespace winslow::io::openfoam
