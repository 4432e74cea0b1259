#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

void Session::on(const action::SelectMarkers& a) {
  if (!document_) return;
  std::vector<Index> wanted = a.markers;
  const auto count = static_cast<Index>(topology()->markers().size());
  std::erase_if(wanted, [count](Index m) { return m < 0 || m >= count; });
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  if (a.toggle) {
    std::vector<Index> toggled;
    // Several markers of one body go together: out if all are in, else in.
    if (std::includes(selection_.begin(), selection_.end(), wanted.begin(), wanted.end()))
      std::set_difference(selection_.begin(), selection_.end(), wanted.begin(), wanted.end(),
                          std::back_inserter(toggled));
    else
      std::set_union(selection_.begin(), selection_.end(), wanted.begin(), wanted.end(),
                     std::back_inserter(toggled));
    wanted = std::move(toggled);
  }
  if (wanted == selection_) return;
  selection_ = std::move(wanted);
  preview_.reset();
  pivot_place_ = PivotPlace::centre;
  update_anchors();
  place_pivot();
}

void Session::on(const action::HoverMarkers& a) { hovered_ = a.markers; }

void Session::on(const action::CycleBody& a) {
  if (!boundary_) return;
  std::vector<const BoundaryIndex::Body*> bodies;
  for (const auto& body : boundary_->bodies())
    if (body.hole && !body.markers.empty()) bodies.push_back(&body);
  if (bodies.empty()) return;
  const auto count = static_cast<int>(bodies.size());
  const auto now = std::find_if(bodies.begin(), bodies.end(),
                                [this](const auto* body) { return body->markers == selection_; });
  const int at =
      now == bodies.end() ? (a.step > 0 ? -1 : count) : static_cast<int>(now - bodies.begin());
  const int next = ((at + a.step) % count + count) % count;
  on(action::SelectMarkers{bodies[static_cast<std::size_t>(next)]->markers, false});
}

void Session::on(const action::SetPivot& a) {
  pivot_place_ = a.pivot ? std::nullopt : std::optional(a.place);
  if (!a.pivot) return place_pivot();
  const auto motion = live_motion();
  pivot_ = motion ? transform_back(*motion, *a.pivot) : *a.pivot;
}

void Session::place_pivot() {
  if (!anchors_ || !pivot_place_) return;
  pivot_ = anchors_->at(*pivot_place_);
  // The panel would show what rounding leaves of a zero.
  const double least = 1e-14 * (pivot_.norm() + boundary_->reach(selection_, pivot_));
  for (int d = 0; d < 2; ++d)
    if (std::abs(pivot_[d]) < least) pivot_[d] = 0;
}

void Session::update_anchors() {
  anchors_.reset();
  if (!document_ || selection_.empty()) return;
  // A job shows a mesh that is none of the history: what it comes to has anchors of its own.
  if (topology() != document_->topology()) return;
  const Mesh& mesh = document_->state().mesh;
  std::vector<Index> nodes = mesh.topology->nodes_of_markers(selected_names());
  if (nodes.empty()) return;
  std::sort(nodes.begin(), nodes.end());
  // A body of several markers is a loop once all of them are selected.
  std::vector<std::vector<Index>> loops;
  std::vector<Index> on_loops;
  for (const auto& body : boundary_->bodies()) {
    if (body.markers.empty() || !std::includes(selection_.begin(), selection_.end(),
                                               body.markers.begin(), body.markers.end()))
      continue;
    loops.push_back(body.nodes);
    on_loops.insert(on_loops.end(), body.nodes.begin(), body.nodes.end());
  }
  std::sort(on_loops.begin(), on_loops.end());
  std::vector<Index> others;
  std::set_difference(nodes.begin(), nodes.end(), on_loops.begin(), on_loops.end(),
                      std::back_inserter(others));
  anchors_ = find_anchors(loops, others, mesh.coordinates);
}

void Session::on(const action::SetShapeEdit& a) {
  if (!document_ || (dragging_ && !a.active)) return;
  if (a.active && !shape_edit_.active && a.radius <= 0 && shape_edit_.radius <= 0) {
    // A first guess that shows what the radius is for: a tenth of the smallest body.
    double size = bounds(document_->state().mesh).size().maxCoeff();
    for (const auto& body : boundary_->bodies())
      size = std::min(size, bounds(coordinates(), body.nodes).size().maxCoeff());
    shape_edit_.radius = 0.1 * size;
  } else if (a.radius > 0 || shape_edit_.active) {
    shape_edit_.radius = std::max(a.radius, 0.0);
  }
  shape_edit_.active = a.active;
  if (!a.active) shape_edit_.arc.reset();
  if (dragging_ && drag_.active() && !drag_.grip().rigid() && shape_edit_.arc) {
    // The same pull on another length of boundary.
    const RigidMotion pull = drag_.wanted();
    begin_body_drag(grip_of(*shape_edit_.arc, shape_edit_.radius, *boundary_,
                            *document_->topology(), document_->state().mesh.coordinates));
    drag_.to(pull);
    shape_changed();
  }
}

void Session::on(const action::SelectArc& a) { shape_edit_.arc = a.arc; }

void Session::on(const action::PreviewDeformation& a) {
  preview_.reset();
  if (!a.shape || !document_ || selection_.empty()) return;
  if (topology() != document_->topology()) return;
  const Mesh& mesh = document_->state().mesh;
  Coordinates moved = mesh.coordinates;
  try {
    make_motion(*mesh.topology, mesh.coordinates, selected_names(), *a.shape)
        ->apply(mesh.coordinates, 1, moved);
  } catch (const UsageError&) {
    return;  // numbers half typed; carrying them out would say what is wrong
  }
  preview_ = DeformationPreview{*a.shape, {}};
  for (Index m : selection_)
    for (const Face& edge : mesh.topology->markers()[static_cast<std::size_t>(m)].faces)
      preview_->outline.emplace_back(moved.xy(edge[0]), moved.xy(edge[1]));
}

void Session::on(const action::ApplyDeformation& a) {
  if (!document_ || selection_.empty() || dragging_) return;
  preview_.reset();
  start_job(DeformCommand{selected_names(), a.shape, motion_, smooth_}, false);
}

}  // namespace winslow::gui
