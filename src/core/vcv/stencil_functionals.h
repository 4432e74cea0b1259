#pragma once

#include <span>
#include <vector>

#include "core/types.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// The five numbers per neighbour to which a VCV reduces. With r_0 the node and r_k its neighbours,
///   r_x = sum_k dx_k (r_k - r_0),   r_y = sum_k dy_k (r_k - r_0)
/// is the area-weighted mean of the VCV triangles' gradients (Green-Gauss over the VCV polygon),
/// and
///   w_k = alpha lxx_k - beta lxy_k + gamma lyy_k
/// makes sum_k w_k (r_k - r_0) the integral of K grad r over the VCV's boundary, where
/// K = [[alpha, -beta], [-beta, gamma]].
struct NeighbourFunctionals {
  double dx, dy;
  double lxx, lxy, lyy;
};

/// Functionals of one VCV given by the computational positions of its neighbours,
/// counter-clockwise around the origin. Throws NumericError if the VCV has no area.
void compute_functionals(std::span<const Vec2> points, std::span<NeighbourFunctionals> out);

/// Functionals of all VCVs: rows aligned with Topology::neighbour_rows(). Rows of nodes that are
/// not free are zero.
class StencilFunctionals {
 public:
  explicit StencilFunctionals(const VirtualControlVolumes& vcv);
  std::span<const NeighbourFunctionals> operator[](Index node) const {
    const auto row = static_cast<std::size_t>(node);
    const auto begin = static_cast<std::size_t>((*offsets_)[row]);
    return {values_.data() + begin, static_cast<std::size_t>((*offsets_)[row + 1]) - begin};
  }

 private:
  const std::vector<Index>* offsets_;  // of the topology, which outlives this
  std::vector<NeighbourFunctionals> values_;
};

}  // namespace winslow
