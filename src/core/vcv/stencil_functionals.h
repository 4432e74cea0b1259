#pragma once

#include "core/types.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// The five numbers per neighbour that represent a VCV in the operator. With r_0 the node and r_k
/// its neighbours,
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

/// Computational positions of the neighbours in one VCV: edge 0 on the positive x axis, the node at
/// the origin.
std::vector<Vec2> vcv_points(std::span<const double> angles, std::span<const double> lengths);

/// Functionals of one VCV given by the computational positions of its neighbours,
/// counter-clockwise around the origin. Where two edges lie on one line, only these count. Throws
/// NumericError if the VCV has no area.
void compute_functionals(std::span<const Vec2> points, std::span<NeighbourFunctionals> out);

/// Functionals of all VCVs: rows as long as those of Topology::neighbour_rows(). Rows of nodes
/// of the boundary are zero. Nodes whose VCVs have equal angles and unit edges share a row.
class StencilFunctionals {
 public:
  explicit StencilFunctionals(const VirtualControlVolumes& vcv);
  std::span<const NeighbourFunctionals> operator[](Index node) const {
    if (!own_.empty()) {
      const auto found = own_.find(node);
      if (found != own_.end()) return found->second;
    }
    const std::size_t n = topology_->neighbours(node).size();
    return topology_->on_boundary(node) ? std::span(zero_).first(n) : std::span(equal_[n]);
  }

 private:
  using Row = std::vector<NeighbourFunctionals>;

  std::shared_ptr<const Topology> topology_;
  std::vector<Row> equal_;    // by number of neighbours
  std::map<Index, Row> own_;  // of edited VCVs and of hanging nodes
  Row zero_;
};

}  // namespace winslow
