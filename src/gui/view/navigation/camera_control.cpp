#include "gui/view/navigation/camera_control.h"

#include "gui/view/mesh/volume_layer.h"

namespace winslow::gui {

namespace {

/// Box around an item of the open mesh and what touches the item; in the plane z = 0.
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
  // The node itself stays in the middle, even if its neighbours lie on one side.
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
      return view_.fit({bodies.min - room, bodies.max + room});
    }
  }
  view_.fit(all);
}

void PlaneControl::fit(std::span<const Index> nodes, double margin) {
  view_.fit(bounds(session_.coordinates(), nodes), margin);
}

void PlaneControl::fit_all() {
  view_.fit(bounds(Mesh{session_.topology(), session_.coordinates()}));
}

void PlaneControl::fit_bodies() {
  constexpr double margin = 0.1;
  if (const std::vector<Index> nodes = body_nodes(); !nodes.empty()) fit(nodes, margin);
}

void PlaneControl::look_around(const Vec3& point, double radius) {
  const Vec2 middle = point.head<2>(), half = Vec2::Constant(radius);
  view_.fit({middle - half, middle + half});
}

/// The nodes of all holes.
std::vector<Index> PlaneControl::body_nodes() const {
  std::vector<Index> nodes;
  if (!session_.mesh().boundary()) return nodes;
  for (const auto& body : session_.mesh().boundary()->bodies())
    if (body.hole) nodes.insert(nodes.end(), body.nodes.begin(), body.nodes.end());
  return nodes;
}

namespace {

constexpr double opening = 30;  // degrees, of a perspective view

Box<3> around(const Vec3& point, double radius) {
  const Vec3 half = Vec3::Constant(radius);
  return {point - half, point + half};
}

std::vector<Plane> planes_of(const std::vector<CutPlane>& cuts) {
  std::vector<Plane> planes;
  for (const CutPlane& cut : cuts)
    if (cut.on) planes.push_back(plane_of(cut));
  return planes;
}

}  // namespace

void SpaceControl::leave(const ViewOptions& options) {
  if (open_) kept_ = views(options);
  open_.reset();
}

KeptView SpaceControl::view_now(const ViewOptions& options) const {
  const ViewDirection& from = view_.direction();
  const Vec3 centre = view_.centre();
  return {open_->string(),
          {centre.x(), centre.y(), centre.z()},
          view_.units_per_pixel() * view_.viewport().size().y(),
          from.azimuth,
          from.elevation,
          from.roll,
          from.up,
          options.space.cuts,
          options.space.peel};
}

std::vector<KeptView> SpaceControl::views(const ViewOptions& options) const {
  if (!open_) return kept_;
  std::vector<KeptView> all{view_now(options)};
  for (const KeptView& view : kept_)
    if (view.mesh != all.front().mesh && all.size() < most_kept_views) all.push_back(view);
  return all;
}

void SpaceControl::begin(ViewOptions& options) {
  const Document& document = *session_.document();
  std::error_code ignored;
  open_ = std::filesystem::absolute(document.source().path, ignored);
  view_.set_content(space_bounds(document.state().mesh));
  const std::string file = open_->string();
  if (const auto kept = std::ranges::find(kept_, file, &KeptView::mesh); kept != kept_.end()) {
    options.space.cuts = kept->cuts;
    options.space.peel = kept->peel;
    view_.look_from({kept->azimuth, kept->elevation, kept->up, kept->roll});
    update(options);
    return view_.look_at(Vec3(kept->centre.data()), kept->height / view_.viewport().size().y());
  }
  options.space.cuts = first_cuts();
  options.space.peel = {};
  view_.look_from(automatic_view(planes_of(options.space.cuts), options.space.up));
  update(options);
  // With a far field of a hundred chords the bodies would be a dot.
  const Box<3> all = space_bounds(document.state().mesh);
  if (const std::vector<Index> nodes = body_nodes(); !nodes.empty()) {
    const Box<3> bodies = space_bounds(document.state().mesh.coordinates, nodes);
    if (bodies.size().maxCoeff() < 0.3 * all.size().maxCoeff()) {
      const Vec3 room = Vec3::Constant(0.35 * bodies.size().maxCoeff());
      return view_.fit(corners_of({bodies.min - room, bodies.max + room}), 0);
    }
  }
  fit_all();
}

std::vector<CutPlane> SpaceControl::first_cuts() const {
  const Document& document = *session_.document();
  std::vector<CutPlane> cuts;
  for (const Plane& plane :
       automatic_cuts(document.state().mesh, *document.boundary(), automatic_view({})))
    cuts.push_back(cut_through(plane.point(), plane.normal()));
  return cuts;
}

void SpaceControl::update(const ViewOptions& view_options) {
  const SpaceOptions& options = view_options.space;
  if (options.perspective != view_.in_perspective())
    view_.set_perspective(options.perspective ? opening : 0);
  if (options.up != view_.direction().up) look_from(direction_towards(view_.back(), options.up));
  if (!options.free_orbit && view_.direction().roll != 0) {
    ViewDirection upright = view_.direction();
    upright.roll = 0;
    look_from(upright);
  }
}

std::vector<Index> SpaceControl::body_nodes() const {
  const VolumeBoundary& boundary = *session_.document()->boundary();
  std::vector<Index> nodes;
  if (!boundary.encloses) return nodes;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (boundary.enclosing[f] == 0)
      nodes.insert(nodes.end(), boundary.faces[f].nodes.begin(), boundary.faces[f].nodes.end());
  return nodes;
}

void SpaceControl::fit(std::span<const Index> nodes, double margin) {
  if (nodes.empty()) return;
  const SpacePoints x(session_.coordinates());
  std::vector<Vec3> points;
  for (const Index node : nodes) points.push_back(x[node]);
  view_.fit(points, margin);
}

void SpaceControl::fit_all() {
  const VolumeBoundary& boundary = *session_.document()->boundary();
  std::vector<Index> nodes;
  for (const SurfaceFace& face : boundary.faces)
    nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.end());
  fit(nodes, 0.05);
}

void SpaceControl::fit_bodies() {
  const std::vector<Index> nodes = body_nodes();
  if (nodes.empty()) return fit_all();
  fit(nodes, 0.1);
}

void SpaceControl::look_around(const Vec3& point, double radius) {
  view_.fit(corners_of(around(point, radius)), 0);
}

void SpaceControl::look_from(const ViewDirection& direction) {
  view_.look_from(direction, view_.centre());
}

}  // namespace winslow::gui
