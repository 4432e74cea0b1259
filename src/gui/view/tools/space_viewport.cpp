#include "gui/view/tools/space_viewport.h"

#include <algorithm>
#include <cmath>

#include "gui/view/tools/pivot_picker.h"

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double orbit_threshold = 4;
constexpr double near_node = 10;
constexpr double near_surface = 7;
constexpr double zoom_per_turn = 1.2;  // of the wheel, by a notch

const CutPlane* held_cut(const SpaceSurroundings& around) {
  const auto& cuts = around.options.space.cuts;
  if (!around.cut || *around.cut >= cuts.size() || !cuts[*around.cut].on) return nullptr;
  return Vec3(cuts[*around.cut].normal.data()).norm() > 0 ? &cuts[*around.cut] : nullptr;
}

void edit_cut(const SpaceSurroundings& around, const CutPlane& cut, ActionQueue& actions) {
  ViewOptions after = around.options;
  after.space.cuts[*around.cut] = cut;
  actions.emplace_back(action::EditView{difference(around.options, after)});
}

/// Where the view is turned about if nothing lies under the mouse: what is in the middle of the
/// view, or of the mesh.
Vec3 middle_of_view(const SpaceSurroundings& around, const SpaceView& view) {
  const ScreenPoint centre = view.viewport().centre();
  if (const auto hit = around.picture.pick(view, centre)) return hit->point;
  if (!around.picture.mesh()) return view.camera().centre();
  const Vec3 middle = around.picture.scenes()->parts.front()->extent.centre();
  return view.viewport().contains(view.project(middle).at) ? middle : view.camera().centre();
}

}  // namespace

std::optional<SeenPlace> SpaceViewport::seen_at(const ScreenPoint& at,
                                                const SpaceSurroundings& around,
                                                const SpaceView& view) {
  const auto hit = around.picture.pick(view, at);
  // One aims at a line from beside it, too.
  const auto border =
      seen_border(at, near_surface * around.scale, around.picture, view, around.options.markers);
  if (!hit && !border) return std::nullopt;
  SeenPlace seen =
      hit ? SeenPlace{hit->point, hit->normal, hit->element, hit->marker, {}} : *border;
  if (border) seen.marker = border->marker;
  const Mesh& mesh = *around.picture.mesh();
  double nearest = near_node * around.scale;
  for (const Index node : mesh.topology->element(seen.element)) {
    const double distance = (view.project(mesh.coordinates.xyz(node)).at - at).norm();
    if (distance > nearest) continue;
    nearest = distance;
    seen.node = node;
  }
  return seen;
}

std::optional<ScreenBox> SpaceViewport::box() const {
  if (gesture_ != Gesture::box) return std::nullopt;
  const ScreenPoint &a = press_, &b = last_.position;
  return ScreenBox{{std::min(a.x(), b.x()), std::min(a.y(), b.y())},
                   {std::max(a.x(), b.x()), std::max(a.y(), b.y())}};
}

CutPart SpaceViewport::cut_part() const {
  if (gesture_ == Gesture::move_cut) return CutPart::shaft;
  if (gesture_ == Gesture::turn_cut) return CutPart::knob;
  return gesture_ == Gesture::none ? hovered_part_ : CutPart::none;
}

std::optional<Vec3> SpaceViewport::pivot() const {
  return gesture_ == Gesture::orbit ? std::optional(pivot_) : std::nullopt;
}

void SpaceViewport::update(const PointerState& p, const SpaceSurroundings& around, SpaceView& view,
                           ActionQueue& actions) {
  const bool other = p.middle || p.right;
  const bool held = other_button_ ? other : p.left;
  if (gesture_ == Gesture::move) {
    if (!follow_move(p, around, view, actions)) gesture_ = Gesture::none;
  } else if (p.cancel && gesture_ != Gesture::none) {
    cancel(around, view, actions);
  } else if (gesture_ == Gesture::none) {
    hover(p, around, view, actions);
    if (p.over && p.wheel != 0)
      view.zoom_about(
          seen_ ? seen_->point : view.at_depth_of(middle_of_view(around, view), p.position),
          std::pow(zoom_per_turn, p.wheel));
    const bool pressed =
        (p.left && !last_.left) || (p.middle && !last_.middle) || (p.right && !last_.right);
    if (p.over && pressed) press(p, around, view, actions);
  } else {
    follow(p, around, view, actions);
    last_.position = p.position;
    if (!held) release(p, around, actions);
  }
  last_ = p;
}

