#pragma once

#include <array>
#include <span>

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// Twice the signed area of a triangle.
inline double twice_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// True if any corner has an area that is not positive (or is not a number).
bool is_inverted(const Coordinates& coordinates, std::span<const Index> corners);

/// Corners (positions in the element) of the two triangles that fill a quadrilateral: cut along the
/// diagonal that leaves no triangle turned over, where there is one.
std::array<int, 6> cut_quadrilateral(const Coordinates& coordinates,
                                     std::span<const Index> corners);

}  // namespace winslow::gui
