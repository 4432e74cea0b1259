#include "gui/shell/workbench/workbench.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "gui/menu/shortcuts.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/gl.h"
#include "gui/shell/workbench/panel_list.h"
#include "gui/view/navigation/go_to.h"

namespace winslow::gui {

namespace {

constexpr int samples = 4;

bool popup_open() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

/// Esc closes an open list or menu, and does nothing else then. Dear ImGui does so only where the
/// keyboard moves through its widgets.
void close_list() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.OpenPopupStack.empty() || !ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) return;
  const ImGuiWindow* window = g.OpenPopupStack.back().Window;
  if (!window) return;
  const std::string_view name = window->Name;
  if (!name.starts_with("##Combo_") && !name.starts_with("##Menu_")) return;
  ImGui::ClosePopupToLevel(g.OpenPopupStack.Size - 1, true);
  g.IO.KeysDownDuration[GLFW_KEY_ESCAPE] = g.IO.DeltaTime;  // no longer just pressed
}

}  // namespace

Workbench::Workbench(const WorkbenchOptions& options)
    : options_(options),
      settings_file_(options.profile),
      ui_(std::make_unique<UiLayer>(options.scale)),
      autosave_(options.profile),
      panels_(make_panels()) {
  take_settings(settings_file_.initial());
}

Workbench::~Workbench() {
  if (session_.files().quit_accepted()) autosave_.finish();
}

void Workbench::apply(const Action& action) {
  std::visit([this](const auto& group) { apply_group(group); }, action);
}

bool Workbench::poll() {
  const bool drawn = mesh_view_.poll();
  const bool compared = before_.poll();
  const bool captured = capture_.poll();
  const bool pictured = shows_welcome() && welcome_.busy();
  const bool changed = session_.poll();
  return autosave_.update(session_) || drawn || compared || captured || pictured || changed;
}

bool Workbench::settled() const {
  if (session_.working() || mesh_view_.busy() || before_.busy() || capture_.busy() ||
      file_dialog().busy())
    return false;
  if (demo_.demo() && (demo_.automatic() || !demo_.ready(session_))) return false;
  if (shows_welcome() && welcome_.busy()) return false;
  if (!session_.document()) return true;
  const auto& measured = session_.quality().latest();
  return measured && measured->shape == session_.shape() && measured->field == view_.color;
}

void Workbench::update(const InputState& input, int width, int height, double seconds) {
  width_ = std::max(width, 1);
  height_ = std::max(height, 1);
  poll();
  before_.update(session_, view_);
  ui_->set_scale(scale());
  ui_->set_palette(view_.lightness == Lightness::dark ? dark_palette() : light_palette());
  ui_->begin(input, width_, height_, seconds);
  demo_.update(session_, seconds, actions_);
  take_input(input);
  draw_menu();
  const Area& v = layout_.viewport;
  camera_.set_viewport(v.x, v.y, v.width, v.height);
  if (generation_ != session_.generation()) look_at_start();
  view_state_.can_go_back = view_history_.can_go_back(camera_);
  view_state_.can_go_forward = view_history_.can_go_forward();
  draw_regions();
  draw_splitters();
  draw_viewport();
  dialogs_.draw(context(), Vec2(width_, height_), Vec2(v.width, v.height));
  drive_viewport(input);
  view_history_.observe(camera_, viewport_.gesture() != Viewport::Gesture::none, seconds);
  dispatch();
  finish_frame();
  follow_files(seconds);
  forget_pictures(seconds);
  keep_settings(seconds);
}

void Workbench::take_input(const InputState& input) {
  take_dropped(input);
  const bool listed = popup_open();
  close_list();
  if (listed || ui_->wants_keyboard()) return;
  if (view_state_.box_zoom_armed && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
    view_state_.box_zoom_armed = false;
    return;
  }
  release_lens();
  handle_shortcuts(context(), viewport_.dragging());
}

void Workbench::dispatch() {
  view_state_.go_to_wanted = false;
  // Actions may bring forth others (a choice in a dialog); those come in the same frame.
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    const Action action = actions_[i];
    apply(action);
  }
  actions_.clear();
}

void Workbench::finish_frame() {
  if (generation_ != session_.generation()) look_at_start();
  if (session_.mesh().boundary() && !session_.in_motion())
    reach_ = session_.mesh().boundary()->reach(session_.selection().markers(),
                                               session_.selection().pivot());
  session_.quality().watch(view_.color);
  update_mesh_view();
  draw_overlays(*ImGui::GetBackgroundDrawList());
  ui_->end();
  capture_.after_frame(*this);
}

void Workbench::paint() {
  glViewport(0, 0, width_, height_);
  glDisable(GL_SCISSOR_TEST);
  const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(
      (view_.lightness == Lightness::dark ? dark_palette() : light_palette()).card);
  glClearColor(ground.x, ground.y, ground.z, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  tile_ = {0, 0, static_cast<float>(width_), static_cast<float>(height_)};
  mesh_view_.draw_kept(camera_, width_, height_);
  ui_->paint();
}

Image Workbench::picture() {
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  FrameBuffer buffer(width_, height_, samples);
  buffer.bind();
  paint();
  Image image = buffer.read();
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(bound));
  return image;
}

int Workbench::cursor() const {
  if (viewport_.gesture() == Viewport::Gesture::pan ||
      viewport_.gesture() == Viewport::Gesture::box)
    return ImGuiMouseCursor_ResizeAll;
  if (viewport_.dragging() || viewport_.over_body() || viewport_.hovered_handle() != Handle::none ||
      viewport_.hovered_node())
    return ImGuiMouseCursor_Hand;
  return ui_->cursor();
}

std::string Workbench::title() const {
  const Document* document = session_.document();
  if (!document) return "winslow";
  return (document->modified() ? "* " : "") + document->name() + " - winslow";
}

void Workbench::on(const action::InspectNode& a) {
  session_.apply(action::SelectNode{a.node});
  if (!a.node) return;
  view_.side_tab = SideTab::vcv;
  view_.right_panel = true;
  // A number that was typed may be that of a node anywhere.
  if (session_.nodes().inspected() != a.node) return;
  const Vec2 pixel =
      camera_.to_screen(session_.coordinates().xy(*a.node)) - camera_.viewport_origin();
  const Vec2 size(camera_.viewport_width(), camera_.viewport_height());
  if ((pixel.array() >= 0).all() && (pixel.array() <= size.array()).all()) return;
  const Bounds box = surroundings({MeshItem::Kind::node, *a.node}, session_);
  on(action::LookAt{box.centre(), 4 * box.size().norm()});
}

void Workbench::on(const action::RestoreSession& a) {
  const Document* document = session_.document();
  if (a.discard_changes || !document || !(document->modified() || session_.in_motion()))
    return autosave_.restore(a.folder);
  session_.messages().ask(
      {Prompt::Kind::question,
       "Discard the changes?",
       document->name() + " has changes that are not saved. Restoring the session would lose them.",
       {{"Discard and restore", {action::RestoreSession{a.folder, true}}, false},
        {"Cancel", {}, true}}});
}

}  // namespace winslow::gui
