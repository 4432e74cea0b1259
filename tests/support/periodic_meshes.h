#pragma once

#include <cmath>

#include "core/options/option.h"
#include "support/meshes.h"

namespace winslow::test {

/// Quadrilaterals between radii 1 and 2 about a centre, from the x axis on by an angle in degrees;
/// markers begin, end (one the image of the other by a rotation), inner, outer.
inline MeshData sector(double angle, Index sectors, Index rings, const Vec2& centre) {
  MeshData data;
  const auto id = [&](Index i, Index j) { return i * (sectors + 1) + j; };
  for (Index i = 0; i <= rings; ++i) {
    for (Index j = 0; j <= sectors; ++j) {
      const double phi = radians(angle) * j / sectors, r = 1 + static_cast<double>(i) / rings;
      data.coordinates.push_xy(centre + r * Vec2(std::cos(phi), std::sin(phi)));
    }
  }
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < sectors; ++j)
      add_quad(data, id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
  const double step = radians(angle) / sectors;
  mark_boundary(data, [&](const Vec2& p) {
    const Vec2 q = p - centre;
    const double phi = std::atan2(q.y(), q.x());
    if (std::abs(phi) < 0.1 * step) return "begin";
    if (std::abs(phi - radians(angle)) < 0.1 * step) return "end";
    return q.norm() < 1.5 ? "inner" : "outer";
  });
  return data;
}

/// square_with_hole(); markers left, right, walls, hole.
inline MeshData square_with_periodic_sides(Index n) {
  MeshData data = square_with_hole(n, Cells::triangles);
  data.markers.clear();
  mark_boundary(data, [](const Vec2& p) {
    const Vec2 q = (p - Vec2(0.5, 0.5)).cwiseAbs();
    if (q.maxCoeff() < 0.5 - 1e-9) return "hole";
    if (q.y() > 0.5 - 1e-9) return "walls";
    return p.x() < 0.5 ? "left" : "right";
  });
  return data;
}

}  // namespace winslow::test
