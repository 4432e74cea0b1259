#pragma once

#include "io/openfoam/openfoam.h"

namespace winslow::io::openfoam {

/// A part of the boundary to write.
struct NewPatch {
  std::string name;
  std::vector<Face> faces;
  /// Its text between the braces, with other numbers of faces; empty: of type patch.
  std::string entry;
};

/// A mesh to write whose files are not those that were read. Faces are in OpenFOAM's order: first
/// inner faces, sorted by the lower and then by the higher cell number ("upper triangular"), then
/// those of each patch. Faces are counter-clockwise seen from outside the owner.
struct NewMesh {
  std::vector<double> xyz;
  std::vector<Face> faces;
  std::vector<Index> owner, neighbour;
  std::vector<NewPatch> patches;
  std::vector<std::string> warnings;
};

/// The files of a volume mesh. source: the mesh that was read, whose patches keep their types;
/// null: none.
NewMesh new_volume_mesh(const Mesh& mesh, const Details* source);

/// The files of a plane mesh: one cell thick. With a source that is thin, between its planes or as
/// its wedge; else over a tenth of its extent, between patches front and back of type empty.
NewMesh new_thin_mesh(const Mesh& mesh, const FormatDetails* details, const Details* source);

}  // namespace winslow::io::openfoam