void SpaceViewport::hover(const PointerState& p, const SpaceSurroundings& around,
                          const SpaceView& view, ActionQueue& actions) {
  hovered_part_ = CutPart::none;
  mover_.hover(p, around.session, view, around.scale);
  if (!p.over) return forget_seen(actions);
  if (const CutPlane* cut = held_cut(around); cut && !mover_.handle())
    hovered_part_ = make_cut_handle(*cut, view, around.scale).at(p.position);
  const Looked now{p.position, view.camera(), around.picture.scenes()};
  if (looked_ != now) seen_ = seen_at(p.position, around, view);
  looked_ = now;
  hover_node(seen_ && (around.inspects || p.alt) ? seen_->node : std::nullopt, actions);
  look(p, around, view);
  std::vector<Index> markers;
  const bool picks = around.session.selection().space().pick().has_value();
  if (seen_ && seen_->marker >= 0 && hovered_part_ == CutPart::none && !mover_.handle() && !picks &&
      held_by_click_.empty() && !std::ranges::binary_search(around.taken_out, seen_->marker))
    markers.push_back(seen_->marker);
  if (markers == last_hover_) return;
  last_hover_ = markers;
  actions.emplace_back(action::HoverMarkers{std::move(markers)});
}

/// What the tools would do with what is under the mouse.
void SpaceViewport::look(const PointerState& p, const SpaceSurroundings& around,
                         const SpaceView& view) {
  pivot_source_.reset();
  held_by_click_.clear();
  surface_.reset();
  const Selection& selection = around.session.selection();
  const auto& pick = selection.space().pick();
  if (!pick && !selection.shape_edit().active) return;
  if (mover_.handle() || hovered_part_ != CutPart::none) return;
  surface_ = surface_near(p.position, around, view);
  if (!surface_) return;
  if (pick) {
    pivot_source_ = pivot_picker_.source_at(*surface_, *pick->from, pick->first, around.session);
  } else if (!around.session.in_motion() &&
             !std::ranges::binary_search(around.taken_out, surface_->marker)) {
    const auto shared = shared_mesh(around.session.mesh());
    const Mesh& mesh = *shared;
    held_by_click_ = seen_face(*surface_, mesh);
    const auto node = nearest_corner(*surface_, mesh);
    if (node && (view.project(mesh.coordinates.xyz(*node)).at - p.position).norm() <=
                    near_node * around.scale)
      held_by_click_ = {*node};
  }
}

/// The boundary that is seen under the mouse or beside it: one aims at the rim of a body, too.
std::optional<SeenPlace> SpaceViewport::surface_near(const ScreenPoint& at,
                                                     const SpaceSurroundings& around,
                                                     const SpaceView& view) const {
  if (seen_ && seen_->marker >= 0) return seen_;
  constexpr int directions = 8;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * pi * k / directions;
    auto beside =
        seen_at(at + near_surface * around.scale * ScreenVector(std::cos(angle), std::sin(angle)),
                around, view);
    if (beside && beside->marker >= 0) return beside;
  }
  return std::nullopt;
}

void SpaceViewport::forget_seen(ActionQueue& actions) {
  seen_.reset();
  surface_.reset();
  pivot_source_.reset();
  held_by_click_.clear();
  looked_.reset();
  hover_node(std::nullopt, actions);
  if (last_hover_.empty()) return;
  last_hover_.clear();
  actions.emplace_back(action::HoverMarkers{});
}

void SpaceViewport::hover_node(std::optional<Index> node, ActionQueue& actions) {
  if (node == last_node_) return;
  last_node_ = node;
  actions.emplace_back(action::HoverNode{node});
}

