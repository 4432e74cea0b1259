#include "gui/view/tools/plane_picker.h"

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

constexpr double snap_radius = 14;  // framebuffer pixels at scale 1

/// Length of so many pixels, in units of the mesh.
double reach(double pixels, const PointerFrame& frame) {
  return pixels * frame.scene.scale * frame.view.pixel_size(Vec3(0, 0, 0));
}

/// False if any marker of a body is exempt from the mouse: a body is picked whole or not at all.
bool free_to_take(const std::vector<Index>& markers, const ViewportScene& scene) {
  return std::ranges::none_of(
      markers, [&](Index m) { return std::ranges::binary_search(scene.taken_out, m); });
}

bool encloses(std::span<const Index> corners, const Coordinates& x, const Vec2& point) {
  // The crossing rule, which works for either orientation of the element.
  bool inside = false;
  for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++)
    if (right_of<Vec2>(point, x.xy(corners[k]), x.xy(corners[last]))) inside = !inside;
  return inside;
}

std::optional<Index> element_at(const Session& session, const Vec2& point) {
  const Topology& topology = *session.topology();
  for (Index e = 0; e < topology.element_count(); ++e)
    if (encloses(topology.element(e), session.coordinates(), point)) return e;
  return std::nullopt;
}

const BoundaryIndex& boundary_of(const PointerFrame& frame) {
  return *frame.scene.session.mesh().boundary();
}

const ShapeEdit& edit_of(const PointerFrame& frame) {
  return frame.scene.session.selection().shape_edit();
}

}  // namespace

/// Copies the coordinates only if they are to be indexed anew.
std::optional<Index> PlanePicker::node_near(const ScreenPoint& at, const PointerFrame& frame) {
  const Session& session = frame.scene.session;
  if (!session.in_motion())
    nodes_.prepare(session.shape(), session.topology(), session.coordinates());
  return nodes_.pick(session.shape(), *session.topology(), session.coordinates(),
                     frame.view.to_plane(at), reach(node_radius, frame));
}

void PlanePicker::forget() {
  hit_.reset();
  corner_.reset();
}

void PlanePicker::find(const PointerFrame& frame, bool handled) {
  forget();
  if (!frame.scene.session.document()) return;
  const ScreenPoint& at = frame.pointer.position;
  if (frame.picks_nodes()) found_.node = node_near(at, frame);
  if (frame.scene.look_only) return;
  const BoundaryIndex& boundary = boundary_of(frame);
  const Vec2 there = frame.view.to_plane(at);
  if (edit_of(frame).active) corner_ = boundary.pick_node(there, reach(node_radius, frame));
  if (corner_ && !free_to_take(boundary.bodies()[static_cast<std::size_t>(corner_->body)].markers,
                               frame.scene))
    corner_.reset();
  if (corner_)
    found_.held = {corner_->node};
  else if (!handled)
    hit_ = boundary.pick(there, reach(boundary_radius, frame));
  if (hit_ && !free_to_take(hit_->markers, frame.scene)) hit_.reset();
  if (hit_) found_.markers = hit_->markers;
}

std::optional<Vec3> PlanePicker::point(const PointerFrame& frame) const { return middle(frame); }

Vec3 PlanePicker::middle(const PointerFrame& frame) const {
  return place_in_plane(frame.view.to_plane(frame.pointer.position));
}

std::optional<Vec3> PlanePicker::grab(const PointerFrame& frame) {
  const Selection& selection = frame.scene.session.selection();
  const ShapeEdit& edit = selection.shape_edit();
  if (corner_) {
    if (!edit.arc || edit.arc->body != corner_->body || !edit.arc->contains(corner_->position))
      hold(false, frame);
    return place_in_plane(boundary_of(frame).position(corner_->node));
  }
  // Shapes are edited by their nodes; the rim around the mesh moves only if it was selected first:
  // a drag that starts on it by accident pans.
  if (!hit_ || edit.active) return std::nullopt;
  const bool selected = std::ranges::includes(selection.markers(), hit_->markers);
  if (!selected && !hit_->hole) return std::nullopt;
  if (!selected) frame.actions.emplace_back(action::SelectMarkers{hit_->markers, false});
  return selection.space_pivot();
}

