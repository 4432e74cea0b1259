#include "gui/shell/workbench/viewport_pane.h"

#include "gui/panels/panels.h"
#include "gui/render/space/space_view.h"
#include "gui/view/navigation/go_to.h"
#include "gui/view/overlays/foot_overlay.h"
#include "gui/view/overlays/overlay.h"
#include "gui/view/overlays/tool_overlay.h"
#include "gui/widgets/ui_layer.h"

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

/// Markers that the mouse cannot select: hidden or locked.
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
  const ViewOptions& options = control_.options();
  const ViewState& state = control_.state();
  ViewportScene scene{session_, mesh_view_.volume(), options};
  scene.taken_out = taken_out(session_, options.markers);
  scene.cut = state.cut;
  scene.reach = reach_;
  scene.scale = scale;
  scene.box_zoom = state.box_zoom_armed;
  scene.look_only = state.ruler;
  scene.inspects = state.columns.right_open && options.side_tab == SideTab::vcv;
  const auto& lens = lens_.inset();
  scene.wheel_is_lens = lens && !lens->pinned && !ImGui::GetIO().KeyCtrl;
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
  const auto scale = static_cast<double>(context.theme.scale);
  const bool beside = take_from_beside(pointer);
  pointer.click_taken = beside || control_.state().ruler;
  const bool dragging = viewport_.dragging();
  const ViewportScene around = scene(scale);
  const PointerFrame frame{pointer, around, control_.view(), context.actions};
  viewport_.update(pointer, around, control_.view(), context.actions);
  if (viewport_.gesture() == Viewport::Gesture::box) control_.disarm_box_zoom();
  if (!mouse_busy() && !beside && viewport_.picker().seen())
    control_.set_mouse(pointer.over ? std::optional(pointer.position) : std::nullopt,
                       viewport_.picker().seen());
  measure(frame, beside);
  zoom_to_double_click(pointer, context);
  const auto clicked = context_click_.update(pointer, scale);
  if (clicked && !dragging && session_.document())
    context.emit(action::ShowContextMenu{beside ? PickedPlace()
                                                : viewport_.picker().place_at(*clicked, frame)});
  lens_.place(session_.in_space() ? std::nullopt
                                  : magnifier_inset(around.options.magnifier, control_.camera(),
                                                    input.mouse, over, scale));
}

/// Over the earlier mesh, shown beside the present one, the mouse rotates, pans and zooms both as
/// at the corresponding place of the present mesh. Items there cannot be picked.
bool ViewportPane::take_from_beside(PointerState& pointer) {
  const bool split = control_.options().comparison == Comparison::split;
  if (!split || !session_.in_space()) return beside_held_ = false;
  const double divider = control_.options().divider;
  const ScreenBox now = control_.view().viewport();
  const ScreenBox before = side_by_side(whole_of(now, divider), divider).before;
  // A gesture ends on the side where it began.
  if (!mouse_busy()) beside_held_ = pointer.position.x() < before.max.x();
  if (!beside_held_) return false;
  pointer.position = pointer.position + (now.centre() - before.centre());
  return true;
}

/// Passes the mouse to the legend, whose strip lies beside the mesh. pointer.over: no other window
/// uses the mouse.
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

/// Passes the mouse wheel to the magnifier, which lies over the mesh.
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

/// While the ruler is on, clicks measure; drags and the wheel still move the view.
void ViewportPane::measure(const PointerFrame& frame, bool beside) {
  if (!control_.state().ruler || !session_.document()) return ruler_.clear();
  const auto under = beside ? std::nullopt : viewport_.picker().ruler_point(frame);
  ruler_.update(frame.pointer, under, frame.scene.scale, session_);
}

/// Zooms when the second click ends, since a second press may begin a drag.
void ViewportPane::zoom_to_double_click(const PointerState& pointer, const PanelContext& context) {
  const bool plain = !pointer.shift && !pointer.control && !pointer.click_taken;
  const bool second = pointer.over && plain && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  if (second) double_click_ = viewport_.picker().markers();
  if (double_click_.empty()) return;
  if (pointer.left && viewport_.gesture() == Viewport::Gesture::press) return;
  if (!pointer.left) context.emit(action::FitMarkers{double_click_});
  double_click_.clear();
}

