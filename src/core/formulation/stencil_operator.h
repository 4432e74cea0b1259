#pragma once

#include "core/formulation/nodal_operator.h"
#include "core/formulation/volume_functionals.h"
#include "core/linear/sparse_system.h"
#include "core/mesh/topology.h"
#include "core/vcv/stencil_functionals.h"

namespace winslow {

/// What the paper's operator is made of in the plane (D = 2) and in space (D = 3): all that
/// PointwiseForm<D> knows of the dimension.
///
/// A row's weights w_k = (coefficients) . (flux functionals of neighbour k) depend on the mesh by
/// the nodal gradient G = [r_x r_y (r_z)] alone, so that the derivative of sum_k w_k (r_k - r_0)
/// beyond the one with frozen weights is
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

/// Pattern of the systems of some nodes of a mesh: row i is node i of them and those of its
/// neighbours that are among them.
struct NodePattern {
  /// nodes: ascending.
  NodePattern(const Topology& topology, std::span<const Index> nodes);

  std::shared_ptr<const SparsityPattern> pattern;
  std::vector<Index> row_of_node;  ///< #nodes, -1 for nodes without a row
  /// For each entry of Topology::neighbour_rows(): where its matrix entry lies, -1 if there is
  /// none.
  std::vector<Index> entry_of_neighbour;
};

}  // namespace winslow
