#pragma once

#include "core/quality/finite_volumes.h"

namespace winslow {

/// A penalty on faces of a volume mesh that lean: those whose area vector makes a large angle with
/// the line between the centres of their two cells (OpenFOAM's non-orthogonality,
/// FiniteVolumes::orthogonality()).
///
///   P = sum_f p(a_f),   p(a) = ((a - first) / (full - first))^3 for a > first, else 0.
///
///     const winslow::CellFaces faces = winslow::cell_faces(*mesh.topology);
///     const winslow::FacePenalty penalty(faces, list, {62, 70});
///     std::vector<winslow::Vec3> slopes(mesh.topology->node_count(), winslow::Vec3(0, 0, 0));
///     const double p = penalty.add(mesh.coordinates, 1, slopes);
class FacePenalty {
 public:
  /// The angles (degrees) from which a face is penalised, and at which its penalty is 1.
  struct Angles {
    double first, full;
  };
  /// faces: kept by reference. penalised: internal faces.
  FacePenalty(const CellFaces& faces, std::vector<Index> penalised, const Angles& angles);

  /// Returns P, and adds `factor` times its derivatives by the nodes to `slopes` (#nodes; may be
  /// empty).
  double add(const Coordinates& x, double factor, std::span<Vec3> slopes) const;
  /// FiniteVolumes::orthogonality() of an internal face.
  double cosine(const Coordinates& x, Index face) const;

 private:
  struct Lean;
  Lean lean_of(const SpacePoints& x, Index face) const;
  void add_slopes_of_cell(const SpacePoints& x, Index cell, const Vec3& slope,
                          std::span<Vec3> slopes) const;

  const CellFaces& faces_;
  std::vector<Index> penalised_;
  Angles angles_;
};

}  // namespace winslow
