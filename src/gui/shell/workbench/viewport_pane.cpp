#include "gui/shell/workbench/viewport_pane.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "gui/panels/banner_panel.h"
#include "gui/view/overlays/overlay.h"
#include "gui/view/overlays/view_overlay.h"

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
  return pointer;
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
  scene.shape = session_.selection().shape_edit();
  if (const auto& anchors = session_.selection().anchors())
    for (const PivotPlace place : {PivotPlace::leading_edge, PivotPlace::trailing_edge,
                                   PivotPlace::centroid, PivotPlace::centre})
      scene.snaps.emplace_back(anchors->at(place), pivot_place_name(place));
  return scene;
}

void ViewportPane::drive(const InputState& input, const PanelContext& context, const Area& area) {
  const auto x = static_cast<float>(input.mouse.x());
  const auto y = static_cast<float>(input.mouse.y());
  const bool over = input.mouse_inside && session_.document() &&
                    !UiLayer::current().wants_mouse() && x >= area.x && x < area.x + area.width &&
                    y >= area.y && y < area.y + area.height;
  PointerState pointer = pointer_of(input, over);
  control_.set_mouse(over ? std::optional(input.mouse) : std::nullopt);
  if (viewport_.gesture() == Viewport::Gesture::none) take_for_insets(pointer, context);
  const ViewOptions& view = control_.options();
  const auto scale = static_cast<double>(context.theme.scale);
  const bool nodes = !control_.state().box_zoom_armed &&
                     (input.alt() || (view.right_panel && view.side_tab == SideTab::vcv));
  pointer.click_taken =
      node_tool_.update(pointer, nodes, scale, session_, control_.view(), context.actions);
  viewport_.update(pointer, scene(scale), control_.view(), context.actions);
  if (viewport_.gesture() == Viewport::Gesture::box) control_.disarm_box_zoom();
  lens_.place(magnifier_inset(view.magnifier, control_.camera(), input.mouse, over, scale));
}

/// What lies over the mesh and takes the mouse before it: the legend's threshold, the magnifier.
void ViewportPane::take_for_insets(PointerState& pointer, const PanelContext& context) {
  const bool taken =
      legend_card_.take_pointer(context, pointer.position, pointer.over && pointer.left);
  const auto& lens = lens_.inset();
  const bool in_lens = lens && lens->frame().contains(pointer.position);
  const bool turn =
      lens && in_lens && pointer.over && pointer.wheel != 0 && (lens->pinned || !pointer.control);
  if (turn) {
    context.edit_view([&](ViewOptions& view) {
      view.magnifier.factor = turned_factor(view.magnifier.factor, pointer.wheel);
    });
  }
  if (taken || (in_lens && lens->pinned)) pointer.over = false;
}

void ViewportPane::measure_selection() {
  if (session_.mesh().boundary() && !session_.in_motion())
    reach_ = session_.mesh().boundary()->reach(session_.selection().markers(),
                                               session_.selection().pivot());
}

void ViewportPane::follow_mesh(const ViewOptions& options, float scale) {
  before_.update(session_, options);
  mesh_view_.update(session_, before_, options, scale);
}

void ViewportPane::update(const ViewOptions& options, const View& view, float scale) {
  follow_mesh(options, scale);
  const ScreenBox seen = view.viewport();
  const double middle = seen.min.x() + options.divider * seen.size().x();
  mesh_view_.set_divider(view.to_plane(ScreenPoint(middle, 0)).x());
}

void ViewportPane::draw_overlays(ImDrawList& list, const MeshFrame& frame) {
  if (!session_.document()) return;
  const PanelContext& context = frame.context;
  const Theme& theme = context.theme;
  // What is for the mouse's sake: a picture of the mesh alone has none of it.
  const ViewportScene shown = scene(static_cast<double>(theme.scale));
  const Overlay handles{session_, viewport_, shown, frame.view, theme};
  if (frame.mesh_alone)
    draw_pins(list, handles);
  else
    draw_overlay(list, handles);
  const ViewOverlay overlay{session_, context.view, context.view_state, frame.view, theme};
  draw_rim(list, overlay);
  id_labels_.draw(list, overlay);
  draw_focus(list, overlay);
  draw_comparison(list, overlay);
  draw_legend(list, frame);
  // Nothing covers what the mouse is about to take hold of, nor what it says of it.
  if (!frame.mesh_alone) draw_handles(list, handles);
  frame.lens.draw(list, overlay);
  if (const auto box = viewport_.box()) draw_zoom_box(list, theme, *box);
  if (!frame.mesh_alone) draw_mouse_labels(list, handles);
}

void ViewportPane::draw_legend(ImDrawList& list, const MeshFrame& frame) {
  const auto& legend = mesh_view_.legend();
  const ViewOptions& view = frame.context.view;
  if (!legend || !view.legend || !view.fill) return legend_card_.hide();
  Area area = frame.area;
  if (session_.messages().banner() && !frame.mesh_alone) {
    const float banner = BannerPanel::height(frame.context, area.width);
    area.y += banner;
    area.height -= banner;
  }
  legend_card_.draw(list, frame.context, area, *legend);
}

std::optional<int> ViewportPane::cursor() const {
  if (viewport_.gesture() == Viewport::Gesture::pan ||
      viewport_.gesture() == Viewport::Gesture::box)
    return ImGuiMouseCursor_ResizeAll;
  if (viewport_.dragging() || viewport_.over_body() || viewport_.hovered_handle() != Handle::none ||
      viewport_.hovered_node())
    return ImGuiMouseCursor_Hand;
  return std::nullopt;
}

}  // namespace winslow::gui
