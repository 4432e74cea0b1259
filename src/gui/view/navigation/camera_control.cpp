#include "gui/view/navigation/camera_control.h"

namespace winslow::gui {

namespace {

/// Box around an item of the open mesh and what touches it; in the plane z = 0.
Box<3> surroundings(const MeshItem& item, const Session& session) {
  const Topology& topology = *session.topology();
  const Coordinates& x = session.coordinates();
  Box<3> box = Box<3>::empty();
  const auto add = [&](const auto& nodes) {
    for (const Index node : nodes) box.add(place_of(x, node));
  };
  if (item.kind == MeshItem::Kind::element) add(topology.element(item.id));
  if (item.kind == MeshItem::Kind::face) add(topology.face(item.id).nodes);
  if (item.kind != MeshItem::Kind::node) return box;
  const Vec3 p = place_of(x, item.id);
  add(topology.neighbours(item.id));
  if (topology.neighbours(item.id).empty()) return {p, p};
  // The node itself in the middle, whatever lies on one side of it.
  const Vec3 half = (box.max - p).cwiseAbs().cwiseMax((p - box.min).cwiseAbs());
  return {p - half, p + half};
}

}  // namespace

void CameraControl::fit_markers(std::span<const Index> markers) {
  constexpr double margin = 0.15;
  std::vector<Index> nodes;
  for (const Index m : markers) {
    if (m < 0 || at(m) >= session_.topology()->markers().size()) continue;
    const auto of_marker = session_.topology()->markers().nodes(m);
    nodes.insert(nodes.end(), of_marker.begin(), of_marker.end());
  }
  if (!nodes.empty()) fit(nodes, margin);
}

void CameraControl::go_to(const MeshItem& item) {
  const Box<3> box = surroundings(item, session_);
  look_around(box.centre(), room_ * box.size().norm());
}

bool CameraControl::sees(Index node) const {
  const ScreenPoint at = view().project(place_of(session_.coordinates(), node)).at;
  return view().viewport().contains(at);
}

void CameraControl::zoom_to(const ScreenBox& box, const Vec3& depth) {
  const ScreenVector from = box.size(), to = view().viewport().size();
  const double factor = std::min(to.x() / from.x(), to.y() / from.y());
  const Vec3 middle = view().at_depth_of(depth, box.centre());
  view().pan_at(middle, view().viewport().centre() - box.centre());
  view().zoom_about(middle, factor);
}

void CameraControl::look_above(const ScreenBox& card) {
  const ScreenBox box = view().viewport();
  const ScreenVector size = box.size();
  const double free = card.min.y() - box.min.y();
  if (card.max.x() < box.min.x() + size.x() / 2 || free < size.y() / 4) return;
  const Vec3 centre = view().looked_at().centre;
  view().zoom_about(centre, std::min(size.x(), free) / std::min(size.x(), size.y()));
  view().pan_at(centre, ScreenVector(0, -(size.y() - free) / 2));
}

void PlaneControl::begin(ViewOptions& /*options*/) {
  const Mesh& mesh = session_.document()->state().mesh;
  const Bounds all = bounds(mesh);
  if (const std::vector<Index> holes = body_nodes(); !holes.empty()) {
    const Bounds bodies = bounds(mesh.coordinates, holes);
    // With a far field of a hundred chords the bodies would be a dot.
    if (bodies.size().maxCoeff() < 0.15 * all.size().maxCoeff()) {
      const Vec2 room = Vec2::Constant(0.6 * bodies.size().maxCoeff());
      return view_.camera().fit({bodies.min - room, bodies.max + room});
    }
  }
  view_.camera().fit(all);
}

void PlaneControl::fit(std::span<const Index> nodes, double margin) {
  view_.camera().fit(bounds(session_.coordinates(), nodes), margin);
}

void PlaneControl::fit_all() {
  view_.camera().fit(bounds(Mesh{session_.topology(), session_.coordinates()}));
}

void PlaneControl::fit_bodies() {
  constexpr double margin = 0.1;
  if (const std::vector<Index> nodes = body_nodes(); !nodes.empty()) fit(nodes, margin);
}

void PlaneControl::look_around(const Vec3& point, double radius) {
  const Vec2 middle = point.head<2>(), half = Vec2::Constant(radius);
  view_.camera().fit({middle - half, middle + half});
}

/// Of all holes.
std::vector<Index> PlaneControl::body_nodes() const {
  std::vector<Index> nodes;
  if (!session_.mesh().boundary()) return nodes;
  for (const auto& body : session_.mesh().boundary()->bodies())
    if (body.hole) nodes.insert(nodes.end(), body.nodes.begin(), body.nodes.end());
  return nodes;
}

}  // namespace winslow::gui
