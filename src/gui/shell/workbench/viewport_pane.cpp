#include "gui/shell/workbench/viewport_pane.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/mesh/element_type.h"
#include "core/mesh/surface_faces.h"
#include "gui/panels/message_panels.h"
#include "gui/render/space/space_view.h"
#include "gui/view/navigation/go_to.h"
#include "gui/view/overlays/foot_overlay.h"
#include "gui/view/overlays/overlay.h"
#include "gui/view/overlays/ruler_overlay.h"

namespace winslow::gui {

namespace {

PointerState pointer_of(const InputState& input, bool over) {
  PointerState pointer;
  pointer.position = input.mouse;
  pointer.over = over;
  pointer.left = input.down(MouseButton::left);
  pointer.middle = input.down(MouseButton::middle);
  pointer.right = input.down(MouseButton::right);
  pointer.wheel = input.wheel.y();
  pointer.shift = input.shift();
  pointer.control = input.control();
  pointer.alt = input.alt();
  pointer.cancel = input.keys[GLFW_KEY_ESCAPE];
  pointer.accept = input.keys[GLFW_KEY_ENTER] || input.keys[GLFW_KEY_KP_ENTER];
  pointer.key_x = input.keys[GLFW_KEY_X];
  pointer.key_y = input.keys[GLFW_KEY_Y];
  pointer.key_z = input.keys[GLFW_KEY_Z];
  pointer.text = input.text;
  pointer.erase = input.keys[GLFW_KEY_BACKSPACE];
  pointer.next = input.keys[GLFW_KEY_TAB];
  return pointer;
}

/// Markers that the mouse must not take: hidden or locked.
std::vector<Index> taken_out(const Session& session, const MarkerLooks& looks) {
  std::vector<Index> markers;
  if (!session.document() || looks.by_name.empty()) return markers;
  const auto& all = session.topology()->markers();
  for (std::size_t m = 0; m < all.size(); ++m) {
    const MarkerLook look = looks.of(all[m].name);
    if (look.hidden || look.locked) markers.push_back(static_cast<Index>(m));
  }
  return markers;
}

/// The face of the boundary at a place that is seen; none: a part of a cut or of an element within.
std::optional<Index> face_at(const Session& session, const SeenPlace& seen) {
  const Topology& topology = *session.topology();
  const SpacePoints x(session.coordinates());
  std::optional<Index> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Face& side : shape_of(topology.element_type(seen.element)).faces) {
    const auto f = topology.find_face(by_nodes(side, topology.element(seen.element)));
    if (!f || topology.face(*f).elements[1] >= 0) continue;
    const Face nodes = topology.face(*f).nodes;
    const Vec3 normal = area_vector(x, nodes).normalized();
    // An element may have several faces on the boundary: the one in whose plane the place lies.
    const double distance = std::abs(normal.dot(seen.point - centre_of(x, nodes)));
    if (distance >= nearest) continue;
    nearest = distance;
    best = f;
  }
  return best;
}

/// What is under the mouse, or a node so near to it that it is meant: a corner of a body has
/// nothing beside it to be under the mouse.
std::optional<SeenPlace> seen_by_ruler(const PointerState& pointer, const SpaceViewport& viewport,
                                       const SpaceSurroundings& around, const SpaceView& view) {
  if (viewport.seen() || !pointer.over) return viewport.seen();
  const double reach = 6 * around.scale;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * pi / 4;
    const ScreenPoint at =
        pointer.position + ScreenVector(reach * std::cos(angle), reach * std::sin(angle));
    auto seen = SpaceViewport::seen_at(at, around, view);
    if (seen && seen->node) return seen;
  }
  return std::nullopt;
}

ScreenBox box_of(const Area& a) {
  return {ScreenPoint(a.x, a.y), ScreenPoint(a.x + a.width, a.y + a.height)};
}

}  // namespace

std::optional<Inset> pinned_inset(const Session& session, const ViewOptions& view,
                                  const Camera& camera, double scale) {
  if (!session.document() || !view.magnifier.pin) return std::nullopt;
  return magnifier_inset(view.magnifier, camera, ScreenPoint(), false, scale);
}

