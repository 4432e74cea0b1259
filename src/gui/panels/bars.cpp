#include "gui/panels/panels.h"

#include "gui/base/text.h"
#include "gui/document/session/session.h"
#include "gui/menu/user_command.h"
#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Draws a command as a button: icon and word if there is room, otherwise only the icon; only the
/// word if the icon font is missing.
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

struct State {
  std::string text;
  ImU32 color;
};

/// The effect of a click while no work is in progress.
State mode_of(const PanelContext& context) {
  if (context.view_state.ruler) return {"Ruler", palette().accent};
  if (context.view_state.box_zoom_armed) return {"Zoom to a box", palette().accent};
  if (context.session.selection().shape_edit().active)
    return {"Editing boundary nodes", palette().accent};
  return {"Ready", palette().text_dim};
}

/// A coordinate with enough decimals to distinguish adjacent pixels.
std::string coordinate(double value, double pixel) {
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(pixel))), 0, 15);
  return formatted(value, ("%." + std::to_string(digits) + "f").c_str());
}

/// "slat   e120   x 1.20   y 0.30   z 0.00"; for a plane mesh only the coordinates.
std::string under_mouse(const PanelContext& context) {
  const auto& cursor = context.view_state.cursor;
  const auto& seen = context.view_state.seen;
  std::string text;
  if (seen) {
    const auto& markers = context.topology()->markers();
    if (seen->marker >= 0 && at(seen->marker) < markers.size())
      text += markers[at(seen->marker)].name + "   ";
    text += "e" + std::to_string(seen->element) + "   ";
    if (seen->node) text += "n" + std::to_string(*seen->node) + "   ";
  }
  std::span<const double> place;
  if (seen) place = {seen->point.data(), 3};
  if (cursor) place = {cursor->data(), 2};
  for (std::size_t k = 0; k < place.size(); ++k)
    text += std::string(k > 0 ? "   " : "") + "xyz"[k] + " " +
            coordinate(place[k], context.view_state.pixel);
  return text;
}

/// Draws the position at the right end, where it reduces only the room of the notice. Returns its
/// left end.
float draw_cursor(const PanelContext& context) {
  const float end = ImGui::GetWindowContentRegionMax().x;
  const std::string text = under_mouse(context);
  if (text.empty()) return end;
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  const float line = ImGui::GetCursorPosY();
  const float back = ImGui::GetCursorPosX();
  ImGui::SetCursorPos(ImVec2(end - width, line));
  ui::text_dim(text);
  ui::note("status/cursor");
  ui::tooltip("What is under the mouse, and where that is, in units of the mesh.");
  ImGui::SetCursorPos(ImVec2(back, line));
  // Rounded to steps, so that items to the left do not move with every digit.
  const float step = context.theme.px(40);
  return end - std::ceil((width + context.theme.px(12)) / step) * step;
}

ImU32 notice_color(Notice::Kind kind) {
  if (kind == Notice::Kind::success) return palette().success;
  return kind == Notice::Kind::warning ? palette().warning : palette().text_dim;
}

void separator() {
  ImGui::SameLine(0, ImGui::GetFontSize());
  ui::text_colored(palette().border, "|");
  ImGui::SameLine(0, ImGui::GetFontSize());
}

void draw_mesh(const PanelContext& context) {
  const Topology& topology = *context.topology();
  separator();
  ui::text_dim(counted(topology.node_count(), "node"));
  separator();
  ui::text_dim(counted(topology.element_count(), "element"));
  separator();
  if (!context.shown) return;
  const Validity& validity = context.shown->validity;
  const bool in_volume = context.session.kind() == MeshKind::volume;
  ui::text_dim((in_volume ? "min scaled Jacobian " : "min sine ") +
               table_number(validity.min_sine));
  ui::tooltip(in_volume ? "Smallest scaled Jacobian of the elements that can move."
                        : "Smallest sine of any corner angle. Positive: every element is valid.");
  separator();
  if (validity.inverted > 0)
    ui::text_colored(palette().danger, grouped(validity.inverted) + " inverted");
  else
    ui::text_dim("0 inverted");
}

}  // namespace

/// The row of buttons beneath the menu: the most frequent commands.
void draw_toolbar(const PanelContext& context) {
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
  // These arrows are well known from browsers.
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

/// One line: the mesh, its quality, the solver's activity.
void draw_status(const PanelContext& context) {
  ImGui::PushFont(context.theme.small);
  const float end = draw_cursor(context);
  const Activity activity = activity_of(context.session);
  const bool blocked = activity.kind == Activity::Kind::blocked;
  const State state = activity.kind == Activity::Kind::idle
                          ? mode_of(context)
                          : State{activity.text, blocked ? palette().danger : palette().accent};
  ui::text_colored(state.color, state.text);
  ui::note("status/state");
  if (context.session.document()) draw_mesh(context);
  if (const auto& notice = context.session.messages().notice()) {
    separator();
    const float room = end - ImGui::GetCursorPosX();
    ui::text_colored(notice_color(notice->kind), ui::elided(notice->text, room));
    ui::tooltip(notice->text);
  }
  ImGui::PopFont();
}

}  // namespace winslow::gui
