#pragma once

#include <cstddef>
#include <cstdint>

#include "core/index.h"

/// The innermost loops of the variational form, four triangles at a time, in machine code for the
/// processor at hand. Every version rounds alike: the result is the same bit for bit.
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
namespace winslow::distortion {

/// psi(f) = linear f + scale f^exponent; integer: the exponent minus 2 if that is a small natural
/// number, else -1.
struct PenaltyConstants {
  double exponent = 1, linear = 0, scale = 1;
  int integer = -1;
};

/// What the loops read. Arrays are owned by others.
struct TriangleData {
  const double* x = nullptr;       ///< #nodes by 2
  const Index* nodes = nullptr;    ///< #triangles by 3, counter-clockwise
  const Index* offsets = nullptr;  ///< #triangles + 1, into terms
  const double* terms = nullptr;   ///< #terms by 4: form ab, ac, bc, and weight
  PenaltyConstants penalty;
  const double* size = nullptr;  ///< #triangles: e / epsilon of the regularised determinant
  double epsilon = 0;            ///< or null and zero: the determinant itself
  double curvature_share = 1;    ///< of -f S in the Hessian: 0 leaves what is convex by itself
};

/// Numbers in a triangle's sum over its terms: the 2x2 blocks (row-major) of a's row at b, a's at
/// c, b's at c; then for each of a, b, c the gradient (x, y), the length of the two edges there,
/// and 1.
struct TriangleSum {
  static constexpr std::ptrdiff_t ab = 0, ac = 4, bc = 8, corners = 12, size = 24;
};

/// Where a triangle's sum belongs in a block of rows. Blocks of the matrix: 4 numbers each; row
/// sums: 8 each, the diagonal block, then gradient, lengths and number of triangles. Place 0 of the
/// matrix and the last row of the sums take what belongs to no row of the block.
struct TrianglePlaces {
  std::uint16_t rows[3];
  Index blocks[6];  ///< a's row at b, b's at a, a's at c, c's at a, b's at c, c's at b
};

struct TriangleKernel {
  /// Sum of weight * psi(f) over the triangles [begin, end); infinite if a determinant is not
  /// positive.
  double (*energy)(const TriangleData&, Index begin, Index end);
  /// sums: TriangleSum::size numbers for each triangle of the list, with room for a multiple of 4.
  /// Returns the energy of those with at least the number first_counted.
  double (*sum)(const TriangleData&, const Index* list, Index count, Index first_counted,
                double* sums);
  /// Adds sums to row sums, and to blocks of the matrix unless `blocks` is null.
  void (*scatter)(const double* sums, const TrianglePlaces*, Index count, double* rows,
                  double* blocks);
  /// Copies rows of blocks that lie one after the other to where each belongs in a matrix.
  /// offsets: of the matrix' rows, in blocks.
  void (*write_rows)(const double* entries, const Index* rows, const Index* offsets, Index count,
                     double* values);
};

/// For any processor.
const TriangleKernel& portable_triangle_kernel();
/// Null where compiler or processor have no AVX2.
const TriangleKernel* avx2_triangle_kernel();
/// The fastest one that runs here.
const TriangleKernel& triangle_kernel();

}  // namespace winslow::distortion
