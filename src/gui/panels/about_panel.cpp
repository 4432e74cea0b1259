#include "gui/panels/dialogs.h"

#if __has_include(<suitesparse/SuiteSparse_config.h>)
#include <suitesparse/SuiteSparse_config.h>
#endif

#include "core/linear/linear_solver.h"
#include "core/version.h"
#include "gui/base/text.h"
#include "gui/render/gl.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

std::string gl_text(GLenum what) {
  const auto* text = reinterpret_cast<const char*>(glGetString(what));
  return text ? text : "unknown";
}

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string build_kind() {
#ifdef NDEBUG
  return "optimised, g++ or compatible " __VERSION__;
#else
  return "with assertions, g++ or compatible " __VERSION__;
#endif
}

}  // namespace

std::vector<std::pair<std::string, std::string>> AboutPanel::facts() {
  std::vector<std::pair<std::string, std::string>> all{
      {"winslow", WINSLOW_VERSION},
      {"Build", build_kind()},
      {"OpenGL", gl_text(GL_VERSION)},
      {"Renderer", gl_text(GL_RENDERER)},
      {"Dear ImGui", ImGui::GetVersion()},
      {"GLFW", glfwGetVersionString()},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)}};
#ifdef SUITESPARSE_MAIN_VERSION
  all.emplace_back("SuiteSparse", dotted(SUITESPARSE_MAIN_VERSION, SUITESPARSE_SUB_VERSION,
                                         SUITESPARSE_SUBSUB_VERSION));
#endif
  all.emplace_back("Linear solvers", joined(linear_solver_names()));
  all.emplace_back("Licence", "MIT; the libraries have their own");
  return all;
}

void AboutPanel::draw(const PanelContext& context) {
  constexpr const char* popup = "###about";
  const Theme& theme = context.theme;
  if (wanted_) facts_ = facts();
  const ImVec2 padding(22, 18);
  const float width =
      ui::place_dialog(theme.px(560), ImVec2(theme.px(padding.x), theme.px(padding.y)));
  const ui::Modal window(popup, std::exchange(wanted_, false), theme, {padding});
  if (!window.shown()) return;
  ui::text_in(theme.title, "winslow");
  ImGui::PushTextWrapPos(theme.px(padding.x) + width);
  ui::text_dim("Elliptic smoothing of unstructured meshes on virtual control volumes.");
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  std::string all;
  for (const auto& [part, version] : facts_) {
    ui::text_dim(part);
    ImGui::SameLine(theme.px(140));
    ImGui::TextUnformatted(ui::elided(version, width - theme.px(140)).c_str());
    ui::note("about/" + part);
    ui::tooltip(version);
    all += part + ": " + version + "\n";
  }
  ImGui::Spacing();
  if (ui::button("about/copy", "Copy", {"Copy all of this, for a report of a fault."}))
    ImGui::SetClipboardText(all.c_str());
  ImGui::SameLine();
  const bool closed =
      ui::button("about/close", "Close", {"", ui::ButtonStyle::primary, true, theme.px(90)});
  if (closed || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) ImGui::CloseCurrentPopup();
}

}  // namespace winslow::gui
