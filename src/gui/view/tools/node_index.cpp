#include "gui/view/tools/node_index.h"

namespace winslow::gui {

NodeIndex::NodeIndex(const Topology& topology, const Coordinates& coordinates) {
  std::vector<Vec2> places;
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (!topology.used(node)) continue;
    nodes_.push_back(node);
    places.push_back(coordinates.xy(node));
  }
  tree_ = BoxTree<2>(places);
}

std::optional<Index> NodeIndex::nearest(const Vec2& point, double radius) const {
  const auto found = tree_.nearest(point, radius);
  if (!found) return std::nullopt;
  return nodes_[static_cast<std::size_t>(found->item)];
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
    if (distance > best || (nearest && distance == best)) continue;
    best = distance;
    nearest = node;
  }
  return nearest;
}

}  // namespace winslow::gui
