#pragma once

#include "core/quality/finite_volumes.h"
#include "core/quality/quality.h"

/// What OpenFOAM's checkMesh says of a mesh:
///
///     const winslow::OpenFoamMeasures measures = winslow::openfoam_measures(mesh);
///     for (const winslow::CheckedMeasure& measure : measures.rows)
///       std::printf("%s: %d beyond the limit\n", measure.name.data(), measure.beyond);
namespace winslow {

/// One of checkMesh's measures over all faces, cells or edges of a mesh.
struct CheckedMeasure {
  std::string_view name;       ///< in reports: "non_orthogonality"
  std::string_view label;      ///< "Non-orthogonality"
  std::string_view unit = {};  ///< "degrees"; empty: a pure number
  std::string_view of;         ///< "internal faces": what has a value each
  bool larger_is_better = false;
  /// What checkMesh allows; infinite: anything.
  double limit = std::numeric_limits<double>::infinity();
  bool fails = true;          ///< beyond the limit checkMesh fails; false: it mentions them
  bool all_geometry = false;  ///< measured with -allGeometry only

  Statistics values = {};  ///< all 0 where nothing has a value
  Index count = 0;         ///< how many have a value
  Index beyond = 0;        ///< how many of them are beyond the limit
};

/// The numbers of `checkMesh -allGeometry` of OpenFOAM v1912 with its limits (checkGeometry.C,
/// primitiveMeshCheck.C and polyMeshCheck.C). It prints the largest or smallest value, and the
/// average of some. The average of the non-orthogonality is the angle of the mean cosine.
///
/// Faces of cyclic patches count as boundary faces; checkMesh counts them as internal ones.
struct OpenFoamMeasures {
  std::vector<CheckedMeasure> rows;
  Vec3 boundary_openness{0, 0, 0};  ///< sum of the area vectors of the boundary over that of areas
  double total_volume = 0;
  Index orthogonality_errors = 0;  ///< internal faces with 90 degrees or more
  Index pyramid_errors = 0;        ///< pyramids of faces with less volume than -1e-15
  Index poor_divisions = 0;        ///< see FiniteVolumes::poor_divisions()
  Index concave_cells = 0;

  /// Throws UsageError for an unknown name.
  const CheckedMeasure& of(std::string_view name) const&;
  CheckedMeasure of(std::string_view name) &&;  ///< a copy, since the measures are a temporary
  /// What checkMesh fails for, in words; empty: "Mesh OK.", as far as the geometry goes.
  std::vector<std::string> failures() const;
  /// What it fails for besides with -allGeometry.
  std::vector<std::string> further_failures() const;
};

/// threads: 0 for all cores; the result does not depend on it.
OpenFoamMeasures openfoam_measures(const CellFaces& faces, const Coordinates& x, int threads = 0,
                                   SolvedDirections directions = {true, true, true});
/// The same of a volume mesh. Throws UsageError for another mesh.
OpenFoamMeasures openfoam_measures(const Mesh& mesh, int threads = 0);

/// The non-orthogonality that checkMesh allows, in degrees.
inline constexpr double largest_non_orthogonality = 70;

/// Internal faces that lean by more than checkMesh allows.
struct LeaningFaces {
  std::vector<Index> faces;  ///< ascending
  Index worst = -1;          ///< the one that leans most; -1: there are none
  double angle = 0;          ///< by how much it leans, degrees
};
/// Those of a mesh that do not lean so far in another one of the same faces.
LeaningFaces newly_leaning_faces(const FiniteVolumes& mesh, const FiniteVolumes& reference);

}  // namespace winslow
