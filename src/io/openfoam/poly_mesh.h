#pragma once

#include "core/types.h"
#include "io/openfoam/case_folder.h"
#include "io/openfoam/foam_file.h"

namespace winslow::io::openfoam {

/// A part of the boundary, as the file `boundary` describes it.
struct Patch {
  std::string name, type;
  std::int64_t first = -1, count = -1;  ///< its faces
  std::vector<std::string> groups;      ///< inGroups
  std::string neighbour;                ///< of a cyclic patch: the other side (neighbourPatch)
  std::string transform;                ///< of a cyclic patch: "translational", "rotational", ...
  double match_tolerance = 1e-4;        ///< of a cyclic patch, over the size of its faces
  std::string entry;                    ///< its text between the braces
  std::size_t place = 0;                ///< in the source

  bool has_faces() const { return count > 0; }
};

/// A file of a mesh beside its points, as it was read.
struct KeptFile {
  std::string name;  ///< in the folder polyMesh: "faces", "sets/walls"
  std::filesystem::path path;
  std::string text;  ///< decompressed
  bool compressed = false;
};

/// The content of a folder polyMesh; OpenFOAM User Guide, "Mesh description".
struct PolyMesh {
  std::vector<double> xyz;                ///< three coordinates of each point
  std::vector<std::size_t> point_places;  ///< where each point is in the source
  FoamFaces faces;                        ///< counter-clockwise seen from outside the owner
  std::vector<Index> owner, neighbour;    ///< cells of each face; neighbours of the first faces
  std::vector<Patch> patches;
  Index cells = 0;
  std::size_t owner_place = 0;  ///< of the file `owner` in the source

  FoamForm points_form;
  std::string points_head, points_end;  ///< what stands around the list of points
  std::filesystem::path points_file;
  bool points_compressed = false;
  std::vector<KeptFile> kept;  ///< faces, owner, neighbour and boundary come first

  Vec3 point(Index i) const { return Vec3(xyz.data() + 3 * static_cast<std::ptrdiff_t>(i)); }
  Index point_count() const { return static_cast<Index>(xyz.size() / 3); }
  /// The faces of each cell, ascending: f of the owner, ~f of the neighbour.
  std::vector<std::vector<Index>> faces_of_cells() const;
};

/// Reads a mesh; each of its files is that of the newest time up to the place's (find_file()), and
/// is appended to the source. Throws InputError.
PolyMesh read_poly_mesh(Source& source, const MeshPlace& place);

}  // namespace winslow::io::openfoam