void ViewportPane::measure_selection() {
  if (session_.mesh().boundary() && !session_.in_motion())
    reach_ = session_.mesh().boundary()->reach(session_.selection().markers(),
                                               session_.selection().pivot());
}

void ViewportPane::follow_mesh(const ViewOptions& options, float scale) {
  before_.update(session_.mesh(), options);
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

/// Draws the present mode of the mouse, above the axes.
void ViewportPane::draw_space_mode(ImDrawList& list, const ViewOverlay& o) const {
  const std::string text = mode_text(session_, o.state);
  if (text.empty()) return;
  const float margin = o.theme.px(16);
  const ScreenBox seen = o.view.viewport();
  double foot = space_marks_top(o);
  if (control_.navigator().card()) foot = std::min(foot, control_.navigator().card()->min.y());
  draw_mode(list, o.theme,
            {static_cast<float>(seen.min.x()) + margin, static_cast<float>(foot) - margin / 2},
            static_cast<float>(seen.size().x()) - 2 * margin, text);
}

/// Draws overlays that belong to the mesh and also appear in pictures.
void ViewportPane::draw_marks(ImDrawList& list, const MeshFrame& frame,
                              const ViewOverlay& overlay) {
  const VolumeView& picture = mesh_view_.volume();
  const ScreenBox room =
      room_below_comparison(box_of(room_under_banner(frame)), overlay.options, overlay.theme);
  if (frame.space)
    draw_space_marks(list, {overlay, *frame.space}, picture);
  else
    draw_rim(list, overlay);
  roles_.draw(list, overlay, picture, room);
  id_labels_.draw(list, overlay, picture, room);
  draw_focus(list, overlay);
}

void ViewportPane::draw_overlays(ImDrawList& list, const MeshFrame& frame) {
  if (!session_.document()) return;
  const PanelContext& context = frame.context;
  const Theme& theme = context.theme;
  const ViewOverlay overlay{session_, context.view, context.view_state, frame.view, theme};
  // Handles for the mouse, omitted in a picture of the mesh alone.
  const ViewportScene shown = scene(static_cast<double>(theme.scale));
  const Overlay handles{overlay, viewport_, shown};
  // Clip overlays of the mesh to its view, beside which lie the legend's strip and the compared
  // mesh.
  const auto clip = [&] {
    const ScreenBox seen = frame.view.viewport();
    list.PushClipRect(static_cast<ImVec2>(seen.min), static_cast<ImVec2>(seen.max), true);
  };
  clip();
  if (!frame.space) draw_pins(list, overlay);
  if (!frame.mesh_alone) draw_overlay(list, handles);
  draw_marks(list, frame, overlay);
  list.PopClipRect();
  draw_comparison(list, context.view, theme, box_of(room_under_banner(frame)));
  // A picture needs a separate legend card: the mouse acts on that of the window.
  LegendCard of_picture;
  LegendCard& legend = &frame.lens == &lens_ ? legend_card_ : of_picture;
  draw_legend(list, frame, legend);
  if (!frame.space)
    draw_foot(list, frame, overlay, legend);
  else if (!frame.mesh_alone)
    draw_space_mode(list, overlay);
  // Handles and their labels are drawn above everything else.
  clip();
  if (!frame.mesh_alone) draw_handles(list, handles);
  // Draw the measurement above the hint on the ruler.
  if (context.view_state.ruler && !frame.mesh_alone) draw_ruler(list, overlay, ruler_);
  list.PopClipRect();
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
    const float banner = banner_height(frame.context, area.width);
    area.y += banner;
    area.height -= banner;
  }
  return area;
}

/// Draws the foot above a card, and beside a pinned magnifier or a legend in that corner.
void ViewportPane::draw_foot(ImDrawList& list, const MeshFrame& frame, const ViewOverlay& overlay,
                             const LegendCard& card) const {
  ScreenBox room = frame.view.viewport();
  if (!frame.mesh_alone && control_.navigator().card())
    room.max = ScreenPoint(room.max.x(), control_.navigator().card()->min.y());
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
  if (viewport_.looks_around()) return ImGuiMouseCursor_ResizeAll;
  const MeshPicker& picker = viewport_.picker();
  if (viewport_.mover().handle() || viewport_.cut_part() != CutPart::none || picker.takes() ||
      picker.pivot_source() || !picker.held().empty())
    return ImGuiMouseCursor_Hand;
  return std::nullopt;
}

}  // namespace winslow::gui
