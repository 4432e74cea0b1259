#pragma once

#include <array>

#include "core/formulation/volume_metric.h"

/// Distortion of one tetrahedron against one target. Gradients and Hessians: tetrahedron_kernel.h,
/// where the equations are.
namespace winslow::distortion {

/// The three edges at the tetrahedron's first node, and the determinant.
struct Corner3 {
  Edges3 edges;
  double d;

  explicit Corner3(const std::array<Vec3, 4>& p);
  /// f; not positive where the tetrahedron is inverted.
  double distortion(const VolumeTerm& term) const;
};

}  // namespace winslow::distortion
