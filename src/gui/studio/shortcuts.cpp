#include "gui/studio/shortcuts.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace winslow::gui {

namespace {

bool pressed(int key) { return ImGui::IsKeyPressed(key, false); }

void with_control(const PanelContext& context, bool shift) {
  using action::FilePurpose;
  const bool saved_as = shift && pressed(GLFW_KEY_S);
  if (pressed(GLFW_KEY_O)) context.emit(action::ShowFileDialog{FilePurpose::open_mesh});
  if (context.session.document()) {
    if (saved_as) context.emit(action::ShowFileDialog{FilePurpose::save_mesh});
    if (!shift && pressed(GLFW_KEY_S)) context.emit(action::SaveMesh{});
    if (pressed(GLFW_KEY_E) && context.session.document()->history().position() > 0)
      context.emit(action::ShowFileDialog{FilePurpose::export_recipe});
    if (pressed(GLFW_KEY_R)) context.emit(action::GoToStep{0});
  }
  if (!shift && pressed(GLFW_KEY_Z)) context.emit(action::Undo{});
  if ((shift && pressed(GLFW_KEY_Z)) || pressed(GLFW_KEY_Y)) context.emit(action::Redo{});
  if (pressed(GLFW_KEY_Q)) context.emit(action::Quit{});
  if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD)) context.emit(action::StepScale{1});
  if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT)) context.emit(action::StepScale{-1});
  if (pressed(GLFW_KEY_0) || pressed(GLFW_KEY_KP_0)) context.emit(action::StepScale{0});
  if (pressed(GLFW_KEY_D)) {
    ViewOptions view = context.view;
    view.lightness = view.lightness == Lightness::dark ? Lightness::light : Lightness::dark;
    context.emit(action::SetView{view});
  }
}

void of_view(const PanelContext& context, bool shift) {
  if (pressed(GLFW_KEY_F)) {
    if (shift)
      context.emit(action::FitSelection{});
    else
      context.emit(action::FitView{});
  }
  ViewOptions view = context.view;
  if (pressed(GLFW_KEY_W)) step_style(view);
  if (pressed(GLFW_KEY_L)) view.legend = !view.legend;
  if (pressed(GLFW_KEY_F2)) view.left_panel = !view.left_panel;
  if (pressed(GLFW_KEY_F3)) view.right_panel = !view.right_panel;
  if (pressed(GLFW_KEY_F4)) view.plot_panel = !view.plot_panel;
  if (view != context.view) context.emit(action::SetView{view});
  if (pressed(GLFW_KEY_F1)) context.emit(action::ShowHelp{});
  if (!pressed(GLFW_KEY_F12)) return;
  if (shift)
    context.emit(action::ShowFileDialog{action::FilePurpose::screenshot});
  else
    context.emit(action::TakeScreenshot{});
}

void of_solver(const PanelContext& context, bool shift, bool dragging) {
  const JobRunner& job = context.session.job();
  if (!context.session.document() || dragging) return;
  if (pressed(GLFW_KEY_SPACE)) {
    if (job.active() && !job.paused())
      context.emit(action::PauseSolver{});
    else
      context.emit(action::RunSmooth{});
  }
  if (pressed(GLFW_KEY_N)) context.emit(action::StepSolver{shift ? 10 : 1});
  if (!pressed(GLFW_KEY_ESCAPE)) return;
  if (job.active())
    context.emit(action::CancelSolver{});
  else
    context.emit(action::SelectMarkers{});
}

}  // namespace

void handle_shortcuts(const PanelContext& context, bool dragging) {
  const ImGuiIO& io = ImGui::GetIO();
  // Super stands in for Control where keyboards have it.
  if (io.KeyCtrl || io.KeySuper) return with_control(context, io.KeyShift);
  if (io.KeyAlt) return;
  of_view(context, io.KeyShift);
  of_solver(context, io.KeyShift, dragging);
}

}  // namespace winslow::gui
