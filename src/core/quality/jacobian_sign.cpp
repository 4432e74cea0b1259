#include "core/quality/jacobian_sign.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/quality/volume_corner.h"

namespace winslow {

namespace {

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

bool corners_positive(const SpacePoints& x, ElementType type, std::span<const Index> corners) {
  for (const auto& corner : corner_tetrahedra(type)) {
    if (VolumeCorner(x, by_nodes(corner, corners)).inverted()) return false;
  }
  return true;
}

/// Smallest value over [0, 1] of the quadratic with these values at 0, 1/2 and 1.
double smallest_of_quadratic(double start, double middle, double end) {
  const double curve = 2 * (start - 2 * middle + end), slope = -3 * start + 4 * middle - end;
  const double least = std::min(start, end);
  if (!(curve > 0)) return least;
  const double t = -slope / (2 * curve);
  return t > 0 && t < 1 ? std::min(least, start + t * (slope + t * curve)) : least;
}

bool prism_positive(const SpacePoints& x, std::span<const Index> corners) {
  std::array<Vec3, 3> low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = x[corners[k]];
    high[k] = x[corners[k + 3]];
  }
  // The triangle's sides at height t, and the vertical edge at each of its corners.
  const auto at_corner = [&](std::size_t k, double t) {
    const auto place = [&](std::size_t i) { return Vec3((1 - t) * low[i] + t * high[i]); };
    const Vec3 p = place(0);
    return determinant(place(1) - p, place(2) - p, high[k] - low[k]);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    if (!(smallest_of_quadratic(at_corner(k, 0), at_corner(k, 0.5), at_corner(k, 1)) > 0))
      return false;
  }
  return true;
}

/// Values of a polynomial of degree two in each of three directions at the 27 points of the lattice
/// {0, 1/2, 1}^3, or its Bernstein coefficients; the first direction runs fastest.
using Lattice = std::array<double, 27>;

/// change(first, second, third value along a line) for every line in each direction.
template <typename Change>
void along_lines(Lattice& values, Change&& change) {
  for (const std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{9}}) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i / step % 3 == 0) change(values[i], values[i + step], values[i + 2 * step]);
    }
  }
}

Lattice bernstein(Lattice values) {
  along_lines(values, [](double start, double& middle, double end) {
    middle = 2 * middle - 0.5 * (start + end);
  });
  return values;
}

/// Bernstein coefficients over one of the eight parts, halves along each direction.
Lattice part_of(Lattice c, std::size_t which) {
  std::size_t direction = 0;
  for (const std::size_t step : {std::size_t{1}, std::size_t{3}, std::size_t{9}}) {
    const bool upper = (which >> direction++ & 1U) != 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (i / step % 3 != 0) continue;
      double &a = c[i], &b = c[i + step], &d = c[i + 2 * step];
      const double ab = 0.5 * (a + b), bd = 0.5 * (b + d), middle = 0.5 * (ab + bd);
      if (upper) {
        a = middle;
        b = bd;
      } else {
        b = ab;
        d = middle;
      }
    }
  }
  return c;
}

bool all_positive(const Lattice& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
}

/// The coefficients at the corners are values of the polynomial.
bool corner_values_positive(const Lattice& c) {
  for (const unsigned i : {0U, 2U, 6U, 8U, 18U, 20U, 24U, 26U}) {
    if (!(c[i] > 0)) return false;
  }
  return true;
}

bool positive_over(const Lattice& coefficients, int depth) {
  if (all_positive(coefficients)) return true;
  if (depth == 0 || !corner_values_positive(coefficients)) return false;
  for (std::size_t part = 0; part < 8; ++part) {
    if (!positive_over(part_of(coefficients, part), depth - 1)) return false;
  }
  return true;
}

/// The Jacobian of the trilinear map at the lattice.
Lattice jacobians(const SpacePoints& x, std::span<const Index> corners) {
  // Corners by their coordinates: the first direction fastest.
  constexpr std::array<std::size_t, 8> order{0, 1, 3, 2, 4, 5, 7, 6};
  std::array<Vec3, 8> p;
  for (std::size_t k = 0; k < 8; ++k) p[k] = x[corners[order[k]]];
  // Derivative along direction d, bilinear in the other two coordinates.
  const auto derivative = [&](std::size_t d, double s, double t) {
    const std::size_t step = std::size_t{1} << d, one = std::size_t{1} << ((d + 1) % 3),
                      two = std::size_t{1} << ((d + 2) % 3);
    const auto edge = [&](std::size_t from) { return Vec3(p[from + step] - p[from]); };
    return Vec3((1 - s) * (1 - t) * edge(0) + s * (1 - t) * edge(one) + (1 - s) * t * edge(two) +
                s * t * edge(one + two));
  };
  Lattice values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double u = 0.5 * static_cast<double>(i % 3), v = 0.5 * static_cast<double>(i / 3 % 3),
                 w = 0.5 * static_cast<double>(i / 9 % 3);
    values[i] = determinant(derivative(0, v, w), derivative(1, w, u), derivative(2, u, v));
  }
  return values;
}

bool hexahedron_positive(const SpacePoints& x, std::span<const Index> corners) {
  constexpr int divisions = 5;
  const Lattice values = jacobians(x, corners);
  if (!all_positive(values)) return false;
  return positive_over(bernstein(values), divisions);
}

}  // namespace

bool has_positive_jacobian(const SpacePoints& x, ElementType type, std::span<const Index> corners) {
  if (!corners_positive(x, type, corners)) return false;
  if (type == ElementType::prism) return prism_positive(x, corners);
  if (type == ElementType::hexahedron) return hexahedron_positive(x, corners);
  return true;
}

}  // namespace winslow
