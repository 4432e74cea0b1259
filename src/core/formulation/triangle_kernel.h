#pragma once

#include "core/formulation/simplex_kernel.h"

/// The innermost loops of the variational form over triangles, four at a time, in machine code for
/// the processor at hand.
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

using TriangleKernel = SimplexKernel<2>;

/// SimplexLayout by name: the blocks of a's row at b, a's at c, b's at c, and the corners.
struct TriangleSum {
  static constexpr std::ptrdiff_t ab = 0, ac = 4, bc = 8, corners = SimplexLayout<2>::corners,
                                  size = SimplexLayout<2>::sum;
};

/// For any processor.
const TriangleKernel& portable_triangle_kernel();
/// Null where compiler or processor have no AVX2.
const TriangleKernel* avx2_triangle_kernel();
/// The fastest one that runs here.
const TriangleKernel& triangle_kernel();

}  // namespace winslow::distortion
