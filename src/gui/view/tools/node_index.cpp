#include "gui/view/tools/node_index.h"

#include <algorithm>
#include <cmath>

namespace winslow::gui {

NodeIndex::NodeIndex(const Topology& topology, Coordinates coordinates)
    : coordinates_(std::move(coordinates)) {
  for (Index node = 0; node < topology.node_count(); ++node)
    if (topology.used(node)) order_.push_back(node);
  build(0, order_.size(), 0);
}

void NodeIndex::build(std::size_t begin, std::size_t end, int axis) {
  if (end - begin < 2) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](Index a, Index b) {
    return coordinates_.point(a)[axis] < coordinates_.point(b)[axis];
  });
  build(begin, middle, 1 - axis);
  build(middle + 1, end, 1 - axis);
}

std::optional<Index> NodeIndex::nearest(const Vec2& point, double radius) const {
  double best = radius;
  std::optional<Index> node;
  search(0, order_.size(), 0, point, best, node);
  return node;
}

void NodeIndex::search(std::size_t begin, std::size_t end, int axis, const Vec2& point,
                       double& best, std::optional<Index>& node) const {
  if (begin >= end) return;
  const std::size_t middle = begin + (end - begin) / 2;
  const Index here = order_[middle];
  const Vec2 position = coordinates_.xy(here);
  const double distance = (position - point).norm();
  if (distance <= best) {
    best = distance;
    node = here;
  }
  const double beyond = point[axis] - position[axis];
  const bool low_first = beyond < 0;
  const auto visit = [&](bool low) {
    if (low)
      search(begin, middle, 1 - axis, point, best, node);
    else
      search(middle + 1, end, 1 - axis, point, best, node);
  };
  visit(low_first);
  if (std::abs(beyond) <= best) visit(!low_first);
}

void NodePicker::collect() {
  if (auto built = worker_.poll()) built_ = std::move(*built);
}

void NodePicker::prepare(std::uint64_t shape, const std::shared_ptr<const Topology>& topology,
                         const Coordinates& coordinates) {
  collect();
  if (worker_.busy() || (built_.index && built_.shape == shape)) return;
  worker_.start([shape, topology, coordinates] {
    return Built{shape, std::make_shared<const NodeIndex>(*topology, coordinates)};
  });
}

std::optional<Index> NodePicker::pick(std::uint64_t shape, const Topology& topology,
                                      const Coordinates& coordinates, const Vec2& point,
                                      double radius) {
  collect();
  if (built_.index && built_.shape == shape) return built_.index->nearest(point, radius);
  std::optional<Index> nearest;
  double best = radius;
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (!topology.used(node)) continue;
    const double distance = (coordinates.xy(node) - point).norm();
    if (distance > best) continue;
    best = distance;
    nearest = node;
  }
  return nearest;
}

}  // namespace winslow::gui
