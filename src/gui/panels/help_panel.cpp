#include "gui/panels/help_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gui/menu/gestures.h"
#include "gui/menu/user_command.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct Line {
  std::string keys, what;
};
struct Block {
  std::string title;
  std::vector<Line> lines;
};

/// What is for meshes of another kind is left out.
std::vector<Block> blocks(MeshKind kind) {
  std::vector<Block> all;
  for (const CommandGroup group : command_groups) {
    Block block{std::string(group_label(group)), {}};
    for (const UserCommand& command : user_commands())
      if (command.group == group && !command.keys.empty() && command.serves.contains(kind))
        block.lines.push_back({chords_text(command.keys), command.label});
    if (!block.lines.empty()) all.push_back(std::move(block));
  }
  Block mouse{"Mouse", {}};
  for (const Gesture& gesture : mouse_gestures())
    if (gesture.serves.contains(kind)) mouse.lines.push_back({gesture.how, gesture.what});
  all.push_back(std::move(mouse));
  return all;
}

/// Blocks side by side, none cut in two: each goes where there is most room, the longest first.
std::vector<std::vector<Block>> columns_of(std::vector<Block> all, std::size_t count) {
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.lines.size() > b.lines.size(); });
  std::vector<std::vector<Block>> columns(count);
  std::vector<std::size_t> rows(count, 0);
  for (Block& block : all) {
    const auto shortest =
        static_cast<std::size_t>(std::min_element(rows.begin(), rows.end()) - rows.begin());
    rows[shortest] += block.lines.size() + 2;
    columns[shortest].push_back(std::move(block));
  }
  return columns;
}

void draw_block(const Theme& theme, const Block& block, float width) {
  ImGui::PushFont(theme.bold);
  ui::text_colored(palette().accent, block.title);
  ImGui::PopFont();
  const float split = 0.42f * width;
  for (const Line& line : block.lines) {
    ui::text_colored(palette().text, line.keys);
    // Within a group, SameLine counts from where the group begins.
    ImGui::SameLine(std::max(split, ImGui::GetItemRectSize().x + theme.px(10)));
    ui::text_dim(line.what);
  }
  ImGui::Dummy(ImVec2(0, theme.px(6)));
}

bool dismissed() {
  if (ImGui::IsWindowAppearing()) return false;
  for (ImGuiMouseButton button = 0; button < 3; ++button)
    if (ImGui::IsMouseClicked(button)) return true;
  for (int key : {GLFW_KEY_ESCAPE, GLFW_KEY_ENTER, GLFW_KEY_SPACE})
    if (ImGui::IsKeyPressed(key, false)) return true;
  const auto& help = user_command("help");
  return std::any_of(help.keys.begin(), help.keys.end(), pressed);
}

}  // namespace

void HelpPanel::draw(const PanelContext& context) {
  constexpr const char* popup = "Keys and mouse###help";
  const Theme& theme = context.theme;
  if (wanted_) ImGui::OpenPopup(popup);
  wanted_ = false;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(0.98f * screen.x, 0.98f * screen.y));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(theme.px(20), theme.px(16)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(8), theme.px(4)));
  if (ImGui::BeginPopupModal(popup, nullptr, flags)) {
    const std::size_t count = screen.x > theme.px(900) ? 3 : screen.x > theme.px(620) ? 2 : 1;
    const float gap = theme.px(22);
    const auto n = static_cast<float>(count);
    const float width =
        std::min(theme.px(340), (0.96f * screen.x - 2 * theme.px(20) - (n - 1) * gap) / n);
    ImGui::PushFont(theme.small);
    for (const auto& column : columns_of(blocks(context.session.kind()), count)) {
      ImGui::BeginGroup();
      for (const Block& block : column) {
        ImGui::BeginGroup();
        draw_block(theme, block, width);
        ImGui::EndGroup();
        ui::note("help/" + block.title);
      }
      ImGui::Dummy(ImVec2(width, 0));
      ImGui::EndGroup();
      ImGui::SameLine(0, gap);
    }
    ImGui::NewLine();
    ui::text_colored(palette().text_faint, "Esc or a click closes this list.");
    ui::note("help/close");
    ImGui::PopFont();
    if (dismissed()) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(3);
}

}  // namespace winslow::gui
