#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cctype>

#include "gui/widgets/controls.h"
#include "gui/widgets/ui_layer.h"

/// Widgets that choose one of several things: lists and tabs.
namespace winslow::gui::ui {

namespace {

/// The item of an open list that the arrow keys have come to, and whether Enter takes it.
struct ListKeys {
  std::size_t at = 0;
  bool moved = false, taken = false;
};
ListKeys follow_keys(std::size_t count, std::size_t chosen) {
  ImGuiStorage& state = *ImGui::GetStateStorage();
  const ImGuiID key = ImGui::GetID("list_keys");
  if (ImGui::IsWindowAppearing()) state.SetInt(key, static_cast<int>(chosen));
  const int last = static_cast<int>(count) - 1;
  const int before = std::clamp(state.GetInt(key, 0), 0, std::max(last, 0));
  int at = before;
  if (ImGui::IsKeyPressed(GLFW_KEY_DOWN)) at = std::min(at + 1, last);
  if (ImGui::IsKeyPressed(GLFW_KEY_UP)) at = std::max(at - 1, 0);
  if (ImGui::IsKeyPressed(GLFW_KEY_HOME)) at = 0;
  if (ImGui::IsKeyPressed(GLFW_KEY_END)) at = last;
  state.SetInt(key, at);
  return {
      static_cast<std::size_t>(std::max(at, 0)), at != before,
      ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false)};
}

float widest(const std::vector<std::string>& items) {
  float width = 0;
  for (const std::string& item : items)
    width = std::max(width, ImGui::CalcTextSize(item.c_str()).x);
  return width;
}

/// Of a list that fills the rest of a row: where the longest of its items has no room beside the
/// label, it takes a line of its own below it. Returns the room for an item.
float room_for_items(float wanted) {
  const float frame = ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
  const auto& next = ImGui::GetCurrentContext()->NextItemData;
  const bool fills = (next.Flags & ImGuiNextItemDataFlags_HasWidth) != 0 && next.Width < 0;
  if (!fills) return ImGui::CalcItemWidth() - frame;
  // A window that becomes as wide as what it holds begins without a width.
  const auto* window = ImGui::GetCurrentContext()->CurrentWindow;
  const bool grows = (window->Flags & ImGuiWindowFlags_AlwaysAutoResize) != 0;
  const bool beside = !grows && ImGui::GetCursorPosX() > ImGui::GetCursorStartPos().x + 1;
  if (beside && wanted + frame > ImGui::GetContentRegionAvail().x) {
    ImGui::NewLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
  }
  return ImGui::GetContentRegionAvail().x - frame;
}

}  // namespace

bool combo(std::string_view id, const std::vector<std::string>& items, std::size_t& chosen,
           std::string_view tip) {
  const std::string preview = chosen < items.size() ? items[chosen] : std::string();
  const float wanted = widest(items);
  const float room = room_for_items(wanted);
  // As many items as there are formats are seen without scrolling.
  const bool open = ImGui::BeginCombo(("##" + std::string(id)).c_str(), preview.c_str(),
                                      ImGuiComboFlags_HeightLarge);
  note_label(id, wanted, room);
  if (!open) {
    tooltip(tip);
    return false;
  }
  const std::size_t before = chosen;
  const ListKeys keys = follow_keys(items.size(), chosen);
  for (std::size_t i = 0; i < items.size(); ++i) {
    // What the keys have come to is lit; what the mouse is over lights up by itself.
    if (ImGui::Selectable(items[i].c_str(), i == keys.at)) chosen = i;
    note(std::string(id) + "/" + items[i]);
    if (i == before && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    if (i == keys.at && keys.moved) ImGui::SetScrollHereY();
  }
  if (keys.taken && keys.at < items.size()) {
    chosen = keys.at;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndCombo();
  return chosen != before;
}

bool tabs(std::string_view id, const std::vector<Tab>& items, std::size_t& chosen) {
  const Theme& theme = UiLayer::current().theme();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x / static_cast<float>(items.size());
  const float height = theme.px(28);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine(ImVec2(start.x, start.y + height),
               ImVec2(start.x + width * static_cast<float>(items.size()), start.y + height),
               palette().border);
  bool changed = false;
  for (std::size_t k = 0; k < items.size(); ++k) {
    std::string name(id);
    name += '/';
    for (char c : items[k].label)
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const ImVec2 min(start.x + width * static_cast<float>(k), start.y);
    ImGui::SetCursorScreenPos(min);
    if (ImGui::InvisibleButton(name.c_str(), ImVec2(std::max(width, 1.0f), height)) &&
        k != chosen) {
      chosen = k;
      changed = true;
    }
    note(name);
    const bool over = ImGui::IsItemHovered();
    tooltip(items[k].tooltip);
    const bool present = k == chosen;
    ImFont* font = present ? theme.bold : theme.regular;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, items[k].label.c_str());
    list.AddText(font, font->FontSize,
                 ImVec2(min.x + (width - size.x) / 2, min.y + (height - size.y) / 2),
                 present || over ? palette().text : palette().text_dim, items[k].label.c_str());
    if (present)
      list.AddRectFilled(ImVec2(min.x, min.y + height - theme.px(2)),
                         ImVec2(min.x + width, min.y + height), palette().accent);
  }
  ImGui::SetCursorScreenPos(ImVec2(start.x, start.y + height + theme.px(8)));
  return changed;
}

}  // namespace winslow::gui::ui
