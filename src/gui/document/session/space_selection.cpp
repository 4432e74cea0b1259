#include "gui/document/session/space_selection.h"

#include "core/mesh/surface_faces.h"
#include "core/motion/rigid_motion.h"

namespace winslow::gui {

namespace {

/// Pivots of what a motion takes along go with it, but for those that stay with their nodes.
void move_pivot(SpacePivot& pivot, const RigidMotion& motion) {
  if (pivot.picked()) return;
  pivot.point = transform(motion, pivot.point);
  const Vec3 axis = rotated(motion, pivot.axis);
  // About itself it is turned by nothing but rounding.
  if ((axis - pivot.axis).norm() > 1e-12 * axis.norm()) pivot.axis = axis;
}

}  // namespace

Vec3 SpaceSelection::pivot() const {
  const auto motion = mesh_.live_motion();
  return motion ? transform(*motion, pivot_.point) : pivot_.point;
}

Vec3 SpaceSelection::axis() const {
  const auto motion = mesh_.live_motion();
  return motion ? rotated(*motion, pivot_.axis) : pivot_.axis;
}

std::vector<std::string> SpaceSelection::names() const {
  std::vector<std::string> names;
  for (const Index m : markers_) names.push_back(mesh_.topology()->markers()[at(m)].name);
  return names;
}

void SpaceSelection::moved(const MovingBody& body) {
  const RigidMotion motion = resolve_motion(body.motion, 3, Vec3(0, 0, 0));
  const auto goes = [&](const std::vector<Index>& markers) {
    return std::ranges::all_of(markers, [&](Index m) {
      return std::ranges::find(body.markers, mesh_.topology()->markers()[at(m)].name) !=
             body.markers.end();
    });
  };
  if (goes(markers_)) move_pivot(pivot_, motion);
  for (auto& [markers, pivot] : kept_)
    if (goes(markers)) move_pivot(pivot, motion);
}

void SpaceSelection::choose(const std::vector<Index>& markers) {
  if (!in_space(mesh_)) return;
  const bool own = pivot_.from != PivotFrom::centre || pivot_.axis != Vec3::UnitZ();
  if (!markers_.empty() && own)
    kept_[markers_] = pivot_;
  else
    kept_.erase(markers_);
  markers_ = markers;
  outline_.reset();
  if (markers_.empty()) pick_.reset();
  const auto kept = kept_.find(markers_);
  pivot_ = kept == kept_.end() ? SpacePivot() : kept->second;
}

void SpaceSelection::set_pivot(const std::optional<Vec3>& pivot) {
  pivot_.nodes.clear();
  pivot_.from = pivot ? PivotFrom::typed : PivotFrom::centre;
  if (!pivot) return place();
  const auto motion = mesh_.live_motion();
  pivot_.point = motion ? transform_back(*motion, *pivot) : *pivot;
}

void SpaceSelection::set_axis(const Vec3& axis) {
  if (!axis.allFinite() || axis.norm() == 0) return;
  // A picked axis would come back with the nodes that it was picked from.
  if (pivot_.nodes.size() > 1) {
    pivot_.nodes.clear();
    pivot_.from = PivotFrom::typed;
  }
  const auto motion = mesh_.live_motion();
  pivot_.axis = motion ? rotated(inverse(*motion), axis) : axis;
}

void SpaceSelection::set_source(const PivotSource& source) {
  if (!in_space(mesh_) || markers_.empty()) return;
  const auto pivot = pivot_at(source, mesh_.document()->state().mesh.coordinates, pivot_.axis);
  if (!pivot) {
    messages_.tell(Notice::Kind::warning, "That has no direction: its nodes lie on one another.");
    return;
  }
  pivot_ = *pivot;
  pick_.reset();
}

void SpaceSelection::wait_for(const action::PickPivot& pick) {
  pick_.reset();
  if (pick.from && in_space(mesh_) && !markers_.empty()) pick_ = pick;
}

void SpaceSelection::follow_nodes() {
  if (pivot_.picked()) place();
}

void SpaceSelection::place() {
  if (!in_space(mesh_)) return;
  if (pivot_.picked()) {
    const Mesh& mesh = mesh_.document()->state().mesh;
    const auto pivot = pivot_at({pivot_.from, pivot_.nodes}, mesh.coordinates, pivot_.axis);
    if (pivot) pivot_ = *pivot;
    return;
  }
  if (markers_.empty() || pivot_.from != PivotFrom::centre) return;
  // The very point of commands without a pivot.
  pivot_.point = centre();
}

Vec3 SpaceSelection::centre() const {
  if (!in_space(mesh_)) return Vec3::Zero();
  const Mesh& mesh = mesh_.document()->state().mesh;
  const std::vector<Index> nodes = mesh.topology->markers().nodes_of(names());
  return nodes.empty() ? Vec3(Vec3::Zero()) : body_centre(space_bounds(mesh.coordinates, nodes));
}

void SpaceSelection::clear() {
  markers_.clear();
  pivot_ = {};
  kept_.clear();
  pick_.reset();
  outline_.reset();
  held_.reset();
}

/// All edges would be a blot: of those that are not sharp a few, spread over the surface.
const std::vector<std::array<Index, 2>>& SpaceSelection::outline() const {
  constexpr std::size_t most_faces = 100;
  constexpr double sharp_angle = 40;  // degrees
  if (outline_) return *outline_;
  outline_.emplace();
  std::vector<SurfaceFace> faces;
  for (const SurfaceFace& face : mesh_.document()->boundary()->faces)
    if (std::ranges::binary_search(markers_, face.marker)) faces.push_back(face);
  const SpacePoints x(mesh_.coordinates());
  const SurfaceEdges edges = surface_edges(faces);
  const std::vector<unsigned char> sharp = feature_edges(x, faces, edges, sharp_angle);
  for (std::size_t k = 0; k < sharp.size(); ++k)
    if (sharp[k] != 0) outline_->push_back(edges.nodes[k]);
  const std::size_t step = faces.size() / most_faces + 1;
  for (std::size_t f = 0; f < faces.size(); f += step)
    for (std::size_t c = 0; c < faces[f].nodes.size(); ++c)
      outline_->push_back({faces[f].nodes[c], faces[f].nodes[(c + 1) % faces[f].nodes.size()]});
  return *outline_;
}

const SpaceSelection::HeldPatch* SpaceSelection::held(const ShapeEdit& edit) const {
  const auto& patch = edit.patch;
  if (!patch || patch->nodes.empty() || !in_space(mesh_)) return nullptr;
  const std::uint64_t revision = mesh_.document()->edits().revision();
  if (held_ && held_->patch == *patch && held_->radius == edit.radius &&
      held_->revision == revision)
    return &held_->held;
  const Mesh& mesh = mesh_.document()->state().mesh;
  HeldPatch held;
  held.grip = grip_of(*patch, edit.radius, mesh);
  for (const Index node : patch->nodes) held.centre += mesh.coordinates.xyz(node);
  held.centre /= static_cast<double>(patch->nodes.size());
  const SpacePoints x(mesh.coordinates);
  Vec3 whole(0, 0, 0), around(0, 0, 0);  // of faces that are held, and of those that touch them
  for (const Index m : patch->markers)
    for (const Face& face : mesh.topology->markers()[at(m)].faces) {
      const auto n = std::ranges::count_if(face, [&](Index node) { return patch->contains(node); });
      if (n == 0) continue;
      const Vec3 area = area_vector(x, face);
      around += area;
      if (static_cast<std::size_t>(n) == face.size()) whole += area;
    }
  if (whole.norm() > 0)
    held.normal = whole.normalized();
  else if (around.norm() > 0)
    held.normal = around.normalized();
  held_ = MadePatch{*patch, edit.radius, revision, std::move(held)};
  return &held_->held;
}

double smallest_marker(const Mesh& mesh) {
  double size = std::numeric_limits<double>::max();
  const auto& markers = mesh.topology->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto nodes = markers.nodes(static_cast<Index>(m));
    if (!nodes.empty())
      size = std::min(size, space_bounds(mesh.coordinates, nodes).size().maxCoeff());
  }
  return size;
}

}  // namespace winslow::gui
