#include "gui/shell/workbench/region_window.h"

namespace winslow::gui {

namespace {

// None takes the focus as it appears: what the mouse holds in another would be let go of.
constexpr ImGuiWindowFlags fixed =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;

}  // namespace

void begin_region(const char* name, const Area& area, const RegionStyle& style) {
  ImGui::SetNextWindowPos(ImVec2(area.x, area.y));
  ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, style.background);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, style.padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  ImGui::Begin(name, nullptr, fixed | style.flags);
}

void end_region(RegionEdge edge) {
  const ImVec2 min = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  const ImVec2 max(min.x + size.x, min.y + size.y);
  if (edge == RegionEdge::line) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(min, max, false);
    list.AddRect(min, max, palette().border);
    list.PopClipRect();
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace winslow::gui