void SpaceViewport::press(const PointerState& p, const SpaceSurroundings& around,
                          const SpaceView& view, ActionQueue& actions) {
  press_ = p.position;
  other_button_ = !p.left;
  camera_before_ = view.camera();
  pivot_ = seen_ ? seen_->point : middle_of_view(around, view);
  if ((p.left && around.box_zoom) || (p.right && p.control)) {
    gesture_ = Gesture::box;
  } else if (!other_button_ && mover_.press(p, around.session, view, around.scale, actions)) {
    gesture_ = Gesture::move;
  } else if (other_button_ || p.shift) {
    gesture_ = Gesture::pan;
  } else if (const CutPlane* cut = held_cut(around); cut && hovered_part_ != CutPart::none) {
    gesture_ = hovered_part_ == CutPart::knob ? Gesture::turn_cut : Gesture::move_cut;
    cut_before_ = *cut;
    handle_ = make_cut_handle(*cut, view, around.scale);
  } else {
    gesture_ = Gesture::press;
  }
  last_.position = p.position;
}

void SpaceViewport::follow(const PointerState& p, const SpaceSurroundings& around, SpaceView& view,
                           ActionQueue& actions) {
  const ScreenVector by = p.position - last_.position;
  if (gesture_ == Gesture::press && (p.position - press_).norm() > orbit_threshold * around.scale) {
    if (held_by_click_.size() == 1) return take_node(around, view, actions);
    gesture_ = Gesture::orbit;
    return turn(around, view, p.position - press_);
  }
  if (gesture_ == Gesture::orbit)
    turn(around, view, by);
  else if (gesture_ == Gesture::pan)
    view.pan_at(pivot_, by);
  else if (by != ScreenVector())
    follow_cut(p, around, view, actions);
}

/// As a turntable does, or freely.
void SpaceViewport::turn(const SpaceSurroundings& around, SpaceView& view,
                         const ScreenVector& by) const {
  around.options.space.free_orbit ? view.tumble(pivot_, by) : view.orbit(pivot_, by);
}

void SpaceViewport::follow_cut(const PointerState& p, const SpaceSurroundings& around,
                               const SpaceView& view, ActionQueue& actions) {
  if (!held_cut(around)) return;
  if (gesture_ == Gesture::move_cut)
    edit_cut(around, moved_cut(cut_before_, handle_, view, p.position - press_), actions);
  if (gesture_ == Gesture::turn_cut)
    edit_cut(around, turned_cut(cut_before_, handle_, view, p.position), actions);
}

void SpaceViewport::release(const PointerState& p, const SpaceSurroundings& around,
                            ActionQueue& actions) {
  // Shift and the left button pan, or add what is clicked.
  const bool stayed = (p.position - press_).norm() <= orbit_threshold * around.scale;
  if (gesture_ == Gesture::press || (gesture_ == Gesture::pan && !other_button_ && stayed))
    click(p, around, actions);
  if (gesture_ == Gesture::box) {
    const ScreenBox pixels = *box();
    // A click is no box.
    if (std::min(pixels.size().x(), pixels.size().y()) > orbit_threshold)
      actions.emplace_back(action::ZoomToScreen{pixels, pivot_});
  }
  gesture_ = Gesture::none;
  looked_.reset();
}

void SpaceViewport::click(const PointerState& p, const SpaceSurroundings& around,
                          ActionQueue& actions) const {
  if (p.click_taken) return;
  const bool add = p.shift || p.control;
  if (around.session.selection().space().pick() && click_for_pivot(around, actions)) return;
  if (around.session.selection().shape_edit().active && !p.alt)
    return click_for_shape(add, around, actions);
  const bool has_vcv =
      seen_ && seen_->node && !around.session.topology()->on_boundary(*seen_->node);
  if (has_vcv && !add && (p.alt || around.inspects)) {
    actions.emplace_back(action::InspectNode{*seen_->node});
    return;
  }
  if (p.alt) {
    if (seen_ && seen_->node)
      actions.emplace_back(action::GoTo{MeshItem{MeshItem::Kind::node, *seen_->node}, false});
    else
      actions.emplace_back(action::Remark{"No node is there. Click nearer to one, or zoom in."});
    return;
  }
  if (!seen_) {
    if (!add) actions.emplace_back(action::SelectMarkers{{}, false});
    return;
  }
  if (seen_->marker < 0) {
    actions.emplace_back(action::GoTo{MeshItem{MeshItem::Kind::element, seen_->element}, false});
    return;
  }
  if (!std::ranges::binary_search(around.taken_out, seen_->marker))
    actions.emplace_back(action::SelectMarkers{{seen_->marker}, add});
}

