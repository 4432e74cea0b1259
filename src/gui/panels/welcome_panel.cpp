#include "gui/panels/welcome_panel.h"

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

void centred(const char* text, ImU32 c) {
  const float width = ImGui::CalcTextSize(text).x;
  ImGui::SetCursorPosX((ImGui::GetWindowWidth() - width) / 2);
  ui::text_colored(c, text);
}

}  // namespace

void WelcomePanel::draw(const PanelContext& context) {
  const bool loading = context.session.loading();
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImGui::SetCursorPosY((ImGui::GetWindowHeight() - 6 * line) / 2);
  ImGui::PushFont(context.theme.title);
  centred(loading ? "Reading the mesh ..." : "Open a mesh", palette().text);
  ImGui::PopFont();
  if (loading) {
    const std::string name = context.session.loading_path().filename().string();
    centred(name.c_str(), palette().text_dim);
    return;
  }
  centred("Drop a file here, or choose one.", palette().text_dim);
  centred("SU2, Gmsh MSH, VTK, VTU, OBJ, OFF, PLY, STL", palette().text_faint);
  ImGui::Spacing();
  const float width = context.theme.px(150);
  ImGui::SetCursorPosX((ImGui::GetWindowWidth() - width) / 2);
  if (ui::button("welcome/open", "Open mesh...",
                 {"Choose a mesh file (Ctrl+O).", ui::ButtonStyle::primary, true, width}))
    context.emit(action::ShowFileDialog{action::FilePurpose::open_mesh});
}

}  // namespace winslow::gui
