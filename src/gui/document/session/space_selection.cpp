#include <algorithm>
#include <limits>

#include "core/inspect/space/surface_faces.h"
#include "core/motion/rigid_motion.h"
#include "core/motion/space_motion.h"
#include "gui/document/session/selection.h"

/// What a selection has of its own in a volume mesh.
namespace winslow::gui {

namespace {

/// Pivots of what a motion takes along go with it, but for those that stay with their nodes.
void move_pivot(SpacePivot& pivot, const SpaceMotion& motion) {
  if (pivot.picked()) return;
  pivot.point = transform(motion, pivot.point);
  const Vec3 axis = rotated(motion, pivot.axis);
  // About itself it is turned by nothing but rounding.
  if ((axis - pivot.axis).norm() > 1e-12 * axis.norm()) pivot.axis = axis;
}

}  // namespace

Vec3 Selection::space_pivot() const {
  const auto motion = live_space_motion(mesh_);
  return motion ? transform(*motion, space_pivot_.point) : space_pivot_.point;
}

Vec3 Selection::space_axis() const {
  const auto motion = live_space_motion(mesh_);
  return motion ? rotated(*motion, space_pivot_.axis) : space_pivot_.axis;
}

/// Motions that were carried out name their pivots.
void Selection::moved(const MoveCommand& move) {
  if (!in_space(mesh_)) {
    pivot_ = transform(move.motion.about(Vec2(0, 0)), pivot_);
    return;
  }
  const SpaceMotion motion = move.motion.in_space(Vec3(0, 0, 0));
  const auto goes = [&](const std::vector<Index>& markers) {
    return std::ranges::all_of(markers, [&](Index m) {
      return std::ranges::find(move.markers, mesh_.topology()->markers()[at(m)].name) !=
             move.markers.end();
    });
  };
  if (goes(markers_)) move_pivot(space_pivot_, motion);
  for (auto& [markers, pivot] : space_pivots_)
    if (goes(markers)) move_pivot(pivot, motion);
}

void Selection::keep_space_pivot() {
  if (!in_space(mesh_) || markers_.empty()) return;
  if (space_pivot_.from == PivotFrom::centre && space_pivot_.axis == Vec3::UnitZ())
    space_pivots_.erase(markers_);
  else
    space_pivots_[markers_] = space_pivot_;
}

void Selection::recall_space_pivot() {
  const auto kept = space_pivots_.find(markers_);
  space_pivot_ = kept == space_pivots_.end() ? SpacePivot() : kept->second;
}

void Selection::on(const action::SetSpacePivot& a) {
  space_pivot_.nodes.clear();
  space_pivot_.from = a.pivot ? PivotFrom::typed : PivotFrom::centre;
  if (!a.pivot) return place_pivot();
  const auto motion = live_space_motion(mesh_);
  space_pivot_.point = motion ? transform_back(*motion, *a.pivot) : *a.pivot;
}

void Selection::on(const action::SetSpaceAxis& a) {
  if (!a.axis.allFinite() || a.axis.norm() == 0) return;
  // A picked axis would come back with the nodes that it was picked from.
  if (space_pivot_.nodes.size() > 1) {
    space_pivot_.nodes.clear();
    space_pivot_.from = PivotFrom::typed;
  }
  const auto motion = live_space_motion(mesh_);
  space_pivot_.axis = motion ? rotated(inverse(*motion), a.axis) : a.axis;
}

void Selection::on(const action::TakePivot& a) {
  if (!in_space(mesh_) || markers_.empty()) return;
  const auto pivot =
      pivot_at(a.source, mesh_.document()->state().mesh.coordinates, space_pivot_.axis);
  if (!pivot) {
    messages_.tell(Notice::Kind::warning, "That has no direction: its nodes lie on one another.");
    return;
  }
  space_pivot_ = *pivot;
  pivot_pick_.reset();
}

void Selection::on(const action::PickPivot& a) {
  pivot_pick_.reset();
  if (a.from && in_space(mesh_) && !markers_.empty()) pivot_pick_ = a;
}

void Selection::place_space_pivot() {
  const Mesh& mesh = mesh_.document()->state().mesh;
  if (space_pivot_.picked()) {
    const auto pivot =
        pivot_at({space_pivot_.from, space_pivot_.nodes}, mesh.coordinates, space_pivot_.axis);
    if (pivot) space_pivot_ = *pivot;
    return;
  }
  if (markers_.empty() || space_pivot_.from != PivotFrom::centre) return;
  const std::vector<Index> nodes = mesh.topology->markers().nodes_of(names());
  // The very point of commands without a pivot.
  if (!nodes.empty()) space_pivot_.point = body_centre(space_bounds(mesh.coordinates, nodes));
}

/// All edges would be a blot: of those that are not sharp a few, spread over the surface.
const std::vector<std::array<Index, 2>>& Selection::outline_in_space() const {
  constexpr std::size_t most_faces = 100;
  constexpr double sharp_angle = 40;  // degrees
  if (outline_) return *outline_;
  outline_.emplace();
  std::vector<SurfaceFace> faces;
  for (const SurfaceFace& face : mesh_.document()->boundary()->faces)
    if (contains(face.marker)) faces.push_back(face);
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

const Selection::HeldPatch* Selection::held_patch() const {
  const auto& patch = shape_edit_.patch;
  if (!patch || patch->nodes.empty() || !in_space(mesh_)) return nullptr;
  const std::uint64_t revision = mesh_.document()->edits().revision();
  if (held_patch_ && held_patch_->patch == *patch && held_patch_->radius == shape_edit_.radius &&
      held_patch_->revision == revision)
    return &held_patch_->held;
  const Mesh& mesh = mesh_.document()->state().mesh;
  HeldPatch held;
  held.grip = grip_of(*patch, shape_edit_.radius, mesh);
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
  held_patch_ = MadePatch{*patch, shape_edit_.radius, revision, std::move(held)};
  return &held_patch_->held;
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
