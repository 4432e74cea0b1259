#include "gui/panels/toolbar.h"

#include <string>

#include "gui/menu/user_command.h"
#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// A command as a button: icon and word where there is room, the icon alone where there is not, the
/// word alone where the icon font is missing.
enum class Word { where_room, where_no_icon };
void tool(const PanelContext& context, std::string_view id, Icon icon, const std::string& word,
          Word when = Word::where_room) {
  const UserCommand& command = user_command(id);
  const std::string glyph = context.theme.icon(icon);
  const bool roomy = ImGui::GetWindowWidth() > context.theme.px(1130);
  std::string label = word;
  if (!glyph.empty()) label = roomy && when == Word::where_room ? glyph + "  " + word : glyph;
  const std::string reason = why_blocked(command, context);
  if (ui::button("tool/" + command.id, label,
                 {tooltip_of(command) + (reason.empty() ? "" : "\n" + reason),
                  ui::ButtonStyle::flat, reason.empty(), 0}))
    command.run(context);
  ImGui::SameLine(0, context.theme.px(3));
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
  const JobRunner& job = context.session.job();
  tool(context, "open", Icon::open, "Open");
  tool(context, "save", Icon::save, "Save");
  gap(context);
  tool(context, "undo", Icon::undo, "Undo");
  tool(context, "redo", Icon::redo, "Redo");
  tool(context, "reset", Icon::reset, "Revert");
  gap(context);
  if (job.active() && !job.paused())
    tool(context, "pause", Icon::pause, "Pause");
  else
    tool(context, "run", Icon::run, job.paused() ? "Resume" : "Smooth");
  tool(context, "step", Icon::step, "Step");
  tool(context, "cancel", Icon::stop, "Cancel");
  gap(context);
  // Everybody knows these arrows, from every browser.
  tool(context, "view_back", Icon::back, "Back", Word::where_no_icon);
  tool(context, "view_forward", Icon::forward, "Forward", Word::where_no_icon);
  tool(context, "fit", Icon::fit, "Fit");
  tool(context, "fit_selection", Icon::target, "Selection");
  tool(context, "screenshot", Icon::camera, "Picture");
  if (context.capture.recorder().state() == Recorder::State::recording)
    tool(context, "stop_recording", Icon::stop, "Stop recording");
  else
    tool(context, "record", Icon::record, "Record");
  gap(context);
  tool(context, "palette", Icon::search, "Find");
  ImGui::NewLine();
}

}  // namespace winslow::gui
