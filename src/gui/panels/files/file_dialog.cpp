#include "gui/panels/files/file_dialog.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <system_error>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace fs = std::filesystem;

FileDialog::FileDialog() {
  std::error_code ignored;
  wanted_folder_ = fs::current_path(ignored);
}

void FileDialog::open(FilePurpose purpose, const fs::path& suggested,
                      std::optional<std::size_t> step) {
  purpose_ = purpose;
  step_ = step;
  kind_ = dialog_of(purpose);
  filter_ = 0;
  fs::path folder = listing_.folder().empty() ? wanted_folder_ : listing_.folder();
  name_.clear();
  error_.clear();
  new_folder_.reset();
  if (!suggested.empty()) {
    std::error_code ignored;
    const fs::path parent = fs::absolute(suggested, ignored).parent_path();
    if (fs::is_directory(parent, ignored)) folder = parent;
    if (kind_.saves) name_ = suggested.filename().string();
  }
  open_ = wanted_ = focus_name_ = true;
  go(folder);
}

void FileDialog::go(const fs::path& folder) {
  wanted_folder_ = folder.lexically_normal();
  if (!wanted_folder_.has_filename() && wanted_folder_ != wanted_folder_.root_path())
    wanted_folder_ = wanted_folder_.parent_path();  // "/a/b/" is "/a/b"
  typed_folder_ = wanted_folder_.string();
  chosen_.reset();
  error_.clear();
  focus_name_ = true;
  listing_.go(wanted_folder_);
}

void FileDialog::go_up() {
  if (wanted_folder_.has_parent_path()) go(wanted_folder_.parent_path());
}

void FileDialog::draw(const PanelContext& context) {
  if (!open_) return;
  if (listing_.poll() && !listing_.error().empty()) {
    error_ = listing_.error();
    wanted_folder_ = listing_.folder();
    typed_folder_ = wanted_folder_.string();
  }
  constexpr const char* popup = "###file_dialog";
  if (wanted_) ImGui::OpenPopup(popup);
  wanted_ = false;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(context.theme.px(840), screen.x * 0.96f),
                                  std::min(context.theme.px(560), screen.y * 0.94f)));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoScrollbar;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(context.theme.px(18), context.theme.px(14)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.theme.px(8));
  if (ImGui::BeginPopupModal(popup, nullptr, flags)) {
    draw_content(context);
    ImGui::EndPopup();
  } else {
    open_ = false;  // another dialog took its place
  }
  ImGui::PopStyleVar(2);
}

void FileDialog::draw_content(const PanelContext& context) {
  ImGui::PushFont(context.theme.bold);
  ImGui::TextUnformatted(kind_.title.c_str());
  ImGui::PopFont();
  draw_bar(context);
  if (new_folder_) draw_new_folder(context);
  const float message = error_.empty() ? 0 : ImGui::GetTextLineHeightWithSpacing();
  const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + message + context.theme.px(8);
  const float height = std::max(ImGui::GetContentRegionAvail().y - footer, context.theme.px(60));
  draw_places(context, height);
  ImGui::SameLine();
  draw_list(context, height);
  draw_name(context);
  draw_footer(context);
}

void FileDialog::draw_footer(const PanelContext& context) {
  const Theme& theme = context.theme;
  if (!error_.empty()) {
    ui::text_colored(palette().danger, ui::elided(error_, ImGui::GetContentRegionAvail().x));
    ui::note("dialog/error");
    ui::tooltip(error_);
  }
  draw_filter(context);
  ImGui::SameLine(0, theme.px(12));
  ui::checkbox("dialog/hidden", "Hidden files", hidden_files_,
               "Show files whose names begin with a dot.");
  const float button = theme.px(96);
  const float buttons = 2 * button + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - buttons);
  const bool cancelled =
      ui::button("dialog/cancel", "Cancel", {"", ui::ButtonStyle::normal, true, button});
  ImGui::SameLine();
  const bool pressed = ui::button("dialog/accept", kind_.button,
                                  {"", ui::ButtonStyle::primary, !name_.empty(), button});
  if ((pressed || entered_) && !name_.empty()) accept(context);
  entered_ = false;
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
  if (!ui::combo("dialog/filter", labels, filter_, tip)) return;
  focus_name_ = true;
  const FileKind& kind = kind_.kinds[filter_];
  if (!kind_.saves || kind.extensions.size() != 1 || name_.empty()) return;
  name_ = fs::path(name_).replace_extension(kind.extensions[0]).string();
}

void FileDialog::accept(const PanelContext& context) {
  fs::path path = wanted_folder_ / name_;  // a name that is an absolute path stands for itself
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    name_.clear();
    return go(path);
  }
  focus_name_ = true;  // for what is not accepted
  if (!kind_.saves) {
    // A few letters are enough for the only file that begins with them.
    if (!fs::exists(path, ignored) && chosen_) path = wanted_folder_ / *chosen_;
    if (fs::is_directory(path, ignored)) {
      name_.clear();
      return go(path);
    }
    if (!fs::exists(path, ignored)) {
      error_ = "There is no such file.";
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
    error_ = "The name must end in ";
    for (std::size_t k = 0; k < known.size(); ++k)
      error_ += (k == 0 ? "" : k + 1 == known.size() ? " or " : ", ") + known[k];
    error_ += ".";
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
      context.emit(action::SaveMesh{path});
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
  }
  close();
}

void FileDialog::close() {
  open_ = false;
  ImGui::CloseCurrentPopup();
}

}  // namespace winslow::gui