/// False when the drag has ended.
bool SpaceViewport::follow_move(const PointerState& p, const SpaceSurroundings& around,
                                const SpaceView& view, ActionQueue& actions) {
  const ShapeEdit& shape = around.session.selection().shape_edit();
  if (p.over && p.wheel != 0 && shape.active && mover_.dragging()) {
    // From nothing it grows to something that can be seen.
    const double least = 10 * view.pixel_size(mover_.gesture().motion().pivot);
    const double radius =
        std::max(shape.radius * std::pow(zoom_per_turn, p.wheel), p.wheel > 0 ? least : 0.0);
    actions.emplace_back(action::SetShapeEdit{true, radius < 0.5 * least ? 0 : radius});
  }
  mover_.follow(p, last_, view, actions);
  looked_.reset();
  return mover_.dragging();
}

/// Drags a node of the boundary, and what is held together with it.
void SpaceViewport::take_node(const SpaceSurroundings& around, const SpaceView& view,
                              ActionQueue& actions) {
  const Index node = held_by_click_.front();
  const auto& patch = around.session.selection().shape_edit().patch;
  if (!patch || !patch->contains(node)) click_for_shape(false, around, actions);
  gesture_ = Gesture::move;
  mover_.take(around.session.coordinates().xyz(node), press_, around.session, view, around.scale,
              actions);
}

/// True if the click was for a pivot.
bool SpaceViewport::click_for_pivot(const SpaceSurroundings& around, ActionQueue& actions) const {
  const auto& pick = around.session.selection().space().pick();
  if (!pivot_source_) {
    actions.emplace_back(
        action::Remark{"No surface is there to pick from. Esc ends the picking of a pivot."});
    return true;
  }
  const std::size_t wanted = pick->from == PivotFrom::nodes ? 2 : pivot_source_->nodes.size();
  if (pivot_source_->nodes.size() < wanted)
    actions.emplace_back(action::PickPivot{pick->from, pivot_source_->nodes.front()});
  else
    actions.emplace_back(action::TakePivot{*pivot_source_});
  return true;
}

/// Holds what is under the mouse, or lets go of what was held.
void SpaceViewport::click_for_shape(bool add, const SpaceSurroundings& around,
                                    ActionQueue& actions) const {
  const Selection& selection = around.session.selection();
  const auto& held = selection.shape_edit().patch;
  if (held_by_click_.empty()) {
    if (!add && held) actions.emplace_back(action::SelectPatch{});
    return;
  }
  SurfacePatch patch;
  if (add && held) patch = *held;
  patch.nodes.insert(patch.nodes.end(), held_by_click_.begin(), held_by_click_.end());
  // A drag fades over all of what is selected, or over the marker alone.
  patch.markers.push_back(surface_->marker);
  if (selection.contains(surface_->marker))
    patch.markers.insert(patch.markers.end(), selection.markers().begin(),
                         selection.markers().end());
  for (std::vector<Index>* list : {&patch.nodes, &patch.markers}) {
    std::ranges::sort(*list);
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  actions.emplace_back(action::SelectPatch{std::move(patch)});
}

void SpaceViewport::cancel(const SpaceSurroundings& around, SpaceView& view, ActionQueue& actions) {
  if (gesture_ == Gesture::orbit || gesture_ == Gesture::pan) {
    view.camera().look_from(camera_before_.direction());
    view.camera().look_at(camera_before_.centre(), camera_before_.units_per_pixel());
  }
  const bool cut = gesture_ == Gesture::move_cut || gesture_ == Gesture::turn_cut;
  if (cut && held_cut(around)) edit_cut(around, cut_before_, actions);
  gesture_ = Gesture::none;
  looked_.reset();
}

}  // namespace winslow::gui
