#pragma once

#include <span>
#include <string>

#include "core/memory.h"

/// Points are read and written by node:
///
///     winslow::Coordinates x = mesh.coordinates;  // of a plane mesh
///     x.set_xy(node, x.xy(node) + winslow::Vec2(0.1, 0));
namespace winslow {

/// Coordinates of all nodes: #nodes by dimension (2 or 3), node after node, in the unit of the
/// file.
///
/// xy() and the like throw UsageError for coordinates in space, xyz() for those in the plane, in
/// every build. Loops that read many points check the dimension once: see Points.
class Coordinates {
 public:
  /// No nodes, in the plane.
  Coordinates() = default;
  /// All zero. Throws UsageError for another dimension than 2 or 3.
  Coordinates(int dimension, Index node_count);

  int dimension() const { return dimension_; }
  Index size() const {
    return static_cast<Index>(values_.size() / static_cast<std::size_t>(dimension_));
  }
  bool empty() const { return values_.empty(); }
  std::size_t bytes() const { return bytes_of(values_); }
  /// Whether others are of as many nodes in the same dimension.
  bool alike(const Coordinates& other) const {
    return dimension_ == other.dimension_ && values_.size() == other.values_.size();
  }

  Vec2 xy(Index node) const { return get<2>(node); }
  void set_xy(Index node, const Vec2& p) { set<2>(node, p); }
  void push_xy(const Vec2& p) { push<2>(p); }

  Vec3 xyz(Index node) const { return get<3>(node); }
  void set_xyz(Index node, const Vec3& p) { set<3>(node, p); }
  void push_xyz(const Vec3& p) { push<3>(p); }

  /// Sets a position from a point in space; in the plane its last component is left out.
  void set_place(Index node, const Vec3& p) {
    for (int k = 0; k < dimension_; ++k)
      values_[offset(node, dimension_) + static_cast<std::size_t>(k)] = p[k];
  }

  // The same for code that is written for both dimensions.
  template <int D>
  Vec<D> get(Index node) const {
    require_dimension(D);
    return Vec<D>(values_.data() + offset(node, D));
  }
  template <int D>
  void set(Index node, const Vec<D>& p) {
    require_dimension(D);
    for (int k = 0; k < D; ++k) values_[offset(node, D) + static_cast<std::size_t>(k)] = p[k];
  }

  /// Moves a node to its position in other coordinates of the same dimension.
  void copy_node(Index node, const Coordinates& from) {
    from.require_dimension(dimension_);
    const auto first = static_cast<std::ptrdiff_t>(offset(node, dimension_));
    std::copy_n(from.values_.begin() + first, dimension_, values_.begin() + first);
  }
  /// Whether the coordinates of a node are equal in both, bit for bit.
  bool same_place(Index node, const Coordinates& other) const {
    other.require_dimension(dimension_);
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(offset(node, dimension_));
    return std::equal(first, first + dimension_, &other.values_[offset(node, dimension_)]);
  }

  /// All components in a row, as kernels and solvers read them.
  std::span<const double> values() const { return values_; }
  std::span<double> values() { return values_; }

  /// Throws UsageError unless this is the dimension.
  void require_dimension(int dimension) const {
    if (dimension_ != dimension) refuse(dimension);
  }

  bool operator==(const Coordinates&) const = default;

 private:
  static std::size_t offset(Index node, int dimension) {
    return static_cast<std::size_t>(node) * static_cast<std::size_t>(dimension);
  }
  template <int D>
  void push(const Vec<D>& p) {
    require_dimension(D);
    values_.insert(values_.end(), p.data(), p.data() + D);
  }
  [[noreturn]] void refuse(int expected) const;

  int dimension_ = 2;
  std::vector<double> values_;
};

/// Reads points without a check of the dimension, for loops that read many of them. Holds a pointer
/// into the coordinates, which must outlive it and keep their size.
template <int D>
class Points {
 public:
  static constexpr int dimension = D;

  /// Throws UsageError unless the coordinates have D dimensions.
  explicit Points(const Coordinates& x) : values_(x.values().data()) { x.require_dimension(D); }

  Vec<D> operator[](Index node) const {
    return Vec<D>(values_ + static_cast<std::ptrdiff_t>(node) * D);
  }

 private:
  const double* values_;
};
using PlanePoints = Points<2>;
using SpacePoints = Points<3>;

/// Calls visit(PlanePoints) or visit(SpacePoints) with the points of x, for code of either
/// dimension:
///
///     in_dimension(x, [&]<int D>(const Points<D>& points) { sum += points[node].norm(); });
template <typename Visit>
decltype(auto) in_dimension(const Coordinates& x, Visit&& visit) {
  if (x.dimension() == 3) return visit(SpacePoints(x));
  return visit(PlanePoints(x));
}

/// The position of a node in space; z is 0 for coordinates in the plane.
inline Vec3 place_of(const Coordinates& x, Index node) {
  Vec3 place(0, 0, 0);
  const auto n = static_cast<std::size_t>(x.dimension());
  for (std::size_t k = 0; k < n; ++k)
    place[static_cast<int>(k)] = x.values()[static_cast<std::size_t>(node) * n + k];
  return place;
}

/// Mean of at least one point.
template <int D>
Vec<D> mean_of(std::span<const Vec<D>> points) {
  Vec<D> sum = Vec<D>::Zero();
  for (const Vec<D>& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Puts a node at a place of space, one of a plane mesh below or above it.
inline void set_place(Coordinates& x, Index node, const Vec3& place) {
  const auto dimension = static_cast<std::size_t>(x.dimension());
  for (std::size_t k = 0; k < dimension; ++k)
    x.values()[static_cast<std::size_t>(node) * dimension + k] = place[static_cast<Index>(k)];
}

/// "(0.25, -1.5)": a point for messages, in six significant digits; far from the origin in more, so
/// that it can be found there.
std::string place_text(const Vec2& p);
std::string place_text(const Vec3& p);
/// The same; dimension 2 leaves out the last component.
std::string place_text(const Vec3& p, int dimension);

}  // namespace winslow
