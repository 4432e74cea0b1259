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

namespace {

// Framebuffer pixels at scale 1.
constexpr double node_pick_radius = 10;
constexpr double click_slack = 4;

}  // namespace

std::optional<Index> NodeTool::node_at(const PointerState& pointer, double scale,
                                       const Session& session, const View& view) {
  // The coordinates are looked at, not copied, unless they are to be indexed anew.
  if (!session.in_motion())
    picker_.prepare(session.shape(), session.topology(), session.coordinates());
  const Vec2 point = view.to_plane(pointer.position);
  return picker_.pick(session.shape(), *session.topology(), session.coordinates(), point,
                      node_pick_radius * scale * view.pixel_size(point));
}

bool NodeTool::update(const PointerState& pointer, bool active, double scale,
                      const Session& session, const View& view, ActionQueue& actions) {
  const bool pressed_now = pointer.left && !was_down_;
  const bool released_now = !pointer.left && was_down_;
  was_down_ = pointer.left;
  if (!session.document()) {
    hovered_.reset();
    pressed_.reset();
    return false;
  }
  if (!pointer.left && !released_now) {
    const std::optional<Index> now =
        active && pointer.over ? node_at(pointer, scale, session, view) : std::nullopt;
    if (now != hovered_) actions.emplace_back(action::HoverNode{now});
    hovered_ = now;
  }
  if (pressed_now) {
    pressed_ = active && pointer.over ? node_at(pointer, scale, session, view) : std::nullopt;
    press_ = pointer.position;
  }
  const bool mine = pressed_.has_value();
  if (released_now && mine) {
    if ((pointer.position - press_).norm() <= click_slack * scale)
      actions.emplace_back(action::InspectNode{*pressed_});
    pressed_.reset();
  }
  return mine;
}

}  // namespace winslow::gui
