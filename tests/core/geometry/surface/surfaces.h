#pragma once

#include <cmath>
#include <cstddef>
#include <functional>

#include "core/geometry/surface/triangulation.h"

/// Triangulations of surfaces that are known exactly.
namespace winslow::test {

/// The map of [0, 1] x [0, 1] cut into m by n squares of two triangles each; wrapped in one or both
/// directions.
inline Triangulation mapped_grid(int m, int n, bool wrap_u, bool wrap_v,
                                 const std::function<Vec3(double, double)>& map) {
  Triangulation out;
  const int columns = wrap_u ? m : m + 1, rows = wrap_v ? n : n + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) out.points.push_back(map(double(i) / m, double(j) / n));
  const auto node = [&](int i, int j) {
    return static_cast<Index>((j % rows) * columns + i % columns);
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const Index a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      if ((i + j) % 2 == 0) {
        out.triangles.push_back({a, b, c});
        out.triangles.push_back({a, c, d});
      } else {
        out.triangles.push_back({a, b, d});
        out.triangles.push_back({b, c, d});
      }
    }
  return out;
}

constexpr double torus_radius = 2, tube_radius = 0.7;

inline Triangulation torus(int m, int n) {
  return mapped_grid(m, n, true, true, [](double u, double v) {
    const double a = 2 * pi * u, b = 2 * pi * v, r = torus_radius + tube_radius * std::cos(b);
    return Vec3(r * std::cos(a), r * std::sin(a), tube_radius * std::sin(b));
  });
}

inline double distance_from_torus(const Vec3& p) {
  const double across = std::hypot(p.x(), p.y()) - torus_radius;
  return std::abs(std::hypot(across, p.z()) - tube_radius);
}

}  // namespace winslow::test
