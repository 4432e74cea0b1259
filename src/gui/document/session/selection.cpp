#include "gui/document/session/selection.h"

#include <iterator>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/document/selection/pivot.h"
#include "gui/render/view.h"

namespace winslow::gui {

namespace {

std::vector<Index> same_names(const std::vector<Index>& markers, const Topology& before,
                              const Topology& now) {
  std::vector<Index> found;
  for (const Index m : markers) {
    if (m < 0 || static_cast<std::size_t>(m) >= before.markers().size()) continue;
    if (const auto same = now.markers().find(before.markers()[static_cast<std::size_t>(m)].name))
      found.push_back(*same);
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

std::vector<std::string> Selection::names() const {
  std::vector<std::string> names;
  for (Index m : markers_)
    names.push_back(mesh_.topology()->markers()[static_cast<std::size_t>(m)].name);
  return names;
}

Vec2 Selection::pivot() const {
  const auto motion = mesh_.live_motion();
  return motion ? transform(*motion, pivot_) : pivot_;
}

Vec3 Selection::space_pivot() const {
  if (in_space(mesh_)) return space_.pivot();
  return place_in_plane(pivot());
}

std::vector<std::array<Index, 2>> Selection::outline() const {
  if (in_space(mesh_)) return space_.outline();
  std::vector<std::array<Index, 2>> edges;
  for (const Index m : markers_)
    for (const Face& edge : mesh_.topology()->markers()[static_cast<std::size_t>(m)].faces)
      edges.push_back(edge.edge());
  return edges;
}

/// Motions that were carried out name their pivots.
void Selection::moved(const MoveCommand& move) {
  const std::vector<std::string> selected = names();
  for (const MovingBody& body : move.bodies) {
    const bool goes = std::ranges::all_of(selected, [&](const std::string& name) {
      return std::ranges::find(body.markers, name) != body.markers.end();
    });
    if (in_space(mesh_))
      space_.moved(body);
    else if (goes || move.bodies.size() == 1)
      pivot_ = transform(resolve_motion(body.motion, 2, Vec3(0, 0, 0)), pivot_);
  }
}

void Selection::refresh() {
  drop_preview();
  update_anchors();
  place_pivot();
}

void Selection::clear() {
  markers_.clear();
  hovered_.clear();
  nodes_ = {};
  lost_nodes_.clear();
  anchors_.reset();
  pivot_place_ = PivotPlace::centre;
  space_.clear();
  shape_edit_ = {};
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
    // Several markers of one body go together: out if all are in, else in.
    if (std::includes(markers_.begin(), markers_.end(), wanted.begin(), wanted.end()))
      std::set_difference(markers_.begin(), markers_.end(), wanted.begin(), wanted.end(),
                          std::back_inserter(toggled));
    else
      std::set_union(markers_.begin(), markers_.end(), wanted.begin(), wanted.end(),
                     std::back_inserter(toggled));
    wanted = std::move(toggled);
  }
  if (wanted == markers_) return;
  markers_ = std::move(wanted);
  drop_preview();
  pivot_place_ = PivotPlace::centre;
  space_.choose(markers_);
  update_anchors();
  place_pivot();
}

void Selection::on(const action::SetPivot& a) {
  pivot_place_ = a.pivot ? std::nullopt : std::optional(a.place);
  if (!a.pivot) return place_pivot();
  const auto motion = mesh_.live_motion();
  pivot_ = motion ? transform_back(*motion, *a.pivot) : *a.pivot;
}

void Selection::place_pivot() {
  if (in_space(mesh_)) return space_.place();
  if (!anchors_ || !pivot_place_) return;
  pivot_ = anchors_->at(*pivot_place_);
  if (pivot_place_ == PivotPlace::centre) return;  // the very point of commands without a pivot
  // The panel would show what rounding leaves of a zero.
  const double least = 1e-14 * (pivot_.norm() + mesh_.boundary()->reach(markers_, pivot_));
  for (int d = 0; d < 2; ++d)
    if (std::abs(pivot_[d]) < least) pivot_[d] = 0;
}

void Selection::update_anchors() {
  anchors_.reset();
  if (!mesh_.document() || markers_.empty()) return;
  if (in_space(mesh_)) return space_.follow_nodes();
  // A job shows a mesh that is none of the history: what it comes to has anchors of its own.
  if (mesh_.topology() != mesh_.document()->topology()) return;
  const Mesh& mesh = mesh_.document()->state().mesh;
  std::vector<Index> nodes = mesh.topology->markers().nodes_of(names());
  if (nodes.empty()) return;
  std::sort(nodes.begin(), nodes.end());
  // A body of several markers is a loop once all of them are selected.
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
  // Edges of a loop that have no marker do not move with it.
  anchors_->centre = body_centre(body_box(mesh.coordinates, nodes)).head<2>();
}

void Selection::edit_shape(bool active, double radius) {
  if (active && !shape_edit_.active && radius <= 0 && shape_edit_.radius <= 0) {
    // A first guess that shows what the radius is for: a tenth of the smallest body.
    shape_edit_.radius = 0.1 * smallest_body();
  } else if (radius > 0 || shape_edit_.active) {
    shape_edit_.radius = std::max(radius, 0.0);
  }
  shape_edit_.active = active;
  if (active) return;
  shape_edit_.arc.reset();
  shape_edit_.patch.reset();
}

/// Its largest extent.
double Selection::smallest_body() const {
  if (in_space(mesh_)) return smallest_marker(mesh_.document()->state().mesh);
  double size = bounds(mesh_.document()->state().mesh).size().maxCoeff();
  for (const auto& body : mesh_.boundary()->bodies())
    size = std::min(size, bounds(mesh_.coordinates(), body.nodes).size().maxCoeff());
  return size;
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
    return;  // numbers half typed; carrying them out would say what is wrong
  }
  preview_ = DeformationPreview{*a.shape, {}};
  for (const auto& [a, b] : outline())
    preview_->outline.emplace_back(place_of(moved, a), place_of(moved, b));
}

void Selection::on(const action::PreviewMotion& a) {
  motion_preview_.reset();
  if (!a.motion || !mesh_.document() || markers_.empty()) return;
  motion_preview_ = MotionPreview{*a.motion, {}};
  // With the pivot, if it names none.
  const RigidMotion motion = resolve_motion(*a.motion, in_space(mesh_) ? 3 : 2, space_pivot());
  const Coordinates& x = mesh_.coordinates();
  for (const auto& [from, to] : outline())
    motion_preview_->outline.emplace_back(transform(motion, place_of(x, from)),
                                          transform(motion, place_of(x, to)));
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
  // The mesh may have changed since the mouse was there.
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
  shape_edit_.arc.reset();  // counts along the loops of before
  drop_preview();
  carry_over_nodes(before, now);
}

/// Nodes whose star is another one now are let go of, and taken up again when a mesh of the
/// connectivity before is back: an insertion was cancelled or undone.
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

void show_position(LiveMesh& mesh, Selection& selection, MessageBoard& messages) {
  mesh.changed();
  selection.refresh();
  messages.set_banner_of_position();
}

}  // namespace winslow::gui
