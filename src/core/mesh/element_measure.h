#pragma once

#include <span>

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"

namespace winslow {

/// Twice the signed area of a polygon of the plane (shoelace formula), relative to its first
/// corner; positive counter-clockwise.
double signed_area2(const Coordinates& x, std::span<const Index> corners);

/// Six times the signed volume of an element of space: the flux of the position, relative to
/// `origin`, through its faces (divergence theorem), a third of it. A quadrilateral counts as the
/// bilinear surface through its corners, so neighbours agree on it exactly, up to sign and
/// round-off.
double signed_volume6(const Coordinates& x, ElementType type, std::span<const Index> corners,
                      const Vec3& origin);

}  // namespace winslow
