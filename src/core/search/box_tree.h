#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/types.h"

/// The box around a plane mesh:
///
///     const winslow::Box<2> box = winslow::bounds(mesh);
///     std::printf("%g wide\n", box.size().x());
namespace winslow {

/// An axis-aligned box in D dimensions, with its faces. It may be degenerate: a point, a segment, a
/// rectangle in space.
template <int D>
struct Box {
  Vec<D> min = Vec<D>::Zero();
  Vec<D> max = Vec<D>::Zero();

  /// The box without points, the neutral element of add().
  static Box empty() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Vec<D>::Constant(infinity), Vec<D>::Constant(-infinity)};
  }

  /// The box around points.
  template <class Points>
  static Box around(const Points& points) {
    Box box = empty();
    for (const Vec<D>& p : points) box.add(p);
    return box;
  }

  Vec<D> centre() const { return 0.5 * (min + max); }
  Vec<D> size() const { return max - min; }

  /// Enlarges the box to contain the point, or the other box.
  void add(const Vec<D>& point) { add(Box{point, point}); }
  void add(const Box& other) {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }

  /// Whether the boxes have a common point.
  bool overlaps(const Box& other) const {
    return (min.array() <= other.max.array()).all() && (other.min.array() <= max.array()).all();
  }
  /// Euclidean distance from a point to the nearest point of the box; 0 for points of the box.
  double distance(const Vec<D>& point) const { return std::sqrt(squared_distance(point)); }
  double squared_distance(const Vec<D>& point) const {
    return (point - point.cwiseMax(min).cwiseMin(max)).squaredNorm();
  }

  bool operator==(const Box&) const = default;
};

/// The points origin + t direction with t >= 0.
template <int D>
struct Ray {
  Vec<D> origin;
  Vec<D> direction;  ///< of any length except 0
};

/// A bounding-volume hierarchy: finds items by their axis-aligned boxes, in the plane (D = 2) and
/// in space (D = 3). Items are numbers from 0 on; the caller knows what they are. The tree depends
/// on the boxes alone. Among equally near items the search returns the lowest.
template <int D>
class BoxTree {
 public:
  /// A tree without items.
  BoxTree() = default;
  /// boxes: one for each item, finite.
  explicit BoxTree(std::span<const Box<D>> boxes);
  /// Items that are points: as boxes {point, point}, in half the memory.
  explicit BoxTree(std::span<const Vec<D>> points);

  /// Updates the boxes of items that have moved. boxes: as many as before. This is much faster than
  /// a new tree, and searches stay fast as long as neighbours have stayed neighbours.
  void refit(std::span<const Box<D>> boxes);

  Index size() const { return static_cast<Index>(items_.size()); }

  struct Nearest {
    Index item = -1;
    double distance = 0;
  };
  /// Distance of an item from the point of the search; not less than that of its box, up to
  /// round-off.
  using Distance = std::function<double(Index)>;
  /// The item nearest to a point within `radius`.
  std::optional<Nearest> nearest(const Vec<D>& point, double radius,
                                 const Distance& distance) const;
  /// The same for items that are identical to their boxes, such as points.
  std::optional<Nearest> nearest(const Vec<D>& point, double radius) const;

  /// Calls `visit` with every item whose box has a common point with the given one, in the order of
  /// the tree.
  void overlapping(const Box<D>& box, const std::function<void(Index)>& visit) const;

  struct RayHit {
    Index item = -1;
    double t = 0;  ///< parameter along the ray
  };
  /// The parameter at which the ray hits an item, if it does.
  using Intersection = std::function<std::optional<double>(Index)>;
  /// The items that a ray hits, in the order along the ray. Calls `intersection` only for items
  /// whose boxes the ray passes.
  std::vector<RayHit> hits(const Ray<D>& ray, const Intersection& intersection) const;

 private:
  struct Entry;
  struct Spot;
  struct ByCaller;
  template <bool points>
  struct ByPlace;

  template <class PlaceOf>
  void build(std::size_t count, const PlaceOf& place_of);
  void split(std::span<Entry> entries, const Box<D>& places, int level);
  void fit();
  Box<D> box(Index place) const;
  Spot root() const;
  template <class Measure>
  void search(const Spot& spot, const Measure& measure, Nearest& best) const;
  /// Calls `visit` with every item unless `misses` is true for its box or that of a node above it.
  template <class Misses, class Visit>
  void descend(const Misses& misses, const Visit& visit) const;

  int depth_ = 0;              // of the leaves, which are all equally deep
  std::vector<Box<D>> nodes_;  // from 1 on; the children of i are 2 i and 2 i + 1
  std::vector<Index> items_;   // each node has a range, and each of its children one half of it
  std::vector<Vec<D>> lower_;  // of the boxes of items_
  std::vector<Vec<D>> upper_;  // empty if all of them are points
};

extern template class BoxTree<2>;
extern template class BoxTree<3>;

/// Distance from a point to the segment between two others, which may be equal.
template <int D>
double segment_distance(const Vec<D>& p, const Vec<D>& a, const Vec<D>& b) {
  const Vec<D> along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * along)).norm();
}

}  // namespace winslow