/// Holds the node under the mouse, or extends the held arc to it.
void PlanePicker::hold(bool extend, const PointerFrame& frame) const {
  const auto& held = edit_of(frame).arc;
  BoundaryArc arc{corner_->body, corner_->position, corner_->position};
  if (extend && held && held->body == corner_->body)
    arc =
        extended(*held, corner_->position,
                 boundary_of(frame).bodies()[static_cast<std::size_t>(corner_->body)].nodes.size());
  frame.actions.emplace_back(action::SelectArc{arc});
}

bool PlanePicker::inspect(const PointerFrame& frame) const {
  if (found_.node) frame.actions.emplace_back(action::InspectNode{*found_.node});
  return found_.node.has_value();
}

void PlanePicker::click(const PointerFrame& frame) const {
  const bool add = frame.pointer.shift || frame.pointer.control;
  ActionQueue& actions = frame.actions;
  if (inspect(frame)) return;
  if (hit_) {
    actions.emplace_back(action::SelectMarkers{hit_->markers, add});
    return;
  }
  if (corner_) return hold(add, frame);
  if (frame.picks_nodes())
    actions.emplace_back(action::Remark{"No node is there. Click nearer to one, or zoom in."});
  if (add) return;
  if (!edit_of(frame).active)
    actions.emplace_back(action::SelectMarkers{{}, false});
  else if (edit_of(frame).arc)
    actions.emplace_back(action::SelectArc{});
  else
    actions.emplace_back(
        action::Remark{"No boundary node is there. Take one of the dots; zoom in where they are "
                       "close together. Esc ends the editing of nodes."});
}

std::optional<RulerPoint> PlanePicker::ruler_point(const PointerFrame& frame) {
  const PointerState& p = frame.pointer;
  if (!p.over) return std::nullopt;
  if (const auto node = p.shift ? std::nullopt : node_near(p.position, frame))
    return RulerPoint{place_in_plane(frame.scene.session.coordinates().xy(*node)), node, {}};
  return RulerPoint{middle(frame), {}, {}};
}

PickedPlace PlanePicker::place_at(const ScreenPoint& at, const PointerFrame& frame) {
  PickedPlace place;
  const Session& session = frame.scene.session;
  if (!session.document()) return place;
  const Vec2 point = frame.view.to_plane(at);
  place.point = point;
  place.node = node_near(at, frame);
  place.element = element_at(session, point);
  const auto hit = boundary_of(frame).pick(point, reach(boundary_radius, frame));
  if (!hit) return place;
  const auto& markers = session.topology()->markers();
  const auto hidden = [&](Index m) {
    return frame.scene.options.markers.of(markers[static_cast<std::size_t>(m)].name).hidden;
  };
  place.markers = hit->markers;
  if (std::ranges::all_of(place.markers, hidden)) place.markers.clear();
  return place;
}

PlanePicker::PivotPlacing PlanePicker::place_pivot(const PointerFrame& frame) {
  const Vec2 mouse = frame.view.to_plane(frame.pointer.position);
  PivotPlacing placing{mouse, {}};
  if (!frame.pointer.control) return placing;
  double best = reach(snap_radius, frame);
  const auto try_point = [&](const Vec2& point, const std::string& name) {
    if ((point - mouse).norm() >= best) return;
    best = (point - mouse).norm();
    placing = {point, name};
  };
  // Named points attract more strongly: a leading edge has nodes close by, and is a node itself.
  if (const auto& anchors = frame.scene.session.selection().anchors())
    for (const PivotPlace place : {PivotPlace::leading_edge, PivotPlace::trailing_edge,
                                   PivotPlace::centroid, PivotPlace::centre})
      try_point(anchors->point(place), pivot_place_name(place));
  if (const auto hit = boundary_of(frame).pick_node(mouse, 0.5 * best))
    try_point(boundary_of(frame).position(hit->node), "node " + std::to_string(hit->node));
  return placing;
}

}  // namespace winslow::gui
