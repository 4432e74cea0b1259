#pragma once

#include <cmath>

#include "core/mesh/coordinates.h"
#include "core/vcv/stencil_functionals.h"

/// The paper's operator at one node, step by step: what PointwiseWinslow solves for at all of them,
/// and what an inspection of a node shows.
namespace winslow {

/// Columns of the nodal Jacobian: the area-weighted mean, over the VCV's triangles, of the gradient
/// of the linear maps from them to the physical triangles.
struct NodalGradient {
  Vec2 rx{0, 0}, ry{0, 0};
};

/// Coefficients of the Winslow equations at one node, divided by (alpha + gamma) / 2.
struct WinslowCoefficients {
  double alpha = 1, beta = 0, gamma = 1;
};

/// What one row of the operator amounts to, in the plane or in space.
template <int D>
struct NodalRowOf {
  Vec<D> residual = Vec<D>::Zero();  ///< sum_k w_k (r_k - r_0)
  double weight_sum = 0;
  double absolute_sum = 0;
  double mean_edge = 0;  ///< physical, units of the mesh

  /// Distance by which the node alone would move, its neighbours held, over the mean edge.
  double scaled() const {
    const double size = absolute_sum * mean_edge;
    return size > 0 ? residual.norm() / size : residual.norm();
  }
  /// Rows are scaled to a diagonal near one: w carries the square of the local size otherwise.
  double scale() const { return absolute_sum > 0 ? 1 / absolute_sum : 1; }
  /// The smallest of the weights over their mean magnitude: 1 where all are equal.
  double smallest_weight(std::span<const double> weights) const {
    const double smallest = *std::min_element(weights.begin(), weights.end());
    return smallest * scale() * static_cast<double>(weights.size());
  }
};
using NodalRow = NodalRowOf<2>;

inline NodalGradient nodal_gradient(const Coordinates& x, Index node,
                                    std::span<const Index> neighbours,
                                    std::span<const NeighbourFunctionals> functionals) {
  NodalGradient g;
  const Vec2 r0 = x.xy(node);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec2 d = x.xy(neighbours[k]) - r0;
    g.rx += functionals[k].dx * d;
    g.ry += functionals[k].dy * d;
  }
  return g;
}

/// Where the nodal Jacobian vanishes: those of the Laplacian.
inline WinslowCoefficients winslow_coefficients(const NodalGradient& g) {
  const double alpha = g.ry.squaredNorm();
  const double gamma = g.rx.squaredNorm();
  const double mean = 0.5 * (alpha + gamma);
  if (!(mean > 0)) return {};
  return {alpha / mean, g.rx.dot(g.ry) / mean, gamma / mean};
}

/// Weight of one neighbour.
inline double winslow_weight(const WinslowCoefficients& c, const NeighbourFunctionals& f) {
  return c.alpha * f.lxx - c.beta * f.lxy + c.gamma * f.lyy;
}

template <int D = 2>
NodalRowOf<D> evaluate_row(const Coordinates& x, Index node, std::span<const Index> neighbours,
                           std::span<const double> weights) {
  NodalRowOf<D> row;
  const Vec<D> r0 = x.get<D>(node);
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec<D> d = x.get<D>(neighbours[k]) - r0;
    row.residual += weights[k] * d;
    row.weight_sum += weights[k];
    row.absolute_sum += std::abs(weights[k]);
    row.mean_edge += d.norm();
  }
  row.mean_edge /= static_cast<double>(neighbours.size());
  return row;
}

}  // namespace winslow
