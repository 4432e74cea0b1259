#pragma once

#include <span>

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"

namespace winslow {

/// Whether the Jacobian of a volume element's map from its reference element is positive all over
/// it, its corners included; a Jacobian that is not a number is not.
///
/// - tetrahedron: constant.
/// - pyramid: (1 - zeta)^2 times a bilinear function of the base's two coordinates (D = det(q_xi,
///   q_eta, apex - q) with q the bilinear base has degree one in each), so its corners decide.
/// - prism: linear over the triangle and quadratic along the third direction: three quadratics
///   decide.
/// - hexahedron: of degree two in each of three directions. Its 27 Bernstein coefficients bound it
///   from below, its values at the lattice of corners, mid-points and centres from above; where
///   these disagree the element is divided into eight, up to five times (A. Johnen, J.-F. Remacle,
///   C. Geuzaine, J. Comput. Phys. 233, 2013). What is undecided then counts as not positive: the
///   Jacobian comes within 1e-6 of its largest value of zero, or so.
bool has_positive_jacobian(const SpacePoints& x, ElementType type, std::span<const Index> corners);

}  // namespace winslow
