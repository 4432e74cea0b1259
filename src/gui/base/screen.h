#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

/// Points and vectors on screen. Their types do not convert from or to Vec2, so that only a view or
/// a camera maps between screen and mesh.
namespace winslow::gui {

/// A distance on screen, pixels of the framebuffer: x to the right, y down.
class ScreenVector {
 public:
  constexpr ScreenVector() = default;
  constexpr ScreenVector(double x, double y) : x_(x), y_(y) {}
  /// From an ImVec2 or a similar type.
  template <class V>
  requires requires(const V& v) { v.x + v.y; }
  constexpr explicit ScreenVector(const V& v)
      : x_(static_cast<double>(v.x)), y_(static_cast<double>(v.y)) {}

  constexpr double x() const { return x_; }
  constexpr double y() const { return y_; }
  constexpr double operator[](int axis) const { return axis == 0 ? x_ : y_; }
  constexpr double dot(const ScreenVector& other) const { return x_ * other.x_ + y_ * other.y_; }
  /// Positive if the other vector lies clockwise on screen.
  constexpr double cross(const ScreenVector& other) const { return x_ * other.y_ - y_ * other.x_; }
  constexpr double squared_norm() const { return dot(*this); }
  double norm() const { return std::sqrt(squared_norm()); }

  constexpr ScreenVector operator-() const { return {-x_, -y_}; }
  constexpr bool operator==(const ScreenVector&) const = default;
  friend constexpr ScreenVector operator+(const ScreenVector& a, const ScreenVector& b) {
    return {a.x_ + b.x_, a.y_ + b.y_};
  }
  friend constexpr ScreenVector operator-(const ScreenVector& a, const ScreenVector& b) {
    return {a.x_ - b.x_, a.y_ - b.y_};
  }
  friend constexpr ScreenVector operator*(double s, const ScreenVector& v) {
    return {s * v.x_, s * v.y_};
  }
  friend constexpr ScreenVector operator*(const ScreenVector& v, double s) { return s * v; }
  friend constexpr ScreenVector operator/(const ScreenVector& v, double s) {
    return {v.x_ / s, v.y_ / s};
  }

 private:
  double x_ = 0, y_ = 0;
};

/// A place on screen, pixels of the framebuffer; (0, 0) is the top left corner.
class ScreenPoint {
 public:
  constexpr ScreenPoint() = default;
  constexpr ScreenPoint(double x, double y) : x_(x), y_(y) {}
  /// From an ImVec2 or a similar type.
  template <class V>
  requires requires(const V& v) { v.x + v.y; }
  constexpr explicit ScreenPoint(const V& v)
      : x_(static_cast<double>(v.x)), y_(static_cast<double>(v.y)) {}
  template <class V>
  requires requires(V& v) { v.x = v.y = 1.0f; }
  constexpr explicit operator V() const {
    return V(static_cast<float>(x_), static_cast<float>(y_));
  }

  constexpr double x() const { return x_; }
  constexpr double y() const { return y_; }
  constexpr double operator[](int axis) const { return axis == 0 ? x_ : y_; }

  constexpr bool operator==(const ScreenPoint&) const = default;
  friend constexpr ScreenVector operator-(const ScreenPoint& a, const ScreenPoint& b) {
    return {a.x_ - b.x_, a.y_ - b.y_};
  }
  friend constexpr ScreenPoint operator+(const ScreenPoint& p, const ScreenVector& v) {
    return {p.x_ + v.x(), p.y_ + v.y()};
  }
  friend constexpr ScreenPoint operator-(const ScreenPoint& p, const ScreenVector& v) {
    return {p.x_ - v.x(), p.y_ - v.y()};
  }

 private:
  double x_ = 0, y_ = 0;
};

constexpr ScreenPoint midpoint(const ScreenPoint& a, const ScreenPoint& b) {
  return {0.5 * (a.x() + b.x()), 0.5 * (a.y() + b.y())};
}

/// Distance of a point from the segment between two others, pixels.
inline double distance_to_segment(const ScreenPoint& p, const ScreenPoint& a,
                                  const ScreenPoint& b) {
  const ScreenVector along = b - a;
  const double t = std::clamp((p - a).dot(along) / std::max(along.squared_norm(), 1e-30), 0.0, 1.0);
  return (p - a - t * along).norm();
}

// For points on screen and in the plane.

/// True if the segment from a to b crosses the ray from p to the right. A polygon contains p if an
/// odd number of its sides do.
template <class Point>
bool right_of(const Point& p, const Point& a, const Point& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > p.x();
}

/// The part of the segment from a to b inside a box, as fractions of its length (Liang and Barsky);
/// none: the segment misses the box.
template <class Point, class Box>
std::optional<std::array<double, 2>> part_within(const Point& a, const Point& b, const Box& box) {
  double first = 0, last = 1;
  for (const int axis : {0, 1}) {
    const double by = b[axis] - a[axis];
    if (by == 0) {
      if (a[axis] < box.min[axis] || a[axis] > box.max[axis]) return std::nullopt;
      continue;
    }
    const auto [near, far] =
        std::minmax({(box.min[axis] - a[axis]) / by, (box.max[axis] - a[axis]) / by});
    first = std::max(first, near);
    last = std::min(last, far);
  }
  return first <= last ? std::optional(std::array{first, last}) : std::nullopt;
}

/// A rectangle on screen.
struct ScreenBox {
  ScreenPoint min, max;

  constexpr ScreenVector size() const { return max - min; }
  constexpr ScreenPoint centre() const { return midpoint(min, max); }
  /// Includes the upper and left sides, but not the others.
  constexpr bool contains(const ScreenPoint& p) const {
    return p.x() >= min.x() && p.y() >= min.y() && p.x() < max.x() && p.y() < max.y();
  }
  constexpr bool operator==(const ScreenBox&) const = default;
};

}  // namespace winslow::gui
