#include "gui/panels/toolbar.h"

#include <string>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Icon and word where there is room, the icon alone where there is not, the word alone where the
/// icon font is missing.
bool tool(const PanelContext& context, std::string_view id, Icon icon, const std::string& word,
          const std::string& tip, bool enabled, ui::ButtonStyle style = ui::ButtonStyle::flat) {
  const std::string glyph = context.theme.icon(icon);
  const bool roomy = ImGui::GetWindowWidth() > context.theme.px(1020);
  std::string label = word;
  if (!glyph.empty()) label = roomy ? glyph + "  " + word : glyph;
  const bool pressed = ui::button(id, label, {tip, style, enabled, 0});
  ImGui::SameLine(0, context.theme.px(3));
  return pressed;
}

void gap(const PanelContext& context) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float x = at.x + context.theme.px(5);
  ImGui::GetWindowDrawList()->AddLine(
      ImVec2(x, at.y + context.theme.px(4)),
      ImVec2(x, at.y + ImGui::GetFrameHeight() - context.theme.px(4)), palette().border);
  ImGui::Dummy(ImVec2(context.theme.px(10), 1));
  ImGui::SameLine(0, context.theme.px(3));
}

}  // namespace

void Toolbar::draw(const PanelContext& context) {
  draw_files(context);
  gap(context);
  draw_solver(context);
  gap(context);
  const bool open = context.session.document() != nullptr;
  if (tool(context, "tool/fit", Icon::fit, "Fit", "Show the whole mesh (F)", open))
    context.emit(action::FitView{});
  if (tool(context, "tool/fit_selection", Icon::search, "Selection",
           "Show the selected bodies (Shift+F)", open && !context.session.selection().empty()))
    context.emit(action::FitSelection{});
  if (tool(context, "tool/screenshot", Icon::camera, "Picture",
           "Save a picture of this window (F12)", true))
    context.emit(action::TakeScreenshot{});
  ImGui::NewLine();
}

void Toolbar::draw_files(const PanelContext& context) {
  const Document* document = context.session.document();
  const bool busy = context.session.in_motion();
  if (tool(context, "tool/open", Icon::open, "Open", "Open a mesh (Ctrl+O)", true))
    context.emit(action::ShowFileDialog{action::FilePurpose::open_mesh});
  if (tool(context, "tool/save", Icon::save, "Save", "Save the mesh (Ctrl+S)",
           document && !busy && !context.session.saving()))
    context.emit(action::SaveMesh{});
  gap(context);
  if (tool(context, "tool/undo", Icon::undo, "Undo", "Undo the last command (Ctrl+Z)",
           document && (busy || document->history().can_undo())))
    context.emit(action::Undo{});
  if (tool(context, "tool/redo", Icon::redo, "Redo", "Redo (Ctrl+Shift+Z)",
           document && !busy && document->history().can_redo()))
    context.emit(action::Redo{});
  if (tool(context, "tool/reset", Icon::reset, "Reset",
           "Back to the mesh as it was opened (Ctrl+R). Redo brings the commands back.",
           document && (busy || document->history().position() > 0)))
    context.emit(action::GoToStep{0});
}

void Toolbar::draw_solver(const PanelContext& context) {
  const JobRunner& job = context.session.job();
  const bool open = context.session.document() != nullptr;
  const bool dragging = context.session.dragging();
  if (job.active() && !job.paused()) {
    if (tool(context, "tool/pause", Icon::pause, "Pause", "Stop after this iteration (Space)",
             !dragging))
      context.emit(action::PauseSolver{});
  } else if (tool(context, "tool/run", Icon::run, job.paused() ? "Resume" : "Smooth",
                  job.paused() ? "Go on (Space)" : "Smooth the mesh, its boundary held (Space)",
                  open)) {
    context.emit(action::RunSmooth{});
  }
  if (tool(context, "tool/step", Icon::step, "Step", "One outer iteration, then pause (N)",
           open && !dragging))
    context.emit(action::StepSolver{1});
  if (tool(context, "tool/cancel", Icon::stop, "Cancel",
           "Stop and put the mesh back as it was (Esc)", job.active()))
    context.emit(action::CancelSolver{});
}

}  // namespace winslow::gui
