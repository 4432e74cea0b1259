#include "gui/document/session/selection.h"

#include <iterator>

#include "core/error.h"
#include "core/mesh/surface_faces.h"
#include "core/motion/rigid_motion.h"
#include "gui/render/view.h"

namespace winslow::gui {

namespace {

std::vector<std::array<Index, 2>> outline_in_plane(const Topology& topology,
                                                   const std::vector<Index>& markers) {
  std::vector<std::array<Index, 2>> outline;
  for (const Index m : markers)
    for (const Face& edge : topology.markers()[at(m)].faces) outline.push_back(edge.edge());
  return outline;
}

std::vector<std::array<Index, 2>> outline_in_space(const VolumeBoundary& boundary,
                                                   const Coordinates& coordinates,
                                                   const std::vector<Index>& markers) {
  constexpr std::size_t most_faces = 100;
  constexpr double sharp_angle = 40;  // degrees
  std::vector<std::array<Index, 2>> outline;
  std::vector<SurfaceFace> faces;
  for (const SurfaceFace& face : boundary.faces)
    if (std::ranges::binary_search(markers, face.marker)) faces.push_back(face);
  const SpacePoints x(coordinates);
  const SurfaceEdges edges = surface_edges(faces);
  const std::vector<unsigned char> sharp = feature_edges(x, faces, edges, sharp_angle);
  for (std::size_t k = 0; k < sharp.size(); ++k)
    if (sharp[k] != 0) outline.push_back(edges.nodes[k]);
  const std::size_t step = faces.size() / most_faces + 1;
  for (std::size_t f = 0; f < faces.size(); f += step)
    for (std::size_t c = 0; c < faces[f].nodes.size(); ++c)
      outline.push_back({faces[f].nodes[c], faces[f].nodes[(c + 1) % faces[f].nodes.size()]});
  return outline;
}

}  // namespace

std::vector<std::array<Index, 2>> outline_of(const LiveMesh& mesh,
                                             const std::vector<Index>& markers) {
  if (!in_space(mesh)) return outline_in_plane(*mesh.topology(), markers);
  return outline_in_space(*mesh.document()->boundary(), mesh.coordinates(), markers);
}

Vec3 BodySelection::pivot() const {
  const auto motion = mesh_.live_motion();
  return motion ? transform(*motion, pivot_.point) : pivot_.point;
}

bool BodySelection::goes(const std::vector<Index>& markers,
                         const std::vector<std::string>& body) const {
  return std::ranges::all_of(marker_names(*mesh_.topology(), markers), [&](const auto& name) {
    return std::ranges::find(body, name) != body.end();
  });
}

std::optional<Vec3> PlaneSelection::centre() const {
  return anchors_ ? std::optional(place_in_plane(anchors_->centre)) : std::nullopt;
}

std::vector<std::array<Index, 2>> PlaneSelection::outline() const {
  return outline_of(mesh_, markers_);
}

double PlaneSelection::smallest_body() const {
  double size = bounds(mesh_.document()->state().mesh).size().maxCoeff();
  for (const auto& body : mesh_.boundary()->bodies())
    size = std::min(size, bounds(mesh_.coordinates(), body.nodes).size().maxCoeff());
  return size;
}

void PlaneSelection::begin() {
  place_ = PivotPlace::centre;
  follow_nodes();
  place();
}

void PlaneSelection::moved(const std::vector<std::string>& body, const RigidMotion& motion,
                           bool alone) {
  if (alone || goes(markers_, body)) pivot_.point = transform(motion, pivot_.point);
}

void PlaneSelection::set_pivot(const action::SetPivot& a) {
  place_ = a.pivot ? std::nullopt : std::optional(a.place);
  if (!a.pivot) return place();
  const auto motion = mesh_.live_motion();
  pivot_.point = place_in_plane(motion ? transform_back(*motion, *a.pivot) : *a.pivot);
}

void PlaneSelection::place() {
  if (!anchors_ || !place_) return;
  Vec2 pivot = anchors_->point(*place_);
  // The centre must equal the default pivot of commands exactly. For other points remove rounding
  // errors of zeros, which the panel would show.
  if (place_ != PivotPlace::centre) {
    const double least = 1e-14 * (pivot.norm() + mesh_.boundary()->reach(markers_, pivot));
    for (int d = 0; d < 2; ++d)
      if (std::abs(pivot[d]) < least) pivot[d] = 0;
  }
  pivot_.point = place_in_plane(pivot);
}

void PlaneSelection::clear() {
  anchors_.reset();
  place_ = PivotPlace::centre;
}

void PlaneSelection::follow_nodes() {
  anchors_.reset();
  if (!mesh_.document() || markers_.empty()) return;
  // A job may show a mesh that is not in the history; its anchors are found when the job ends.
  if (mesh_.topology() != mesh_.document()->topology()) return;
  const Mesh& mesh = mesh_.document()->state().mesh;
  std::vector<Index> nodes =
      mesh.topology->markers().nodes_of(marker_names(*mesh.topology, markers_));
  if (nodes.empty()) return;
  std::sort(nodes.begin(), nodes.end());
  // A body with several markers is a loop only if all of them are selected.
  std::vector<std::vector<Index>> loops;
  std::vector<Index> on_loops;
  for (const auto& body : mesh_.boundary()->bodies()) {
    if (body.markers.empty() ||
        !std::includes(markers_.begin(), markers_.end(), body.markers.begin(), body.markers.end()))
      continue;
    loops.push_back(body.nodes);
    on_loops.insert(on_loops.end(), body.nodes.begin(), body.nodes.end());
  }
  std::sort(on_loops.begin(), on_loops.end());
  std::vector<Index> others;
  std::set_difference(nodes.begin(), nodes.end(), on_loops.begin(), on_loops.end(),
                      std::back_inserter(others));
  anchors_ = find_anchors(loops, others, mesh.coordinates);
  // Nodes of edges without a marker do not move with the selection.
  anchors_->centre = body_centre(body_box(mesh.coordinates, nodes)).head<2>();
}

namespace {

/// Moves a pivot with its bodies, except a picked one, which is defined by its nodes.
void move_pivot(SpacePivot& pivot, const RigidMotion& motion) {
  if (pivot.picked()) return;
  pivot.point = transform(motion, pivot.point);
  const Vec3 axis = rotated(motion, pivot.axis);
  // A rotation about the axis itself changes it only by rounding.
  if ((axis - pivot.axis).norm() > 1e-12 * axis.norm()) pivot.axis = axis;
}

}  // namespace

Vec3 SpaceSelection::axis() const {
  const auto motion = mesh_.live_motion();
  return motion ? rotated(*motion, pivot_.axis) : pivot_.axis;
}

void SpaceSelection::moved(const std::vector<std::string>& body, const RigidMotion& motion,
                           bool /*alone*/) {
  if (goes(markers_, body)) move_pivot(pivot_, motion);
  for (auto& [markers, pivot] : kept_)
    if (goes(markers, body)) move_pivot(pivot, motion);
}

void SpaceSelection::leave() {
  const bool own = pivot_.from != PivotFrom::centre || pivot_.axis != Vec3::UnitZ();
  if (!markers_.empty() && own)
    kept_[markers_] = pivot_;
  else
    kept_.erase(markers_);
}

void SpaceSelection::begin() {
  outline_.reset();
  if (markers_.empty()) pick_.reset();
  const auto kept = kept_.find(markers_);
  pivot_ = kept == kept_.end() ? SpacePivot() : kept->second;
  place();
}

void SpaceSelection::set_space_pivot(const std::optional<Vec3>& pivot) {
  pivot_.nodes.clear();
  pivot_.from = pivot ? PivotFrom::typed : PivotFrom::centre;
  if (!pivot) return place();
  const auto motion = mesh_.live_motion();
  pivot_.point = motion ? transform_back(*motion, *pivot) : *pivot;
}

void SpaceSelection::set_axis(const Vec3& axis) {
  if (!axis.allFinite() || axis.norm() == 0) return;
  // With its nodes kept, the picked axis would replace the typed one.
  if (pivot_.nodes.size() > 1) {
    pivot_.nodes.clear();
    pivot_.from = PivotFrom::typed;
  }
  const auto motion = mesh_.live_motion();
  pivot_.axis = motion ? rotated(inverse(*motion), axis) : axis;
}

void SpaceSelection::set_source(const PivotSource& source) {
  if (markers_.empty()) return;
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
  if (pick.from && !markers_.empty()) pick_ = pick;
}

void SpaceSelection::follow_nodes() {
  if (pivot_.picked()) place();
}

void SpaceSelection::place() {
  if (pivot_.picked()) {
    const Mesh& mesh = mesh_.document()->state().mesh;
    const auto pivot = pivot_at({pivot_.from, pivot_.nodes}, mesh.coordinates, pivot_.axis);
    if (pivot) pivot_ = *pivot;
  } else if (pivot_.from == PivotFrom::centre) {
    // Exactly the default pivot of commands.
    pivot_.point = centre().value_or(pivot_.point);
  }
}

std::optional<Vec3> SpaceSelection::centre() const {
  if (markers_.empty()) return std::nullopt;
  const Mesh& mesh = mesh_.document()->state().mesh;
  const auto nodes = mesh.topology->markers().nodes_of(marker_names(*mesh.topology, markers_));
  return nodes.empty() ? Vec3(Vec3::Zero()) : body_centre(space_bounds(mesh.coordinates, nodes));
}

void SpaceSelection::clear() {
  pivot_ = {};
  kept_.clear();
  pick_.reset();
  outline_.reset();
  held_.reset();
}

std::vector<std::array<Index, 2>> SpaceSelection::outline() const {
  if (!outline_) outline_ = outline_of(mesh_, markers_);
  return *outline_;
}

const SpaceSelection::HeldPatch* SpaceSelection::held(const ShapeEdit& edit) const {
  const auto& patch = edit.patch;
  if (!patch || patch->nodes.empty()) return nullptr;
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
  Vec3 whole(0, 0, 0), around(0, 0, 0);  // of held faces, and of faces that touch them
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

double SpaceSelection::smallest_body() const {
  const Mesh& mesh = mesh_.document()->state().mesh;
  double size = std::numeric_limits<double>::max();
  const auto& markers = mesh.topology->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto nodes = markers.nodes(static_cast<Index>(m));
    if (!nodes.empty())
      size = std::min(size, space_bounds(mesh.coordinates, nodes).size().maxCoeff());
  }
  return size;
}

namespace {

std::vector<Index> same_names(const std::vector<Index>& markers, const Topology& before,
                              const Topology& now) {
  std::vector<Index> found;
  for (const Index m : markers) {
    if (m < 0 || static_cast<std::size_t>(m) >= before.markers().size()) continue;
    if (const auto same = now.markers().find(before.markers()[at(m)].name)) found.push_back(*same);
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool same_star(Index node, const Topology& before, const Topology& now) {
  if (node >= before.node_count() || node >= now.node_count()) return false;
  return std::ranges::equal(before.neighbours(node), now.neighbours(node));
}

}  // namespace

bool Selection::contains(Index marker) const {
  return std::binary_search(markers_.begin(), markers_.end(), marker);
}

/// Commands that were carried out contain their pivots.
void Selection::moved(const MoveCommand& move) {
  const int dimension = mesh_.coordinates().dimension();
  for (const MovingBody& body : move.bodies)
    own().moved(body.markers, resolve_motion(body.motion, dimension, Vec3(0, 0, 0)),
                move.bodies.size() == 1);
  plan_.moved(move);
}

void Selection::refresh() {
  drop_preview();
  own().follow_nodes();
  own().place();
  plan_.follow_history();
}

void Selection::clear() {
  markers_.clear();
  hovered_.clear();
  nodes_ = {};
  lost_nodes_.clear();
  plane_.clear();
  space_.clear();
  shape_edit_ = {};
  plan_.clear();
  drop_preview();
}

void Selection::on(const action::SelectMarkers& a) {
  if (!mesh_.document()) return;
  std::vector<Index> wanted = a.markers;
  const auto count = static_cast<Index>(mesh_.topology()->markers().size());
  std::erase_if(wanted, [count](Index m) { return m < 0 || m >= count; });
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (a.toggle) {
    std::vector<Index> toggled;
    // Toggle the markers of one body together: remove them if all are selected, otherwise add them.
    if (std::includes(markers_.begin(), markers_.end(), wanted.begin(), wanted.end()))
      std::set_difference(markers_.begin(), markers_.end(), wanted.begin(), wanted.end(),
                          std::back_inserter(toggled));
    else
      std::set_union(markers_.begin(), markers_.end(), wanted.begin(), wanted.end(),
                     std::back_inserter(toggled));
    wanted = std::move(toggled);
  }
  if (wanted == markers_) return;
  own().leave();
  markers_ = std::move(wanted);
  drop_preview();
  own().begin();
}

void Selection::edit_shape(bool active, double radius) {
  if (active && !shape_edit_.active && radius <= 0 && shape_edit_.radius <= 0) {
    // Initial radius: a tenth of the smallest body, which makes its effect visible.
    shape_edit_.radius = 0.1 * own().smallest_body();
  } else if (radius > 0 || shape_edit_.active) {
    shape_edit_.radius = std::max(radius, 0.0);
  }
  shape_edit_.active = active;
  if (active) return;
  shape_edit_.arc.reset();
  shape_edit_.patch.reset();
}

void Selection::on(const action::PreviewDeformation& a) {
  preview_.reset();
  if (!a.shape || !mesh_.document() || markers_.empty()) return;
  if (mesh_.topology() != mesh_.document()->topology()) return;
  const Mesh& mesh = mesh_.document()->state().mesh;
  Coordinates moved = mesh.coordinates;
  try {
    make_motion(*mesh.topology, mesh.coordinates, names(), *a.shape)
        ->apply(mesh.coordinates, 1, moved);
  } catch (const UsageError&) {
    return;  // incomplete input; carrying it out would report the error
  }
  preview_ = DeformationPreview{*a.shape, {}};
  for (const auto& [a, b] : own().outline())
    preview_->outline.emplace_back(place_of(moved, a), place_of(moved, b));
}

void Selection::on(const action::PreviewMotion& a) {
  motion_preview_.reset();
  if (!a.motion || !mesh_.document() || markers_.empty()) return;
  motion_preview_ = MotionPreview{*a.motion, {}};
  // Use the selection's pivot if the motion has none.
  const Coordinates& x = mesh_.coordinates();
  const RigidMotion motion = resolve_motion(*a.motion, x.dimension(), space_pivot());
  for (const auto& [from, to] : own().outline())
    motion_preview_->outline.emplace_back(transform(motion, place_of(x, from)),
                                          transform(motion, place_of(x, to)));
}

void Selection::on(const action::PlanBody& a) {
  if (!mesh_.document() || markers_.empty()) return;
  drop_preview();
  plan_.put({names(), a.motion});
}

bool Selection::exists(Index node) const {
  return mesh_.document() && node >= 0 && node < mesh_.topology()->node_count();
}

void Selection::on(const action::SelectNode& a) {
  if (a.node && !exists(*a.node)) {
    if (mesh_.document())
      messages_.tell(Notice::Kind::warning,
                     "The mesh has no node " + std::to_string(*a.node) + ": they count from 0 to " +
                         std::to_string(mesh_.topology()->node_count() - 1) + ".");
    return;
  }
  nodes_.inspect(a.node);
}

void Selection::on(const action::HoverNode& a) {
  // The mesh may have changed since the mouse was over the node.
  nodes_.hover(a.node && exists(*a.node) ? a.node : std::nullopt);
}

void Selection::on(const action::PinNodes& a) {
  if (!a.pinned) return nodes_.unpin(a.nodes);
  std::vector<Index> with_vcv = a.nodes;
  std::erase_if(with_vcv, [this](Index node) {
    return !exists(node) || mesh_.topology()->on_boundary(node) || !mesh_.topology()->used(node);
  });
  nodes_.pin(with_vcv);
}

void Selection::carry_over(const std::shared_ptr<const Topology>& before,
                           const std::shared_ptr<const Topology>& now) {
  markers_ = same_names(markers_, *before, *now);
  hovered_ = same_names(hovered_, *before, *now);
  shape_edit_.arc.reset();  // its positions refer to the previous loops
  drop_preview();
  carry_over_nodes(before, now);
}

/// Drops nodes whose star has changed, and restores them when the previous connectivity returns (an
/// insertion was cancelled or undone).
void Selection::carry_over_nodes(const std::shared_ptr<const Topology>& before,
                                 const std::shared_ptr<const Topology>& now) {
  const auto goes = [&](Index node) { return !same_star(node, *before, *now); };
  LostNodes lost{before, {}, std::nullopt};
  std::ranges::copy_if(nodes_.pinned(), std::back_inserter(lost.pinned), goes);
  if (nodes_.inspected() && goes(*nodes_.inspected())) lost.inspected = nodes_.inspected();
  nodes_.keep_if([&](Index node) { return !goes(node); });
  std::erase_if(lost_nodes_, [&](const LostNodes& earlier) {
    const auto topology = earlier.topology.lock();
    if (topology == now) {
      nodes_.pin(earlier.pinned);
      if (!nodes_.inspected() && earlier.inspected) nodes_.inspect(earlier.inspected);
    }
    return !topology || topology == now || topology == before;
  });
  if (!lost.pinned.empty() || lost.inspected) lost_nodes_.push_back(std::move(lost));
}

}  // namespace winslow::gui
