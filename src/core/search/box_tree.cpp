#include "core/search/box_tree.h"

#include <array>
#include <tuple>
#include <utility>

namespace winslow {

namespace {

/// Largest number of items of a leaf. A loop over so many boxes is faster than another level.
constexpr std::size_t leaf_size = 8;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Whether the ray passes the box, which is enlarged by a few units of round-off.
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

/// An item while the tree is built.
template <int D>
struct BoxTree<D>::Entry {
  std::array<std::uint32_t, D> place;  // the centre of its box on a grid over all of them
  Index item;

  /// Equal places are ordered by item, so that the tree does not depend on the standard library.
  std::uint64_t key(std::size_t axis) const {
    return (std::uint64_t{place[axis]} << 32) | static_cast<std::uint32_t>(item);
  }
};

/// A node with its range of items.
template <int D>
struct BoxTree<D>::Spot {
  Index node, begin, end;
  int level;

  Spot first() const { return {2 * node, begin, begin + (end - begin) / 2, level + 1}; }
  Spot second() const { return {2 * node + 1, begin + (end - begin) / 2, end, level + 1}; }
};

template <int D>
auto BoxTree<D>::root() const -> Spot {
  return {1, 0, size(), 0};
}

template <int D>
BoxTree<D>::BoxTree(std::span<const Box<D>> boxes) {
  build(boxes.size(), [&](std::size_t i) -> Vec<D> { return boxes[i].min + boxes[i].max; });
  refit(boxes);
}

template <int D>
BoxTree<D>::BoxTree(std::span<const Vec<D>> points) {
  build(points.size(), [&](std::size_t i) -> const Vec<D>& { return points[i]; });
  for (std::size_t i = 0; i < items_.size(); ++i) lower_[i] = points[at(items_[i])];
  fit();
}

/// place_of(i): the centre of the box of item i, or twice the centre.
template <int D>
template <class PlaceOf>
void BoxTree<D>::build(std::size_t count, const PlaceOf& place_of) {
  if (count == 0) return;
  Box<D> all = Box<D>::empty();
  for (std::size_t i = 0; i < count; ++i) all.add(place_of(i));
  const double extent = all.size().maxCoeff();
  const bool spread = extent > 0 && extent < infinity;
  const double cells = spread ? std::numeric_limits<std::uint32_t>::max() / extent : 0;
  std::vector<Entry> entries(count);
  for (std::size_t i = 0; i < count; ++i) {
    entries[i].item = static_cast<Index>(i);
    const Vec<D> place = place_of(i) - all.min;
    for (int k = 0; k < D && spread; ++k)
      entries[i].place[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(cells * place[k]);
  }
  while ((count - 1) >> depth_ >= leaf_size) ++depth_;
  nodes_.resize(std::size_t{2} << depth_);
  items_.reserve(count);
  lower_.resize(count);
  split(entries, {Vec<D>::Zero(), (all.size() * cells).eval()}, 0);
}

/// places: a box around the places of the entries.
template <int D>
void BoxTree<D>::split(std::span<Entry> entries, const Box<D>& places, int level) {
  if (level == depth_) {
    std::ranges::sort(entries, {}, &Entry::item);
    for (const Entry& entry : entries) items_.push_back(entry.item);
    return;
  }
  Eigen::Index longest = 0;
  places.size().maxCoeff(&longest);
  const std::size_t axis = static_cast<std::size_t>(longest), half = entries.size() / 2;
  const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(entries.begin(), middle, entries.end(),
                   [axis](const Entry& a, const Entry& b) { return a.key(axis) < b.key(axis); });
  Box<D> below = places, above = places;
  below.max[longest] = above.min[longest] = middle->place[axis];
  split(entries.first(half), below, level + 1);
  split(entries.subspan(half), above, level + 1);
}

template <int D>
void BoxTree<D>::refit(std::span<const Box<D>> boxes) {
  upper_.resize(items_.size());
  for (std::size_t i = 0; i < items_.size(); ++i) {
    lower_[i] = boxes[at(items_[i])].min;
    upper_[i] = boxes[at(items_[i])].max;
  }
  fit();
}

/// Computes the boxes of the nodes from those of the items.
template <int D>
void BoxTree<D>::fit() {
  std::vector<Spot> open;
  if (!items_.empty()) open.push_back(root());
  while (!open.empty()) {
    const Spot spot = open.back();
    open.pop_back();
    if (spot.level < depth_) {
      open.push_back(spot.second());
      open.push_back(spot.first());
      continue;
    }
    Box<D> leaf = Box<D>::empty();
    for (Index i = spot.begin; i < spot.end; ++i) leaf.add(box(i));
    nodes_[at(spot.node)] = leaf;
  }
  for (std::size_t i = nodes_.size() / 2; i-- > 1;) {
    nodes_[i] = nodes_[2 * i];
    nodes_[i].add(nodes_[2 * i + 1]);
  }
}

template <int D>
Box<D> BoxTree<D>::box(Index place) const {
  return {lower_[at(place)], upper_.empty() ? lower_[at(place)] : upper_[at(place)]};
}

template <int D>
template <class Measure>
void BoxTree<D>::search(const Spot& spot, const Measure& measure, Nearest& best) const {
  if (spot.level == depth_) {
    for (Index i = spot.begin; i < spot.end; ++i) {
      const double d = measure.of_item(i, best.distance);
      if (!(d <= best.distance)) continue;
      const Index item = items_[at(i)];
      if (d < best.distance || best.item < 0 || item < best.item) best = {item, d};
    }
    return;
  }
  const Spot first = spot.first(), second = spot.second();
  const double to_first = nodes_[at(first.node)].squared_distance(measure.point);
  const double to_second = nodes_[at(second.node)].squared_distance(measure.point);
  const bool swap = to_second < to_first;
  if (!((swap ? to_second : to_first) <= measure.square(best.distance))) return;
  search(swap ? second : first, measure, best);
  if (!((swap ? to_first : to_second) <= measure.square(best.distance))) return;
  search(swap ? first : second, measure, best);
}

/// Distances computed by the caller's function.
template <int D>
struct BoxTree<D>::ByCaller {
  const BoxTree& tree;
  const Vec<D>& point;
  const Distance& distance;

  /// Upper bound of all squares whose rounded root is `length`.
  static double square(double length) { return length * length * (1 + 4 * epsilon); }
  double of_item(Index place, double best) const {
    if (tree.box(place).squared_distance(point) > square(best)) return infinity;
    return distance(tree.items_[at(place)]);
  }
};

/// Squared distances of the boxes.
template <int D>
template <bool points>
struct BoxTree<D>::ByPlace {
  const BoxTree& tree;
  const Vec<D>& point;

  static double square(double already) { return already; }
  double of_item(Index place, double) const {
    if constexpr (points) return (point - tree.lower_[at(place)]).squaredNorm();
    return tree.box(place).squared_distance(point);
  }
};

template <int D>
auto BoxTree<D>::nearest(const Vec<D>& point, double radius, const Distance& distance) const
    -> std::optional<Nearest> {
  Nearest best{-1, radius};
  if (!items_.empty()) search(root(), ByCaller{*this, point, distance}, best);
  return best.item < 0 ? std::nullopt : std::optional(best);
}

template <int D>
auto BoxTree<D>::nearest(const Vec<D>& point, double radius) const -> std::optional<Nearest> {
  if (items_.empty()) return std::nullopt;
  Nearest best{-1, ByCaller::square(radius)};
  if (upper_.empty()) {
    search(root(), ByPlace<true>{*this, point}, best);
  } else {
    search(root(), ByPlace<false>{*this, point}, best);
  }
  best.distance = std::sqrt(best.distance);
  return best.item < 0 || best.distance > radius ? std::nullopt : std::optional(best);
}

template <int D>
template <class Misses, class Visit>
void BoxTree<D>::descend(const Misses& misses, const Visit& visit) const {
  std::vector<Spot> open;
  if (!items_.empty()) open.push_back(root());
  while (!open.empty()) {
    const Spot spot = open.back();
    open.pop_back();
    if (misses(nodes_[at(spot.node)])) continue;
    if (spot.level < depth_) {
      open.push_back(spot.second());
      open.push_back(spot.first());
      continue;
    }
    for (Index i = spot.begin; i < spot.end; ++i)
      if (!misses(box(i))) visit(items_[at(i)]);
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
