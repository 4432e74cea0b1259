#include "core/search/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace winslow {

namespace {

/// Below it a node is a leaf: looking at so many boxes in a row is faster than another level.
constexpr Index leaf_size = 8;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Some of the ray's points lie in the box. Errs on the side of true by a few units of round-off.
template <int D>
bool passes(const Ray<D>& ray, const Box<D>& box) {
  constexpr double wider = 1 + 8 * epsilon;
  double enter = 0, leave = infinity;
  for (int axis = 0; axis < D; ++axis) {
    const double from = box.min[axis] - ray.origin[axis], to = box.max[axis] - ray.origin[axis];
    if (ray.direction[axis] == 0) {
      if (from > 0 || to < 0) return false;
      continue;
    }
    const double a = from / ray.direction[axis], b = to / ray.direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b) * wider);
  }
  return enter <= leave;
}

}  // namespace

template <int D>
struct BoxTree<D>::Entry {
  std::array<double, D> place;  // twice the centre of the box
  Index item;
};

template <int D>
BoxTree<D>::BoxTree(std::span<const Box<D>> boxes) {
  if (boxes.empty()) return;
  std::vector<Entry> entries(boxes.size());
  Box<D> places = Box<D>::empty();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec<D> place = boxes[i].min + boxes[i].max;
    places.add(place);
    std::copy_n(place.data(), D, entries[i].place.begin());
    entries[i].item = static_cast<Index>(i);
  }
  nodes_.reserve(boxes.size() / 2 + 1);
  items_.reserve(boxes.size());
  build(entries, places);
  boxes_.resize(boxes.size());
  refit(boxes);
}

template <int D>
void BoxTree<D>::build(std::span<Entry> entries, Box<D> places) {
  const std::size_t index = nodes_.size();
  const auto begin = static_cast<Index>(items_.size());
  const auto count = static_cast<Index>(entries.size());
  nodes_.push_back({{}, begin, begin + count, 0});
  if (count <= leaf_size) {
    std::ranges::sort(entries, {}, &Entry::item);
    for (const Entry& entry : entries) items_.push_back(entry.item);
    return;
  }
  Eigen::Index longest = 0;
  places.size().maxCoeff(&longest);
  const std::size_t axis = static_cast<std::size_t>(longest), half = entries.size() / 2;
  const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(half);
  // Items decide between equal places, so that the tree is the same with every standard library.
  std::nth_element(entries.begin(), middle, entries.end(), [axis](const Entry& a, const Entry& b) {
    return a.place[axis] < b.place[axis] || (a.place[axis] == b.place[axis] && a.item < b.item);
  });
  Box<D> below = places, above = places;
  below.max[longest] = above.min[longest] = middle->place[axis];
  build(entries.first(half), below);
  nodes_[index].right = static_cast<Index>(nodes_.size());
  build(entries.subspan(half), above);
}

template <int D>
Box<D> BoxTree<D>::box_of_items(const Node& leaf) const {
  Box<D> box = Box<D>::empty();
  for (Index i = leaf.begin; i < leaf.end; ++i) box.add(boxes_[at(i)]);
  return box;
}

template <int D>
void BoxTree<D>::refit(std::span<const Box<D>> boxes) {
  for (std::size_t i = 0; i < items_.size(); ++i) boxes_[i] = boxes[at(items_[i])];
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    node.box = node.right == 0 ? box_of_items(node) : nodes_[i + 1].box;
    if (node.right > 0) node.box.add(nodes_[at(node.right)].box);
  }
}

template <int D>
template <class Measure>
void BoxTree<D>::search(Index index, const Measure& measure, Nearest& best) const {
  const Node& node = nodes_[at(index)];
  if (node.right == 0) {
    for (Index i = node.begin; i < node.end; ++i) {
      const double d = measure.of_item(i, best.distance);
      const Index item = items_[at(i)];
      if (d < best.distance || (d == best.distance && (best.item < 0 || item < best.item)))
        best = {item, d};
    }
    return;
  }
  std::pair near{nodes_[at(index + 1)].box.squared_distance(measure.point), index + 1};
  std::pair far{nodes_[at(node.right)].box.squared_distance(measure.point), node.right};
  if (far.first < near.first) std::swap(near, far);
  if (near.first <= measure.square(best.distance)) search(near.second, measure, best);
  if (far.first <= measure.square(best.distance)) search(far.second, measure, best);
}

/// Distances as the caller gives them.
template <int D>
struct BoxTree<D>::ByCaller {
  const BoxTree& tree;
  const Vec<D>& point;
  const Distance& distance;

  /// Of a length that may be the square root of a square; no less.
  static double square(double length) { return length * length * (1 + 4 * epsilon); }
  double of_item(Index place, double best) const {
    if (tree.boxes_[at(place)].squared_distance(point) > square(best)) return infinity;
    return distance(tree.items_[at(place)]);
  }
};

/// Squares of the distances of the boxes.
template <int D>
struct BoxTree<D>::ByBox {
  const BoxTree& tree;
  const Vec<D>& point;

  static double square(double already) { return already; }
  double of_item(Index place, double) const {
    return tree.boxes_[at(place)].squared_distance(point);
  }
};

template <int D>
auto BoxTree<D>::nearest(const Vec<D>& point, double radius, const Distance& distance) const
    -> std::optional<Nearest> {
  Nearest best{-1, radius};
  if (!nodes_.empty()) search(0, ByCaller{*this, point, distance}, best);
  return best.item < 0 ? std::nullopt : std::optional(best);
}

template <int D>
auto BoxTree<D>::nearest(const Vec<D>& point, double radius) const -> std::optional<Nearest> {
  Nearest best{-1, ByCaller::square(radius)};
  if (!nodes_.empty()) search(0, ByBox{*this, point}, best);
  best.distance = std::sqrt(best.distance);
  return best.item < 0 || best.distance > radius ? std::nullopt : std::optional(best);
}

template <int D>
template <class Misses, class Visit>
void BoxTree<D>::descend(const Misses& misses, const Visit& visit) const {
  std::vector<Index> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const Index index = open.back();
    open.pop_back();
    const Node& node = nodes_[at(index)];
    if (misses(node.box)) continue;
    if (node.right > 0) {
      open.push_back(node.right);
      open.push_back(index + 1);
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i)
      if (!misses(boxes_[at(i)])) visit(items_[at(i)]);
  }
}

template <int D>
void BoxTree<D>::overlapping(const Box<D>& box, const std::function<void(Index)>& visit) const {
  descend([&](const Box<D>& other) { return !box.overlaps(other); }, visit);
}

template <int D>
auto BoxTree<D>::hits(const Ray<D>& ray, const Intersection& intersection) const
    -> std::vector<RayHit> {
  std::vector<RayHit> found;
  descend([&](const Box<D>& box) { return !passes(ray, box); },
          [&](Index item) {
            if (const auto t = intersection(item)) found.push_back({item, *t});
          });
  std::ranges::sort(found, [](const RayHit& a, const RayHit& b) {
    return std::tie(a.t, a.item) < std::tie(b.t, b.item);
  });
  return found;
}

template class BoxTree<2>;
template class BoxTree<3>;

}  // namespace winslow
