#include "gui/panels/history_panel.h"

#include <algorithm>

#include "gui/studio/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

std::string summary(const SmoothResult& result) {
  if (result.outer_iterations == 0) return {};
  std::string text = counted(result.outer_iterations, "iteration");
  if (result.increments > 1) text += " in " + std::to_string(result.increments) + " steps";
  if (result.inverted > 0) return text + ", " + counted(result.inverted, "inverted element");
  return text + (result.converged ? ", converged" : ", not converged");
}

}  // namespace

void HistoryPanel::draw(const PanelContext& context) {
  const Document* document = context.session.document();
  if (!document) {
    ui::text_dim("No mesh is open.");
    return;
  }
  const float row = ImGui::GetTextLineHeight() + context.theme.px(12);
  const auto rows = static_cast<float>(std::clamp<std::size_t>(document->history().size(), 3, 8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2, 2));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::BeginChild("steps", ImVec2(0, row * rows + context.theme.px(6)), true);
  for (std::size_t k = 0; k < document->history().size(); ++k) draw_step(context, k);
  if (shown_size_ != document->history().size()) ImGui::SetScrollHereY(1.0f);
  shown_size_ = document->history().size();
  ImGui::EndChild();
  ImGui::PopStyleVar(2);
}

void HistoryPanel::draw_step(const PanelContext& context, std::size_t position) {
  const History& history = context.session.document()->history();
  const bool present = position == history.position();
  const bool undone = position > history.position();
  const std::string title =
      position == 0 ? "Opened " + context.session.document()->source().filename().string()
                    : describe(history.command(position));
  const std::string id = "history/" + std::to_string(position);
  const float pad = context.theme.px(6);
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() + 2 * pad);
  const ImVec2 end(start.x + size.x, start.y + size.y);
  const bool pressed = ImGui::InvisibleButton(id.c_str(), size);
  ui::note(id);
  const std::string about = position == 0 ? "" : summary(history.result(position));
  ui::tooltip(title + (about.empty() ? "" : "\n" + about) +
              (present ? "\nThis is the mesh shown." : "\nClick to go back to this mesh."));
  if (pressed && !present) context.emit(action::GoToStep{position});

  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (present)
    list.AddRectFilled(start, end, palette().accent_soft, context.theme.px(4));
  else if (ImGui::IsItemHovered())
    list.AddRectFilled(start, end, faded(palette().accent, 0.07f), context.theme.px(4));
  bool bad = false;
  if (position > 0) {
    const SmoothResult& result = history.result(position);
    bad = result.inverted > 0 || !result.converged;
  }
  const ImU32 dot = undone ? palette().border : bad ? palette().warning : palette().accent;
  list.AddCircleFilled(ImVec2(start.x + pad + context.theme.px(4), (start.y + end.y) / 2),
                       context.theme.px(3.5f), dot);
  const float x = start.x + pad + context.theme.px(16);
  const std::string text = ui::elided(title, end.x - pad - x);
  list.AddText(ImVec2(x, start.y + pad), undone ? palette().text_faint : palette().text,
               text.c_str());
}

}  // namespace winslow::gui