bool ViewportPane::poll() {
  const bool drawn = mesh_view_.poll();
  return before_.poll() || drawn;
}

ViewportScene ViewportPane::scene(double scale) const {
  ViewportScene scene;
  scene.boundary = session_.mesh().boundary();
  scene.selection = session_.selection().markers();
  scene.pivot = session_.selection().pivot();
  scene.reach = reach_;
  if (viewport_.gesture() == Viewport::Gesture::rotate)
    scene.turned = viewport_.drag().motion().rotate;
  scene.scale = scale;
  scene.box_zoom = control_.state().box_zoom_armed;
  const auto& lens = lens_.inset();
  scene.wheel_is_lens = lens && !lens->pinned && !ImGui::GetIO().KeyCtrl;
  scene.look_only = control_.state().ruler;
  scene.shape = session_.selection().shape_edit();
  scene.taken_out = taken_out(session_, control_.options().markers);
  if (const auto& anchors = session_.selection().anchors())
    for (const PivotPlace place : {PivotPlace::leading_edge, PivotPlace::trailing_edge,
                                   PivotPlace::centroid, PivotPlace::centre})
      scene.snaps.emplace_back(anchors->at(place), pivot_place_name(place));
  return scene;
}

void ViewportPane::drive(const InputState& input, const PanelContext& context,
                         const Layout& layout) {
  const bool free = input.mouse_inside && session_.document() && !UiLayer::current().wants_mouse();
  const bool over = free && layout.viewport.contains(static_cast<float>(input.mouse.x()),
                                                     static_cast<float>(input.mouse.y()));
  PointerState pointer = pointer_of(input, over);
  control_.set_mouse(over ? std::optional(input.mouse) : std::nullopt);
  if (!mouse_busy()) {
    pointer.over = free;
    take_for_legend(pointer, context, layout);
    take_for_lens(pointer, context);
  }
  if (session_.in_space()) return drive_space(pointer, context);
  const ViewOptions& view = control_.options();
  const ViewState& state = control_.state();
  const auto scale = static_cast<double>(context.theme.scale);
  const bool inspects = state.columns.right_open && view.side_tab == SideTab::vcv;
  const bool nodes = !state.box_zoom_armed && !state.ruler && (input.alt() || inspects);
  pointer.picks_nodes = nodes;
  pointer.click_taken =
      node_tool_.update(pointer, nodes, scale, session_, control_.plane(), context.actions);
  take_for_ruler(pointer, scale);
  const bool dragging = viewport_.dragging();
  viewport_.update(pointer, scene(scale), control_.plane(), context.actions);
  zoom_to_double_click(pointer, context);
  if (const auto at = context_click_.update(pointer, scale); at && !dragging && session_.document())
    context.emit(
        action::ShowContextMenu{pick_place(session_, control_.plane(), view.markers, *at, scale)});
  if (viewport_.gesture() == Viewport::Gesture::box) control_.disarm_box_zoom();
  lens_.place(magnifier_inset(view.magnifier, control_.camera(), input.mouse, over, scale));
}

