#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "gui/panels/banner_panel.h"
#include "gui/shell/workbench/workbench.h"
#include "gui/view/navigation/go_to.h"
#include "gui/view/overlays/overlay.h"
#include "gui/view/overlays/view_overlay.h"

namespace winslow::gui {

namespace {

// Held longer than this, the magnifier's key is let go of to be rid of it.
constexpr float tap_seconds = 0.4f;

/// Moves what is in the middle of the view up, and away, so that a card at its foot does not cover
/// it. A card that does not reach the middle leaves it alone.
void look_above(Camera& camera, const WidgetMap::Rect& card) {
  const Vec2 origin = camera.viewport_origin();
  const double width = camera.viewport_width(), height = camera.viewport_height();
  const double free = card.min.y() - origin.y();
  if (card.max.x() < origin.x() + width / 2 || free < height / 4) return;
  const double unit = camera.units_per_pixel() * std::min(width, height) / std::min(width, free);
  camera.look_at(camera.centre() - Vec2(0, (height - free) / 2 * unit), unit);
}

}  // namespace

ViewportScene Workbench::scene() const {
  ViewportScene scene;
  scene.boundary = session_.mesh().boundary();
  scene.selection = session_.selection().markers();
  scene.pivot = session_.selection().pivot();
  scene.reach = reach_;
  if (viewport_.gesture() == Viewport::Gesture::rotate)
    scene.turned = viewport_.drag().motion().rotate;
  scene.scale = static_cast<double>(ui_->theme().scale);
  scene.box_zoom = view_state_.box_zoom_armed;
  scene.wheel_is_lens = lens_ && !lens_->pinned && !ImGui::GetIO().KeyCtrl;
  scene.shape = session_.selection().shape_edit();
  if (const auto& anchors = session_.selection().anchors())
    for (const PivotPlace place : {PivotPlace::leading_edge, PivotPlace::trailing_edge,
                                   PivotPlace::centroid, PivotPlace::centre})
      scene.snaps.emplace_back(anchors->at(place), pivot_place_name(place));
  return scene;
}

void Workbench::drive_viewport(const InputState& input) {
  const Area& v = layout_.viewport;
  const auto x = static_cast<float>(input.mouse.x());
  const auto y = static_cast<float>(input.mouse.y());
  PointerState pointer;
  pointer.position = input.mouse;
  pointer.over = input.mouse_inside && session_.document() && !ui_->wants_mouse() && x >= v.x &&
                 x < v.x + v.width && y >= v.y && y < v.y + v.height;
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
  pointer_ = input.mouse;
  pointer_over_ = pointer.over;
  if (viewport_.gesture() == Viewport::Gesture::none) take_for_insets(pointer);
  const bool nodes = !view_state_.box_zoom_armed &&
                     (input.alt() || (view_.right_panel && view_.side_tab == SideTab::vcv));
  pointer.click_taken =
      node_tool_.update(pointer, nodes, scene().scale, session_, camera_, actions_);
  viewport_.update(pointer, scene(), camera_, actions_);
  if (viewport_.gesture() == Viewport::Gesture::box) view_state_.box_zoom_armed = false;
  lens_ = magnifier_inset(view_.magnifier, camera_, pointer_, pointer_over_, scene().scale);
}

/// What lies over the mesh and takes the mouse before it: the legend's threshold, the magnifier.
void Workbench::take_for_insets(PointerState& pointer) {
  const bool taken =
      legend_card_.take_pointer(context(), pointer.position, pointer.over && pointer.left);
  const Vec2 off = lens_ ? Vec2(pointer.position - lens_->frame().min) : Vec2(-1, -1);
  const bool in_lens =
      lens_ && (off.array() >= 0).all() && (off.array() < lens_->frame().size().array()).all();
  const bool turn =
      lens_ && in_lens && pointer.over && pointer.wheel != 0 && (lens_->pinned || !pointer.control);
  if (turn) {
    context().edit_view([&](ViewOptions& view) {
      view.magnifier.factor = turned_factor(view.magnifier.factor, pointer.wheel);
    });
  }
  if (taken || (in_lens && lens_->pinned)) pointer.over = false;
}

void Workbench::look_at_start() {
  generation_ = session_.generation();
  view_history_.clear();
  welcome_.close();
  view_state_ = ViewState();
  view_.magnifier.pin.reset();
  const Document* document = session_.document();
  if (!document) return;
  const Bounds all = bounds(document->state().mesh);
  std::vector<Index> holes;
  for (const auto& body : session_.mesh().boundary()->bodies())
    if (body.hole) holes.insert(holes.end(), body.nodes.begin(), body.nodes.end());
  if (!holes.empty()) {
    Bounds bodies = bounds(document->state().mesh.coordinates, holes);
    // With a far field of a hundred chords the bodies would be a dot.
    if (bodies.size().maxCoeff() < 0.15 * all.size().maxCoeff()) {
      const Vec2 room = Vec2::Constant(0.6 * bodies.size().maxCoeff());
      return camera_.fit({bodies.min - room, bodies.max + room});
    }
  }
  camera_.fit(all);
}

void Workbench::on(const action::FitView&) {
  const Document* document = session_.document();
  if (!document) return;
  view_history_.leave(camera_);
  camera_.fit(bounds(Mesh{session_.topology(), session_.coordinates()}));
}

void Workbench::on(const action::FitSelection&) {
  if (!session_.document() || session_.selection().empty()) return;
  view_history_.leave(camera_);
  std::vector<Index> nodes;
  for (Index m : session_.selection().markers()) {
    const auto of_marker = session_.topology()->marker_nodes(m);
    nodes.insert(nodes.end(), of_marker.begin(), of_marker.end());
  }
  camera_.fit(bounds(session_.coordinates(), nodes), 0.2);
}

void Workbench::on(const action::LookAt& a) {
  view_history_.leave(camera_);
  const Vec2 half = Vec2::Constant(a.radius);
  camera_.fit({a.point - half, a.point + half});
  if (!demo_.demo()) return;
  if (const auto card = ui_->widgets().find("demo/card")) look_above(camera_, *card);
}

void Workbench::on(const action::ZoomTo& a) {
  view_history_.leave(camera_);
  camera_.fit(a.box, 0);
}

void Workbench::on(const action::BoxZoom&) {
  view_state_.box_zoom_armed = session_.document() && !view_state_.box_zoom_armed;
}

void Workbench::on(const action::GoTo& a) {
  if (a.item && !exists(*a.item, session_)) return;
  view_state_.focus = a.item;
  if (!a.item) return;
  const Bounds box = surroundings(*a.item, session_);
  on(action::LookAt{box.centre(), 4 * box.size().norm()});
}

void Workbench::on(const action::AskGoTo&) {
  if (!session_.document()) return;
  view_.right_panel = true;
  view_.side_tab = SideTab::quality;
  view_state_.go_to_wanted = true;
}

void Workbench::on(const action::PinMagnifier&) {
  if (!session_.document()) return;
  if (view_.magnifier.on && view_.magnifier.pin) {
    view_.magnifier.pin.reset();
    view_.magnifier.on = false;
    return;
  }
  const Vec2 place = pointer_over_ ? camera_.to_world(pointer_) : camera_.centre();
  view_.magnifier.on = true;
  view_.magnifier.pin = {{place.x(), place.y()}};
}

void Workbench::release_lens() {
  const bool held = ImGui::GetIO().KeysDownDurationPrev[GLFW_KEY_M] > tap_seconds;
  if (held && ImGui::IsKeyReleased(GLFW_KEY_M) && !view_.magnifier.pin) view_.magnifier.on = false;
}

void Workbench::update_mesh_view() {
  before_.update(session_, view_);
  mesh_view_.update(session_, before_, view_, ui_->theme().scale);
  const double left = camera_.viewport_origin().x();
  const double middle = left + view_.divider * camera_.viewport_width();
  mesh_view_.set_divider(camera_.to_world(Vec2(middle, 0)).x());
}

void Workbench::draw_overlays(ImDrawList& list) {
  if (!session_.document()) return;
  const Theme& theme = ui_->theme();
  // What is for the mouse's sake: a picture of the mesh alone has none of it.
  const ViewportScene shown = scene();
  const Overlay handles{session_, viewport_, shown, camera_, theme};
  if (mesh_alone_)
    draw_pins(list, handles);
  else
    draw_overlay(list, handles);
  const ViewOverlay overlay{session_, view_, view_state_, camera_, theme};
  draw_rim(list, overlay);
  id_labels_.draw(list, overlay);
  draw_focus(list, overlay);
  draw_comparison(list, overlay);
  draw_legend_card(list);
  // Nothing covers what the mouse is about to take hold of, nor what it says of it.
  if (!mesh_alone_) draw_handles(list, handles);
  if (lens_) {
    draw_inset_source(list, theme, *lens_);
    list.AddCallback(
        [](const ImDrawList*, const ImDrawCmd* command) {
          static_cast<Workbench*>(command->UserCallbackData)->paint_lens();
        },
        this);
    draw_inset_frame(list, overlay, *lens_);
  }
  if (const auto box = viewport_.box()) draw_zoom_box(list, theme, *box);
  if (!mesh_alone_) draw_mouse_labels(list, handles);
}

void Workbench::draw_legend_card(ImDrawList& list) {
  const auto& legend = mesh_view_.legend();
  if (!legend || !view_.legend || !view_.fill) return legend_card_.hide();
  Area area = layout_.viewport;
  if (session_.messages().banner() && !mesh_alone_) {
    const float banner = BannerPanel::height(context(), area.width);
    area.y += banner;
    area.height -= banner;
  }
  legend_card_.draw(list, context(), area, *legend);
}

}  // namespace winslow::gui
