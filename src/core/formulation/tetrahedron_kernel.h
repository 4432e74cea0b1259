#pragma once

#include "core/formulation/simplex_kernel.h"

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
namespace winslow::distortion {

using TetrahedronKernel = SimplexKernel<3>;

/// For any processor.
const TetrahedronKernel& portable_tetrahedron_kernel();
/// Null where compiler or processor have no AVX2.
const TetrahedronKernel* avx2_tetrahedron_kernel();
/// The fastest one that runs here.
const TetrahedronKernel& tetrahedron_kernel();

}  // namespace winslow::distortion