void ViewportPane::drive_space(PointerState pointer, const PanelContext& context) {
  const ViewOptions& view = control_.options();
  const auto scale = static_cast<double>(context.theme.scale);
  const SpaceSurroundings around{
      session_,
      mesh_view_.volume(),
      view,
      control_.state().cut,
      taken_out(session_, view.markers),
      scale,
      control_.state().box_zoom_armed,
      control_.state().columns.right_open && view.side_tab == SideTab::vcv};
  using Gesture = SpaceViewport::Gesture;
  pointer.click_taken = control_.state().ruler;
  const bool beside = take_from_beside(pointer);
  space_viewport_.update(pointer, around, control_.space().view(), context.actions);
  if (space_viewport_.gesture() == Gesture::box) control_.disarm_box_zoom();
  const bool looks = space_viewport_.gesture() == Gesture::none;
  control_.set_mouse(pointer.over ? std::optional(pointer.position) : std::nullopt,
                     looks && !beside ? space_viewport_.seen() : std::nullopt);
  const auto& seen = space_viewport_.seen();
  if (control_.state().ruler)
    space_ruler_.update(
        pointer,
        beside ? std::nullopt
               : seen_by_ruler(pointer, space_viewport_, around, control_.space().view()),
        scale, session_);
  else
    space_ruler_.clear();
  const bool plain = !pointer.shift && !pointer.control && !pointer.alt && pointer.over;
  if (plain && !beside && seen && seen->marker >= 0 &&
      ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    context.emit(action::FitMarkers{{seen->marker}});
  if (const auto at = context_click_.update(pointer, scale)) {
    PickedPlace place;
    if (beside) return context.emit(action::ShowContextMenu{place});
    if (const auto there = SpaceViewport::seen_at(*at, around, control_.space().view())) {
      place.in_space = {there->point, there->normal};
      if (there->marker >= 0) {
        place.markers = {there->marker};
        if (session_.kind() == MeshKind::volume) place.face = face_at(session_, *there);
      }
      place.node = there->node;
      place.element = there->element;
    }
    context.emit(action::ShowContextMenu{place});
  }
  lens_.place(std::nullopt);
}

/// Over the mesh before, beside the one now, the mouse turns, pans and zooms both as if it were at
/// the same place of the mesh now; what it is over is not of the mesh now, and cannot be picked.
bool ViewportPane::take_from_beside(PointerState& pointer) {
  if (control_.options().comparison != Comparison::split) return beside_held_ = false;
  const double divider = control_.options().divider;
  const ScreenBox now = control_.space().view().viewport();
  const ScreenBox before = side_by_side(whole_of(now, divider), divider).before;
  const bool busy = space_viewport_.gesture() != SpaceViewport::Gesture::none;
  // A gesture ends on the side where it began.
  if (!busy) beside_held_ = pointer.position.x() < before.max.x();
  if (!beside_held_) return false;
  pointer.position = pointer.position + (now.centre() - before.centre());
  pointer.click_taken = true;
  return true;
}

/// The legend's strip lies beside the mesh: pointer.over says that nothing else has the mouse.
void ViewportPane::take_for_legend(PointerState& pointer, const PanelContext& context,
                                   const Layout& layout) {
  const auto x = static_cast<float>(pointer.position.x());
  const auto y = static_cast<float>(pointer.position.y());
  const bool over_mesh = pointer.over && layout.viewport.contains(x, y);
  const bool near = over_mesh || (pointer.over && layout.legend.contains(x, y));
  const bool pressed = pointer.left && (near || legend_card_.held());
  const ScreenPoint nowhere(-1e9, -1e9);
  const bool taken = legend_card_.take_pointer(
      context, near || legend_card_.held() ? pointer.position : nowhere, pressed);
  pointer.over = over_mesh && !taken;
}

/// The magnifier lies over the mesh and takes the wheel.
void ViewportPane::take_for_lens(PointerState& pointer, const PanelContext& context) {
  const auto& lens = lens_.inset();
  const bool in_lens = lens && lens->frame().contains(pointer.position);
  const bool turn =
      lens && in_lens && pointer.over && pointer.wheel != 0 && (lens->pinned || !pointer.control);
  if (turn) {
    context.edit_view([&](ViewOptions& view) {
      view.magnifier.factor = turned_factor(view.magnifier.factor, pointer.wheel);
    });
  }
  if (in_lens && lens->pinned) pointer.over = false;
}

/// Clicks are the ruler's while it is out; drags and the wheel go on moving the view.
void ViewportPane::take_for_ruler(PointerState& pointer, double scale) {
  if (!control_.state().ruler || !session_.document()) return ruler_.clear();
  const bool snaps = pointer.over && !pointer.shift;
  const auto node =
      snaps ? node_tool_.node_at(pointer, scale, session_, control_.plane()) : std::nullopt;
  ruler_.update(pointer, node, scale, session_, control_.plane());
  pointer.click_taken = true;
}

/// At the end of the second click: one who presses twice and then drags wants to drag.
void ViewportPane::zoom_to_double_click(const PointerState& pointer, const PanelContext& context) {
  const bool plain = !pointer.shift && !pointer.control && !pointer.click_taken;
  const bool second = pointer.over && plain && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  if (second && viewport_.body()) double_click_ = viewport_.body()->markers;
  if (double_click_.empty()) return;
  if (pointer.left && viewport_.gesture() == Viewport::Gesture::press_body) return;
  if (!pointer.left) context.emit(action::FitMarkers{double_click_});
  double_click_.clear();
}

void ViewportPane::measure_selection() {
  if (session_.mesh().boundary() && !session_.in_motion())
    reach_ = session_.mesh().boundary()->reach(session_.selection().markers(),
                                               session_.selection().pivot());
}

void ViewportPane::follow_mesh(const ViewOptions& options, float scale) {
  before_.update(session_, options);
  std::vector<Index> worst;
  if (session_.in_space() && options.space.worst)
    for (const WorstElement& element : worst_elements(session_, options))
      worst.push_back(element.element);
  mesh_view_.volume().set_worst(std::move(worst));
  mesh_view_.update(session_, before_, options, scale);
}

void ViewportPane::update(const ViewOptions& options, const View& view, float scale) {
  follow_mesh(options, scale);
  if (session_.in_space()) return;
  const ScreenBox seen = view.viewport();
  const double middle = seen.min.x() + options.divider * seen.size().x();
  mesh_view_.set_divider(view.to_plane(ScreenPoint(middle, 0)).x());
}

void ViewportPane::draw_space_overlays(ImDrawList& list, const MeshFrame& frame) {
  const PanelContext& context = frame.context;
  const SpaceOverlay overlay{session_, context.view, context.view_state, *frame.space,
                             context.theme};
  const Area& v = frame.layout.viewport;
  const ScreenBox whole{{v.x, v.y}, {v.x + v.width, v.y + v.height}};
  const ScreenBox now = frame.space->viewport();
  list.PushClipRect(static_cast<ImVec2>(now.min), static_cast<ImVec2>(now.max), true);
  roles_.draw(list, overlay, mesh_view_.volume(), box_of(room_under_banner(frame)));
  space_id_labels_.draw(list, overlay, mesh_view_.volume());
  draw_space_marks(list, overlay, mesh_view_.volume());
  if (!frame.mesh_alone) draw_space_handles(list, overlay, space_viewport_);
  // What is measured lies over what is said of the ruler.
  if (!frame.mesh_alone) draw_space_mode(list, overlay);
  if (context.view_state.ruler && !frame.mesh_alone) draw_space_ruler(list, overlay, space_ruler_);
  list.PopClipRect();
  draw_comparison(list, context.view, context.theme, whole);
  LegendCard of_picture;
  LegendCard& legend = &frame.lens == &lens_ ? legend_card_ : of_picture;
  draw_legend(list, frame, legend);
  if (const auto box = space_viewport_.box()) draw_zoom_box(list, context.theme, *box);
}

/// What the mouse does at present, above the axes.
void ViewportPane::draw_space_mode(ImDrawList& list, const SpaceOverlay& o) const {
  const std::string text = mode_text(session_, o.state);
  if (text.empty()) return;
  const float margin = o.theme.px(16);
  const ScreenBox seen = o.view.viewport();
  double foot = space_marks_top(o);
  if (control_.card()) foot = std::min(foot, control_.card()->min.y());
  draw_mode(list, o.theme,
            {static_cast<float>(seen.min.x()) + margin, static_cast<float>(foot) - margin / 2},
            static_cast<float>(seen.size().x()) - 2 * margin, text);
}

void ViewportPane::draw_overlays(ImDrawList& list, const MeshFrame& frame) {
  if (!session_.document()) return;
  if (frame.space) return draw_space_overlays(list, frame);
  const PanelContext& context = frame.context;
  const Theme& theme = context.theme;
  // What is for the mouse's sake: a picture of the mesh alone has none of it.
  const ViewportScene shown = scene(static_cast<double>(theme.scale));
  const Overlay handles{session_, viewport_, shown, frame.view, theme};
  // What belongs to the mesh ends where its picture does: the legend's strip lies beside it.
  const Area& v = frame.layout.viewport;
  const ImVec2 from(v.x, v.y), to(v.x + v.width, v.y + v.height);
  list.PushClipRect(from, to, true);
  if (frame.mesh_alone)
    draw_pins(list, handles);
  else
    draw_overlay(list, handles);
  list.PopClipRect();
  const ViewOverlay overlay{session_, context.view, context.view_state, frame.view, theme};
  draw_rim(list, overlay);
  roles_.draw(list, overlay, box_of(room_under_banner(frame)));
  id_labels_.draw(list, overlay);
  draw_focus(list, overlay);
  draw_comparison(list, overlay);
  // That of a picture has another place: the mouse knows the window's.
  LegendCard of_picture;
  LegendCard& legend = &frame.lens == &lens_ ? legend_card_ : of_picture;
  draw_legend(list, frame, legend);
  draw_foot(list, frame, overlay, legend);
  // Nothing covers what the mouse is about to take hold of, nor what it says of it.
  list.PushClipRect(from, to, true);
  if (!frame.mesh_alone) draw_handles(list, handles);
  list.PopClipRect();
  if (context.view_state.ruler && !frame.mesh_alone) draw_ruler(list, overlay, ruler_);
  frame.lens.draw(list, overlay);
  if (const auto box = viewport_.box()) draw_zoom_box(list, theme, *box);
  if (!frame.mesh_alone) draw_mouse_labels(list, handles);
}

void ViewportPane::draw_legend(ImDrawList& list, const MeshFrame& frame, LegendCard& card) const {
  const auto& legend = mesh_view_.legend();
  const ViewOptions& view = frame.context.view;
  if (!view.legend || !view.color) return card.hide();
  card.draw(list, frame.context, {room_under_banner(frame), frame.layout.legend},
            legend && view.fill ? &*legend : nullptr);
}

Area ViewportPane::room_under_banner(const MeshFrame& frame) const {
  Area area = frame.layout.viewport;
  if (session_.messages().banner() && !frame.mesh_alone) {
    const float banner = BannerPanel::height(frame.context, area.width);
    area.y += banner;
    area.height -= banner;
  }
  return area;
}

/// Above a card at the foot, beside a pinned magnifier or a legend in that corner.
void ViewportPane::draw_foot(ImDrawList& list, const MeshFrame& frame, const ViewOverlay& overlay,
                             const LegendCard& card) const {
  ScreenBox room = frame.view.viewport();
  if (!frame.mesh_alone && control_.card())
    room.max = ScreenPoint(room.max.x(), control_.card()->min.y());
  if (const auto& lens = frame.lens.inset(); lens && lens->pinned)
    room.min = ScreenPoint(lens->frame().max.x(), room.min.y());
  const auto& legend = card.frame();
  if (legend && frame.context.view.legend_place == LegendPlace::bottom_left)
    room.min = ScreenPoint(legend->max.x(), room.min.y());
  gui::draw_foot(list, overlay, room,
                 frame.mesh_alone ? std::string() : mode_text(session_, frame.context.view_state));
  if (!frame.mesh_alone) draw_out_of_view(list, overlay);
}

std::optional<int> ViewportPane::cursor() const {
  if (legend_card_.offers_grip()) return ImGuiMouseCursor_ResizeAll;
  if (session_.in_space()) {
    if (space_viewport_.cut_part() != CutPart::none || space_viewport_.mover().handle() ||
        space_viewport_.pivot_source() || !space_viewport_.held_by_click().empty())
      return ImGuiMouseCursor_Hand;
    if (mouse_busy()) return ImGuiMouseCursor_ResizeAll;
    return std::nullopt;
  }
  if (viewport_.gesture() == Viewport::Gesture::pan ||
      viewport_.gesture() == Viewport::Gesture::box)
    return ImGuiMouseCursor_ResizeAll;
  if (viewport_.dragging() || viewport_.over_body() || viewport_.hovered_handle() != Handle::none ||
      viewport_.hovered_node())
    return ImGuiMouseCursor_Hand;
  return std::nullopt;
}

}  // namespace winslow::gui
