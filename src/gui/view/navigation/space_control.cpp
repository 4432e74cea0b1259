#include "gui/view/navigation/space_control.h"

#include "gui/render/space/space_view.h"

namespace winslow::gui {

namespace {

constexpr double opening = 30;  // degrees, of a perspective view

std::vector<Vec3> corners_of(const Box<3>& box) {
  std::vector<Vec3> corners;
  for (const double x : {box.min.x(), box.max.x()})
    for (const double y : {box.min.y(), box.max.y()})
      for (const double z : {box.min.z(), box.max.z()}) corners.emplace_back(x, y, z);
  return corners;
}

Box<3> around(const Vec3& point, double radius) {
  const Vec3 half = Vec3::Constant(radius);
  return {point - half, point + half};
}

std::vector<Plane> planes_of(const std::vector<CutPlane>& cuts) {
  std::vector<Plane> planes;
  for (const CutPlane& cut : cuts)
    if (cut.on) planes.emplace_back(Vec3(cut.point.data()), Vec3(cut.normal.data()));
  return planes;
}

}  // namespace

void SpaceControl::leave(const ViewOptions& options) {
  if (open_) kept_ = views(options);
  open_.reset();
}

KeptView SpaceControl::view_now(const ViewOptions& options) const {
  const SpaceCamera& camera = view_.camera();
  const ViewDirection& from = camera.direction();
  const Vec3 centre = camera.centre();
  return {open_->string(),
          {centre.x(), centre.y(), centre.z()},
          camera.units_per_pixel() * camera.viewport().size().y(),
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
  SpaceCamera& camera = view_.camera();
  camera.set_content(space_bounds(document.state().mesh));
  const std::string file = open_->string();
  if (const auto kept = std::ranges::find(kept_, file, &KeptView::mesh); kept != kept_.end()) {
    options.space.cuts = kept->cuts;
    options.space.peel = kept->peel;
    camera.look_from({kept->azimuth, kept->elevation, kept->up, kept->roll});
    update(options);
    return camera.look_at(Vec3(kept->centre.data()), kept->height / camera.viewport().size().y());
  }
  options.space.cuts = first_cuts();
  options.space.peel = {};
  camera.look_from(automatic_view(planes_of(options.space.cuts), options.space.up));
  update(options);
  // With a far field of a hundred chords the bodies would be a dot.
  const Box<3> all = space_bounds(document.state().mesh);
  if (const std::vector<Index> nodes = body_nodes(); !nodes.empty()) {
    const Box<3> bodies = space_bounds(document.state().mesh.coordinates, nodes);
    if (bodies.size().maxCoeff() < 0.3 * all.size().maxCoeff()) {
      const Vec3 room = Vec3::Constant(0.35 * bodies.size().maxCoeff());
      return camera.fit(corners_of({bodies.min - room, bodies.max + room}), 0);
    }
  }
  fit_all();
}

std::vector<CutPlane> SpaceControl::first_cuts() const {
  const Document& document = *session_.document();
  std::vector<CutPlane> cuts;
  if (session_.kind() == MeshKind::surface) return cuts;
  for (const Plane& plane :
       automatic_cuts(document.state().mesh, *document.boundary(), automatic_view({}))) {
    CutPlane& cut = cuts.emplace_back();
    for (Index k = 0; k < 3; ++k) {
      cut.point[at(k)] = plane.point()[k];
      cut.normal[at(k)] = plane.normal()[k];
    }
  }
  return cuts;
}

void SpaceControl::update(const ViewOptions& view_options) {
  const SpaceOptions& options = view_options.space;
  SpaceCamera& camera = view_.camera();
  if (options.perspective != camera.in_perspective())
    camera.set_perspective(options.perspective ? opening : 0);
  if (options.up != camera.direction().up) look_from(direction_towards(camera.back(), options.up));
  if (!options.free_orbit && camera.direction().roll != 0) {
    ViewDirection upright = camera.direction();
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
  view_.camera().fit(points, margin);
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
  view_.camera().fit(corners_of(around(point, radius)), 0);
}

void SpaceControl::look_from(const ViewDirection& direction) {
  view_.look_from(direction, view_.camera().centre());
}

}  // namespace winslow::gui
