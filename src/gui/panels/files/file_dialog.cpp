#include "gui/panels/files/file_dialog.h"

#include "gui/base/input.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace fs = std::filesystem;

void FileDialog::open(FilePurpose purpose, const fs::path& suggested,
                      std::optional<std::size_t> step, MeshKind mesh) {
  purpose_ = purpose;
  step_ = step;
  kind_ = dialog_of(purpose, mesh);
  set_filter(0);
  fs::path folder = choice_.folder.listing().folder().empty() ? choice_.folder.wanted()
                                                              : choice_.folder.listing().folder();
  choice_.name.clear();
  choice_.error.clear();
  browser_.open(kind_.saves);
  if (!suggested.empty()) {
    std::error_code ignored;
    const fs::path parent = fs::absolute(suggested, ignored).parent_path();
    if (fs::is_directory(parent, ignored)) folder = parent;
    if (kind_.saves) choice_.name = suggested.filename().string();
  }
  open_ = wanted_ = choice_.focus_name = true;
  choice_.go(folder);
}

void FileDialog::draw(const PanelContext& context) {
  if (!open_) return;
  if (std::string problem = choice_.folder.poll(); !problem.empty()) {
    choice_.error = std::move(problem);
    choice_.address = choice_.folder.wanted().string();
  }
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const ui::Modal window("###file_dialog", std::exchange(wanted_, false), context.theme,
                         {ImVec2(18, 14),
                          ImVec2(std::min(context.theme.px(840), screen.x * 0.96f),
                                 std::min(context.theme.px(560), screen.y * 0.94f)),
                          ImGuiWindowFlags_NoScrollbar});
  if (window.shown())
    draw_content(context);
  else
    open_ = false;  // another dialog took its place
}

void FileDialog::draw_content(const PanelContext& context) {
  ui::text_in(context.theme.bold, kind_.title);
  browser_.draw_address(context);
  const float message = choice_.error.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing();
  const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + message + context.theme.px(8);
  const float height = std::max(ImGui::GetContentRegionAvail().y - footer, context.theme.px(60));
  const bool chosen = browser_.draw(context, height);
  if (chosen) accept(context);
  const bool entered = name_field_.draw(context);
  draw_footer(context, entered);
}

void FileDialog::draw_footer(const PanelContext& context, bool entered) {
  const Theme& theme = context.theme;
  if (!choice_.error.empty()) {
    ui::text_colored(palette().danger, ui::elided(choice_.error, ImGui::GetContentRegionAvail().x));
    ui::note("dialog/error");
    ui::tooltip(choice_.error);
  }
  draw_filter(context);
  ImGui::SameLine(0, theme.px(12));
  bool hidden = choice_.folder.shows_hidden();
  if (ui::checkbox("dialog/hidden", "Hidden files", hidden,
                   "Show files whose names begin with a dot."))
    choice_.folder.show_hidden(hidden);
  const float button = theme.px(96);
  const float buttons = 2 * button + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - buttons);
  const bool cancelled =
      ui::button("dialog/cancel", "Cancel", {"", ui::ButtonStyle::normal, true, button});
  ImGui::SameLine();
  const bool pressed = ui::button("dialog/accept", kind_.button,
                                  {"", ui::ButtonStyle::primary, !choice_.name.empty(), button});
  if ((pressed || entered) && !choice_.name.empty()) accept(context);
  if (cancelled || (open_ && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))) close();
}

void FileDialog::draw_filter(const PanelContext& context) {
  std::vector<std::string> labels;
  for (const FileKind& kind : kind_.kinds)
    labels.push_back(kind.label +
                     (kind.extensions.size() == 1 ? " (" + kind.extensions[0] + ")" : ""));
  ImGui::SetNextItemWidth(context.theme.px(180));
  const char* tip = kind_.saves ? "Format in which it is written: the ending of the name says it."
                                : "Which files are listed.";
  std::size_t filter = filter_;
  if (!ui::combo("dialog/filter", labels, filter, tip)) return;
  set_filter(filter);
  choice_.focus_name = true;
  const FileKind& kind = kind_.kinds[filter_];
  if (!kind_.saves || kind.extensions.size() != 1 || choice_.name.empty()) return;
  choice_.name = fs::path(choice_.name).replace_extension(kind.extensions[0]).string();
}

void FileDialog::accept(const PanelContext& context) {
  fs::path path = choice_.folder.wanted() / choice_.name;  // an absolute path replaces the folder
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    choice_.name.clear();
    return choice_.go(path);
  }
  choice_.focus_name = true;  // in case the name is not accepted
  if (!kind_.saves) {
    // The first letters suffice for the only file that begins with them.
    if (!fs::exists(path, ignored) && choice_.folder.chosen())
      path = choice_.folder.wanted() / *choice_.folder.chosen();
    if (fs::is_directory(path, ignored)) {
      choice_.name.clear();
      return choice_.go(path);
    }
    if (!fs::exists(path, ignored)) {
      choice_.error = "There is no such file.";
      return;
    }
    return choose(context, path);
  }
  if (!path.has_extension()) {
    const auto& chosen = kind_.kinds[filter_].extensions;
    path += chosen.size() == 1 ? chosen[0] : kind_.default_extension;
  }
  const bool frames = kind_.folders && !path.has_extension();
  if (!frames && !matches(kind_.kinds[0], path.filename().string())) {
    const auto& known = kind_.kinds[0].extensions;
    choice_.error = "The name must end in ";
    for (std::size_t k = 0; k < known.size(); ++k)
      choice_.error += (k == 0 ? "" : k + 1 == known.size() ? " or " : ", ") + known[k];
    choice_.error += ".";
    return;
  }
  choose(context, path);
}

void FileDialog::choose(const PanelContext& context, const fs::path& path) {
  switch (purpose_) {
    case FilePurpose::open_mesh:
      context.emit(action::OpenMesh{path});
      break;
    case FilePurpose::save_mesh:
      context.emit(action::SaveMesh{path, false, false, proceed_});
      break;
    case FilePurpose::export_mesh:
      context.emit(action::ExportMesh{path});
      break;
    case FilePurpose::export_markers:
      context.emit(action::ExportMarkers{path, {}});
      break;
    case FilePurpose::export_recipe:
      context.emit(action::ExportRecipe{path});
      break;
    case FilePurpose::replay_recipe:
      context.emit(action::ReplayRecipe{path});
      break;
    case FilePurpose::export_convergence:
      context.emit(action::ExportConvergence{path});
      break;
    case FilePurpose::picture:
      context.emit(action::SavePicture{path});
      break;
    case FilePurpose::recording:
      context.emit(action::StartRecording{path, step_});
      break;
    case FilePurpose::reference:
      context.emit(action::ChooseReference{path});
      break;
    case FilePurpose::displacements:
      context.emit(action::MoveNodesOfFile{path, false});
      break;
    case FilePurpose::positions:
      context.emit(action::MoveNodesOfFile{path, true});
      break;
    case FilePurpose::step_reference:
      context.emit(action::ChooseStepReference{path});
      break;
  }
  close();
}

void FileDialog::set_filter(std::size_t filter) {
  filter_ = filter;
  choice_.folder.set_filter(kind_.kinds[filter]);
}

void FileDialog::close() {
  open_ = false;
  ImGui::CloseCurrentPopup();
}

}  // namespace winslow::gui
