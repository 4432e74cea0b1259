#include "gui/panels/help_panel.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

struct Line {
  const char* keys;
  const char* what;
};

constexpr std::array lines = std::to_array<Line>(
    {{"Click a body", "select it; Ctrl or Shift adds to the selection"},
     {"Drag a body", "move it; the mesh follows; Shift keeps to one axis"},
     {"Drag the ring", "rotate about the pivot; Shift goes in steps of 5 degrees"},
     {"Drag the pivot", "put it elsewhere"},
     {"Drag elsewhere", "pan (also the middle or the right button)"},
     {"Wheel", "zoom at the cursor"},
     {"F, Shift+F", "show the whole mesh, the selection"},
     {"Space", "smooth, pause, resume"},
     {"N, Shift+N", "one iteration, ten iterations"},
     {"Esc", "cancel a drag or the solver; select nothing"},
     {"Ctrl+Z, Ctrl+Shift+Z", "undo, redo"},
     {"Ctrl+R", "reset to the mesh as opened"},
     {"Ctrl+O", "open a mesh; or drop a file on the window"},
     {"Ctrl+S, Ctrl+Shift+S", "save, save as"},
     {"Ctrl+E", "export the commands as a recipe"},
     {"W, L", "surfaces, edges or both; legend"},
     {"Ctrl+D", "light or dark"},
     {"Ctrl+plus, minus, 0", "size of the interface; 0: as the screen wants it"},
     {"F2, F3, F4", "show or hide the panels"},
     {"F12, Shift+F12", "save a picture, save it as"},
     {"Ctrl+Q", "quit"},
     {"F1", "this list"}});

}  // namespace

void HelpPanel::draw(const PanelContext& context) {
  constexpr const char* popup = "Keys and mouse###help";
  if (wanted_) ImGui::OpenPopup(popup);
  wanted_ = false;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(context.theme.px(20), context.theme.px(16)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.theme.px(8));
  if (ImGui::BeginPopupModal(popup, nullptr, flags)) {
    ImGui::PushFont(context.theme.bold);
    ImGui::TextUnformatted("Keys and mouse");
    ImGui::PopFont();
    ImGui::Spacing();
    for (const Line& line : lines) {
      ui::text_colored(palette().text, line.keys);
      ImGui::SameLine(context.theme.px(210));
      ui::text_dim(line.what);
    }
    ImGui::Spacing();
    const bool closed = ui::button("help/close", "Close",
                                   {"", ui::ButtonStyle::primary, true, context.theme.px(90)});
    if (closed || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(2);
}

}  // namespace winslow::gui
