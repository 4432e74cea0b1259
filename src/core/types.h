#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace winslow {

/// Index of a node, an element, or an entry of a compressed row.
using Index = std::int32_t;

/// An index as the standard containers take it; it must not be negative.
constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A point or a vector of the plane (D = 2) or of space (D = 3).
template <int D>
using Vec = Eigen::Matrix<double, D, 1>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

inline constexpr double pi = 3.14159265358979323846;

/// Radians of an angle given in degrees.
constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
/// Degrees of an angle given in radians.
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

}  // namespace winslow
