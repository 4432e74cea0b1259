#pragma once

#include "core/index.h"

/// The innermost loops of the variational form and their data, over the triangles of a plane mesh
/// (D = 2) and the tetrahedra of a volume mesh (D = 3). All versions of a loop round alike: the
/// results are bitwise identical.
namespace winslow::distortion {

/// psi(f) = linear f + scale f^exponent; integer: the exponent minus 2 if that is a small natural
/// number, else -1. Or, with an inverse_bound, psi(f) = f / (1 - inverse_bound f), infinite from f
/// = 1 / inverse_bound on.
///
/// Guards, the terms with a limit, have a penalty of their own, one-sided and twice differentiable:
///
///   psi(f) = guard (r^p - 1 - p (r - 1) - p (p - 1) / 2 (r - 1)^2),   r = limit_share f / limit >
///   1,
///
/// and 0 up to r = 1; p is the exponent. Beyond r = steepest it goes on with the same slope.
struct PenaltyConstants {
  double exponent = 1, linear = 0, scale = 1;
  int integer = -1;
  double inverse_bound = 0;  ///< 0: none
  double guard = 0;          ///< weight of the guards; 0: they have no effect
  double limit_share = 1;    ///< below 1: all limits are raised
  double steepest = 1;       ///< r up to which the slope of guards increases
};

/// Input of the loops. Non-owning pointers.
struct SimplexData {
  const double* x = nullptr;       ///< #nodes by D
  const Index* nodes = nullptr;    ///< #cells by D + 1, positively oriented
  const Index* offsets = nullptr;  ///< #cells + 1, into terms
  const double* terms = nullptr;   ///< #terms by SimplexLayout::term
  /// #terms: of a guard the inverse of its limit, of other terms 0. Null: there is no guard.
  const double* inverse_limits = nullptr;
  PenaltyConstants penalty;
  const double* size = nullptr;  ///< #cells: e / epsilon of the regularised determinant
  double epsilon = 0;            ///< or null and zero: the determinant itself
  double curvature_share = 1;  ///< of the determinant's second derivatives in the Hessian: 0 leaves
                               ///< the part that is convex by itself
};

/// Storage layout. A cell's sum over its terms: for each pair of nodes in lexicographic order, the
/// D by D block (row-major) in the earlier node's row at the later node. From `corners` on, each
/// node has `corner` numbers: in the plane the gradient and the length of the edges there; in space
/// the same as a row. A row's sum over its cells: the diagonal block, and from `gradient` on the
/// gradient and the length. Without a Hessian, a cell has slim_sum numbers: for each node the
/// gradient and the length, and from slim_traces on the traces of the nodes' diagonal blocks.
template <int D>
struct SimplexLayout;

template <>
struct SimplexLayout<2> {
  static constexpr std::ptrdiff_t term = 4;  ///< form ab, ac, bc, and weight
  static constexpr std::ptrdiff_t corners = 12, corner = 4, sum = 24;
  static constexpr std::ptrdiff_t gradient = 4, row = 8;
};

template <>
struct SimplexLayout<3> {
  static constexpr std::ptrdiff_t term = 8;  ///< metric 11, 12, 13, 22, 23, 33, weight, unused
  static constexpr std::ptrdiff_t corners = 56, corner = 16, sum = 120;
  static constexpr std::ptrdiff_t slim_corner = 4, slim_traces = 16, slim_sum = 20;
  static constexpr std::ptrdiff_t scalar_sum = 6, scale = 2;
  static constexpr std::ptrdiff_t gradient = 12, row = 16;
};

/// Where a cell's sum is added in a block of rows. Place 0 of the block's matrix and the last row
/// of its sums receive the parts that belong to no row of the block.
template <int D>
struct SimplexPlaces {
  std::uint16_t rows[D + 1];
  Index blocks[D * (D + 1)];  ///< of each pair the earlier node's row at the later one, then the
                              ///< later one's at the earlier
};

template <int D>
struct SimplexKernel {
  /// Sum of weight * psi(f) over the cells [begin, end); infinite if a determinant is not positive.
  double (*energy)(const SimplexData&, Index begin, Index end);
  /// sums: SimplexLayout::sum numbers for each cell of the list, with room for a multiple of 4
  /// cells. Returns the energy of the cells with numbers from first_counted on.
  double (*sum)(const SimplexData&, const Index* list, Index count, Index first_counted,
                double* sums);
  /// The same with the Hessian of each term projected to positive semidefinite. Null in the plane,
  /// where one triangle is projected at a time (distortion.h).
  double (*sum_projected)(const SimplexData&, const Index* list, Index count, Index first_counted,
                          double* sums);
  /// Only gradients and traces, slim_sum numbers for each cell; null in the plane.
  double (*sum_gradients)(const SimplexData&, const Index* list, Index count, double* sums);
  /// Adds sums to row sums, and to blocks of the matrix unless `blocks` is null.
  void (*scatter)(const double* sums, const SimplexPlaces<D>*, Index count, double* rows,
                  double* blocks);
  /// Adds sums without a Hessian to row sums, the trace to the first number. Null in the plane.
  void (*scatter_gradients)(const double* sums, const SimplexPlaces<D>*, Index count, double* rows);
  /// For first-order methods, of the cells [begin, end): returns their energy, infinite if a
  /// determinant is not positive, and adds the gradients to `sums`, unless it is infinite. x, sums:
  /// four numbers a point, of which three are used. corners: of the cells from `begin` on, four
  /// points each. Without a regularisation. Null in the plane.
  double (*add_gradients)(const SimplexData&, const double* x, const Index* corners, Index begin,
                          Index end, double* sums);
  /// Likewise adds what the scales of residuals need, `scale` numbers a point: the lengths of the
  /// edges and the trace of the diagonal block. Of inverted cells as well. Null in the plane.
  void (*add_scales)(const SimplexData&, const double* x, const Index* corners, Index begin,
                     Index end, double* sums);
  /// A scalar that resembles the Hessian in each component, positive semidefinite: over the edges k
  /// and l of a cell, summed over its terms,
  ///
  ///   psi' f (2 / s) A_kl + (1/3) (psi'' f^2 / 2 + psi' f) v_k . v_l + (2/27) psi' f w_k . w_l.
  ///
  /// The part of the Hessian that is the same for all components, and of others a third of the
  /// trace, without those that can be negative. sums: 11, 12, 13, 22, 23, 33 of each cell of the
  /// list (`scalar_sum` numbers), with room for a multiple of 4 cells. Null in the plane.
  void (*sum_scalars)(const SimplexData&, const Index* list, Index count, double* sums);
  /// Copies contiguous rows of blocks to their places in a matrix. offsets: of the matrix rows, in
  /// blocks.
  void (*write_rows)(const double* entries, const Index* rows, const Index* offsets, Index count,
                     double* values);
};

/// The innermost loops of the variational form over triangles, four at a time, in versions for
/// different instruction sets.
///
/// Equations: for a triangle (a, b, c), u = x_b - x_a, v = x_c - x_a, d = u x v (or its regularised
/// chi(d)) and a target's form N = ab |u|^2 + ac |v|^2 + bc |v - u|^2,
///
///   f = N / (2 d),   g_i = df/dx_i = (n_i - 2 f D_i) / (2 d),   n = dN/dx,  D = dd/dx,
///   H_ij = d2f/dx_i dx_j = (1/d) [ L_ij I - f S_ij - g_i D_j^T - D_i g_j^T ],
///
/// L the target's graph Laplacian (L_ij = -ij), S_ij = d2d/dx_i dx_j = [[0, 1], [-1, 0]] for i
/// before j; then by the chain rule for weight * psi(f). Blocks of a row sum to zero: a translation
/// changes nothing.
using TriangleKernel = SimplexKernel<2>;

/// SimplexLayout by name: the blocks of a's row at b, a's at c, b's at c, and the corners.
struct TriangleSum {
  static constexpr std::ptrdiff_t ab = 0, ac = 4, bc = 8, corners = SimplexLayout<2>::corners,
                                  size = SimplexLayout<2>::sum;
};

/// The innermost loops of the variational form over tetrahedra, four at a time.
///
/// Equations: for a tetrahedron with edges e_k = x_k - x_0 (k = 1, 2, 3), E = [e_1 e_2 e_3],
/// d = det E (or its regularised chi(d)), C_k = dd/de_k the cross product of the other two, and a
/// target's metric A (symmetric, determinant 1; A = W^-1 W^-T scaled, W the target's edges),
///
///   s = sum_kl A_kl e_k . e_l = |J|_F^2,   f = s / (3 d^(2/3)),   J = E W^-1,
///   u_k = (2 / s) sum_l A_kl e_l,   w_k = C_k / d,   v_k = u_k - (2/3) w_k,   df/de_k = f v_k,
///   d2f/de_k de_l = f [ -(2/3)(v_k w_l^T + w_k v_l^T) + (2/9) w_k w_l^T
///                       + (2/s) A_kl I - (2/3)(1/d) d2d/de_k de_l ] + f v_k v_l^T,
///
/// where the last term of f comes with the chain rule for weight * psi(f): the sum is
/// psi' f [...] + psi'' f^2 v_k v_l^T. (f: the mean ratio of L. A. Freitag and P. M. Knupp,
/// Int. J. Numer. Meth. Engng 53, 2002, inverted.) Blocks of a row sum to zero: a translation
/// changes nothing.
using TetrahedronKernel = SimplexKernel<3>;

/// For any processor.
template <int D>
const SimplexKernel<D>& portable_kernel();
/// Null where compiler or processor have no AVX2.
template <int D>
const SimplexKernel<D>* avx2_kernel();
/// The fastest one that runs here.
template <int D>
const SimplexKernel<D>& fastest_kernel();

}  // namespace winslow::distortion
