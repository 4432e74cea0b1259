#include "gui/panels/dialogs.h"

#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

struct Line {
  std::string keys, what;
};
struct Block {
  std::string title;
  std::vector<Line> lines;
};

/// A mouse action in the picture.
struct Gesture {
  const char *how, *what;
  MeshKinds serves = all_meshes;
};
std::span<const Gesture> mouse_gestures() {
  constexpr MeshKinds plane = plane_meshes, volume = volume_meshes, space = meshes_in_space;
  constexpr MeshKinds surface{MeshKind::surface};
  static constexpr std::array<Gesture, 41> gestures{
      {{"Click a body", "select it", plane},
       {"Ctrl or Shift + click", "add to the selection"},
       {"Double click a body", "zoom to it, also in the list", plane},
       {"Drag a body", "move it; the mesh follows", plane},
       {"Drag an arrow", "move along x or y", plane},
       {"Drag the ring", "rotate about the pivot", plane},
       {"Drag the pin", "put the pivot elsewhere", plane},
       {"... with Ctrl", "snap to grid, 5 degrees, nodes", plane},
       {"... with Shift", "a tenth of the speed", plane},
       {"X, Y in a drag", "keep to that axis, or set free", plane},
       {"30 Enter in a drag", "by just 30; moving: x Tab y", plane},
       {"Enter, Esc in a drag", "accept, cancel", plane},
       {"Drag a node (E)", "change the shape", plane},
       {"... with the wheel", "how far it fades", plane},
       {"Shift + click a node (E)", "take the arc up to it", plane},
       {"Drag elsewhere", "pan; also middle or right button", plane},
       {"Right click", "what can be done there"},
       {"Alt + click a node", "inspect it; in tab VCV a click"},
       {"Wheel", "zoom at the cursor"},
       {"Ctrl + right drag", "zoom to a box"},
       {"Click a surface", "select its marker", volume},
       {"Click a cut", "its element", volume},
       {"Click the surface", "the element there", surface},
       {"Double click a surface", "zoom to it", volume},
       {"Left drag", "turn about what is there (T: freely)", space},
       {"Alt + click", "the node there", space},
       {"Middle, right, Shift + left", "pan", space},
       {"Drag an arrow", "move along it", volume},
       {"Drag a small square", "move in its plane", volume},
       {"Drag a ring", "turn about its axis", volume},
       {"Drag the disc", "move across the view", volume},
       {"... with Ctrl, Shift", "in steps, slowly", volume},
       {"X, Y, Z in a drag", "that axis alone, or back", volume},
       {"30 Enter in a drag", "by just 30; Tab: the next", volume},
       {"Drag a node (E)", "change the shape", volume},
       {"Shift + click a node or face (E)", "hold it as well", volume},
       {"Drag a cut's arrow", "move the cut", volume},
       {"Drag the arrow's ball", "turn the cut", volume},
       {"Esc in a drag", "as it was before", space},
       {"Drag the legend", "to another side or corner"},
       {"Line in the legend", "threshold of what is isolated"}}};
  return gestures;
}

/// The blocks of the list, without entries for other kinds of meshes.
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

/// Distributes whole blocks over columns: each, the longest first, goes to the column with most
/// room.
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
    // Within a group, SameLine is relative to the start of the group.
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
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ui::place_dialog(0, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(theme.px(8), theme.px(4)));
  {
    const ui::Modal window(popup, std::exchange(wanted_, false), theme, {ImVec2(20, 16)});
    if (window.shown()) {
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
    }
  }
  ImGui::PopStyleVar();
}

}  // namespace winslow::gui
