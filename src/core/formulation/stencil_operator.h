#pragma once

#include "core/linear/sparse_system.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/types.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "core/vcv/stencil_functionals.h"

/// The paper's operator at one node, step by step, for PointwiseWinslow and for the inspection of
/// nodes.
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

/// The value of one row of the operator, in the plane or in space.
template <int D>
struct NodalRowOf {
  Vec<D> residual = Vec<D>::Zero();  ///< sum_k w_k (r_k - r_0)
  double weight_sum = 0;
  double absolute_sum = 0;
  double mean_edge = 0;  ///< physical, units of the mesh

  /// Distance by which the node alone would move, with its neighbours held, divided by the mean
  /// edge length.
  double scaled() const {
    const double size = absolute_sum * mean_edge;
    return size > 0 ? residual.norm() / size : residual.norm();
  }
  /// Scales rows to a diagonal near one; without it, w is proportional to the square of the local
  /// size.
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

/// Coefficients; those of the Laplacian if the nodal Jacobian vanishes.
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

/// The nine numbers per neighbour that represent a VCV of a volume mesh in the operator. With r_0
/// the node and r_k its neighbours,
///   r_x = sum_k dx_k (r_k - r_0)  and so on
/// is the volume-weighted mean of the VCV tetrahedra's gradients (Green-Gauss over the VCV), and
///   w_k = K_xx lxx_k + K_yy lyy_k + K_zz lzz_k + K_xy lxy_k + K_yz lyz_k + K_zx lzx_k
/// makes sum_k w_k (r_k - r_0) the integral of K grad r over the VCV's boundary, K symmetric.
struct VolumeFunctional {
  double dx, dy, dz;
  double lxx, lyy, lzz, lxy, lyz, lzx;
};

/// Functionals of one VCV with the node at the origin. points: positions of the vertices of its
/// link. out: #vertices. Throws NumericError if the volume of one of its tetrahedra is not
/// positive.
void compute_functionals(const SphereLink& link, std::span<const Vec3> points,
                         std::span<VolumeFunctional> out);

/// Functionals of all VCVs: rows as long as those of Topology::neighbour_rows(), and zero for nodes
/// of the boundary. Every evaluation of the operator reads them: 72 bytes for each neighbour.
class VolumeFunctionals {
 public:
  /// threads: 0 for all cores; no result depends on it.
  VolumeFunctionals(const VolumeVcvs& vcvs, int threads);
  std::span<const VolumeFunctional> operator[](Index node) const {
    const auto& offsets = topology_->neighbour_rows().offsets;
    return std::span(values_).subspan(at(offsets[at(node)]),
                                      at(offsets[at(node) + 1] - offsets[at(node)]));
  }

 private:
  std::shared_ptr<const Topology> topology_;
  std::vector<VolumeFunctional> values_;
};

/// Coefficients of the Winslow equations in space,
///
///   alpha_1 r_xx + alpha_2 r_yy + alpha_3 r_zz + 2 (beta_1 r_xy + beta_2 r_yz + beta_3 r_xz) = 0,
///
/// K = [alpha_1 beta_1 beta_3; beta_1 alpha_2 beta_2; beta_3 beta_2 alpha_3] = adj(G^T G), G =
/// [r_x r_y r_z], divided by a third of its trace; those of the Laplacian if the trace vanishes.
Eigen::Matrix3d winslow_tensor(const Eigen::Matrix3d& gradient);

/// Weight of one neighbour.
inline double winslow_weight(const Eigen::Matrix3d& k, const VolumeFunctional& f) {
  return k(0, 0) * f.lxx + k(1, 1) * f.lyy + k(2, 2) * f.lzz + k(0, 1) * f.lxy + k(1, 2) * f.lyz +
         k(2, 0) * f.lzx;
}

/// The parts of the paper's operator in the plane (D = 2) and in space (D = 3): all code of
/// PointwiseForm<D> that depends on the dimension.
///
/// A row's weights w_k = (coefficients) . (flux functionals of neighbour k) depend on the mesh only
/// through the nodal gradient G = [r_x r_y (r_z)]. So the derivative of sum_k w_k (r_k - r_0),
/// without the part with frozen weights, is
///
///   sum_i B_i dG_i,   B_i = (sum over components c of F_c (dc'/dG_i)^T - R (dm/dG_i)^T) / m,
///
/// F_c the flux functionals of component c applied to r over the edges that are not clipped, c' the
/// coefficients before their division by their mean m, R the row's residual.
template <int D>
struct StencilOperator;

template <>
struct StencilOperator<2> {
  using Vcvs = VirtualControlVolumes;
  using Functional = NeighbourFunctionals;
  using Functionals = StencilFunctionals;
  using Coefficients = WinslowCoefficients;
  using Matrix = Eigen::Matrix2d;
  using Fluxes = std::array<Vec2, 3>;  ///< xx, xy, yy

  static Functionals functionals(const Vcvs& vcvs, int /*threads*/) { return Functionals(vcvs); }
  static Vec2 gradient(const Functional& f) { return {f.dx, f.dy}; }
  static std::array<double, 3> flux(const Functional& f) { return {f.lxx, f.lxy, f.lyy}; }
  static Coefficients coefficients(const Matrix& g) {
    return winslow_coefficients(NodalGradient{g.col(0), g.col(1)});
  }
  /// B_x, B_y; zero where the gradient vanishes: the coefficients are constants there.
  static std::array<Matrix, 2> slopes(const Matrix& g, const Fluxes& flux, const Vec2& residual);
};

template <>
struct StencilOperator<3> {
  using Vcvs = VolumeVcvs;
  using Functional = VolumeFunctional;
  using Functionals = VolumeFunctionals;
  using Coefficients = Eigen::Matrix3d;
  using Matrix = Eigen::Matrix3d;
  using Fluxes = std::array<Vec3, 6>;  ///< xx, yy, zz, xy, yz, zx

  static Functionals functionals(const Vcvs& vcvs, int threads) { return {vcvs, threads}; }
  static Vec3 gradient(const Functional& f) { return {f.dx, f.dy, f.dz}; }
  static std::array<double, 6> flux(const Functional& f) {
    return {f.lxx, f.lyy, f.lzz, f.lxy, f.lyz, f.lzx};
  }
  static Coefficients coefficients(const Matrix& g) { return winslow_tensor(g); }
  /// B_x, B_y, B_z; zero where the cofactors of the gradient vanish.
  static std::array<Matrix, 3> slopes(const Matrix& g, const Fluxes& flux, const Vec3& residual);
};

/// Matrix pattern for some nodes of a mesh: row i has entries for node i of the list and for its
/// neighbours in the list.
struct NodePattern {
  /// nodes: ascending.
  NodePattern(const Topology& topology, std::span<const Index> nodes);
  std::size_t bytes() const {
    return bytes_of(pattern) + bytes_of(row_of_node, entry_of_neighbour);
  }

  std::shared_ptr<const SparsityPattern> pattern;
  std::vector<Index> row_of_node;  ///< #nodes, -1 for nodes without a row
  /// For each entry of Topology::neighbour_rows(): the index of its matrix entry, -1 if there is
  /// none.
  std::vector<Index> entry_of_neighbour;
};

}  // namespace winslow
