#include "gui/panels/file_dialog.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <system_error>

#include "gui/studio/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

struct Look {
  const char* title;
  const char* button;
};

Look look_of(action::FilePurpose purpose) {
  switch (purpose) {
    case action::FilePurpose::open_mesh:
      return {"Open a mesh", "Open"};
    case action::FilePurpose::save_mesh:
      return {"Save the mesh as", "Save"};
    case action::FilePurpose::export_recipe:
      return {"Export the recipe", "Save"};
    case action::FilePurpose::replay_recipe:
      return {"Replay a recipe on this mesh", "Replay"};
    case action::FilePurpose::export_convergence:
      return {"Export the iterations as CSV", "Save"};
    case action::FilePurpose::picture:
      return {"Save a picture: .png, or the mesh alone as .svg or .pdf", "Save"};
    case action::FilePurpose::recording:
      return {"Record to a film (.mp4, .gif), or to a folder of frames", "Record"};
  }
  return {"", ""};
}

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

bool has_extension(const std::string& name, action::FilePurpose purpose) {
  static constexpr std::array<const char*, 8> meshes{".su2", ".msh", ".vtk", ".vtu",
                                                     ".obj", ".off", ".ply", ".stl"};
  const std::string extension = lower(fs::path(name).extension().string());
  if (purpose == action::FilePurpose::export_recipe ||
      purpose == action::FilePurpose::replay_recipe)
    return extension == ".json";
  if (purpose == action::FilePurpose::export_convergence) return extension == ".csv";
  if (purpose == action::FilePurpose::picture)
    return extension == ".png" || extension == ".svg" || extension == ".pdf";
  if (purpose == action::FilePurpose::recording) return extension == ".mp4" || extension == ".gif";
  return std::find(meshes.begin(), meshes.end(), extension) != meshes.end();
}

std::string size_text(std::uintmax_t bytes) {
  const auto kilo = static_cast<double>(bytes) / 1024;
  if (kilo < 1000) return short_number(std::max(1.0, std::round(kilo))) + " kB";
  return short_number(std::round(kilo / 102.4) / 10) + " MB";
}

fs::path home() {
  const char* home = std::getenv("HOME");
  return home && *home ? fs::path(home) : fs::path("/");
}

}  // namespace

FileDialog::FileDialog() {
  std::error_code ignored;
  folder_ = fs::current_path(ignored);
}

void FileDialog::open(action::FilePurpose purpose, const fs::path& suggested,
                      std::optional<std::size_t> step) {
  purpose_ = purpose;
  step_ = step;
  std::error_code ignored;
  if (!suggested.empty()) {
    name_ = suggested.filename().string();
    const fs::path parent = fs::absolute(suggested, ignored).parent_path();
    if (fs::is_directory(parent, ignored)) folder_ = parent;
  }
  if (purpose == action::FilePurpose::open_mesh || purpose == action::FilePurpose::replay_recipe)
    name_.clear();
  all_files_ = false;
  open_ = wanted_ = focus_name_ = true;
  go(folder_);
}

void FileDialog::go(const fs::path& folder) {
  std::error_code error;
  std::vector<Entry> entries;
  for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && it != end; it.increment(error)) {
    std::error_code ignored;
    Entry entry{it->path().filename().string(), it->is_directory(ignored), 0};
    if (entry.name.starts_with(".")) continue;
    if (!entry.folder && it->is_regular_file(ignored)) entry.size = it->file_size(ignored);
    entries.push_back(std::move(entry));
  }
  if (error) {
    error_ = "This folder cannot be read: " + error.message();
    return;
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : lower(a.name) < lower(b.name);
  });
  error_.clear();
  entries_ = std::move(entries);
  folder_ = folder;
  typed_folder_ = folder.string();
}

bool FileDialog::accepts(const Entry& entry) const {
  return entry.folder || all_files_ || has_extension(entry.name, purpose_);
}

void FileDialog::draw(const PanelContext& context) {
  if (!open_) return;
  constexpr const char* popup = "###file_dialog";
  if (wanted_) ImGui::OpenPopup(popup);
  wanted_ = false;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(context.theme.px(720), screen.x * 0.94f),
                                  std::min(context.theme.px(520), screen.y * 0.92f)));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(context.theme.px(18), context.theme.px(14)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.theme.px(8));
  if (ImGui::BeginPopupModal(popup, nullptr, flags)) {
    ImGui::PushFont(context.theme.bold);
    ImGui::TextUnformatted(look_of(purpose_).title);
    ImGui::PopFont();
    draw_places(context);
    draw_list(context);
    draw_footer(context);
    ImGui::EndPopup();
  } else {
    open_ = false;  // another dialog took its place
  }
  ImGui::PopStyleVar(2);
}

void FileDialog::draw_places(const PanelContext& context) {
  const auto place = [&](const char* id, Icon icon, const char* word, const std::string& tip) {
    const std::string glyph = context.theme.icon(icon);
    const bool pressed = ui::button(id, glyph.empty() ? word : glyph, {tip});
    ImGui::SameLine();
    return pressed;
  };
  if (place("dialog/up", Icon::up, "Up", "The folder above"))
    go(folder_.has_parent_path() ? folder_.parent_path() : folder_);
  if (place("dialog/home", Icon::home, "Home", "Your home folder")) go(home());
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::InputText("##folder", &typed_folder_, ImGuiInputTextFlags_EnterReturnsTrue)) {
    std::error_code ignored;
    if (fs::is_directory(typed_folder_, ignored))
      go(typed_folder_);
    else
      error_ = "There is no such folder.";
  }
  ui::note("dialog/folder");
}

void FileDialog::draw_list(const PanelContext& context) {
  const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + context.theme.px(10);
  ImGui::BeginChild("files", ImVec2(0, -footer), true);
  const std::vector<Entry> shown = entries_;  // a click on a folder replaces entries_
  int count = 0;
  for (const Entry& entry : shown) {
    if (!accepts(entry)) continue;
    ++count;
    draw_entry(context, entry);
  }
  if (count == 0) ui::text_dim("No files of this kind and no folders here.");
  ImGui::EndChild();
}

void FileDialog::draw_entry(const PanelContext& context, const Entry& entry) {
  const std::string glyph = context.theme.icon(entry.folder ? Icon::folder : Icon::file);
  const std::string label = (glyph.empty() ? (entry.folder ? "[ ] " : "") : glyph + "  ") +
                            entry.name + "##" + entry.name;
  const bool pressed = ImGui::Selectable(
      label.c_str(), !entry.folder && entry.name == name_,
      ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups);
  ui::note("dialog/entry/" + entry.name);
  const bool twice = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
  if (!entry.folder) {
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - context.theme.px(80));
    ui::text_right(size_text(entry.size), palette().text_faint);
  }
  if (!pressed) return;
  if (entry.folder) return go(folder_ / entry.name);
  name_ = entry.name;
  if (twice) accept(context);
}

void FileDialog::draw_footer(const PanelContext& context) {
  const Look look = look_of(purpose_);
  const float button = context.theme.px(96);
  ImGui::AlignTextToFramePadding();
  ui::text_dim("Name");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-2 * button - 2 * ImGui::GetStyle().ItemSpacing.x - context.theme.px(4));
  if (focus_name_) ImGui::SetKeyboardFocusHere();
  focus_name_ = false;
  const bool entered = ImGui::InputText("##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  ui::note("dialog/name");
  ImGui::SameLine();
  const bool pressed = ui::button("dialog/accept", look.button,
                                  {"", ui::ButtonStyle::primary, !name_.empty(), button});
  ImGui::SameLine();
  const bool cancelled =
      ui::button("dialog/cancel", "Cancel", {"", ui::ButtonStyle::normal, true, button});
  ui::checkbox("dialog/all", "All files", all_files_, "Show files of other kinds too");
  if (!error_.empty()) {
    ImGui::SameLine();
    ui::text_colored(palette().danger, error_);
  }
  if ((pressed || entered) && !name_.empty()) accept(context);
  if (cancelled || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) close();
}

void FileDialog::accept(const PanelContext& context) {
  fs::path path = folder_ / name_;  // a name that is an absolute path stands for itself
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    name_.clear();
    return go(path);
  }
  switch (purpose_) {
    case action::FilePurpose::open_mesh:
      if (!fs::exists(path, ignored)) {
        error_ = "There is no such file.";
        return;
      }
      context.emit(action::OpenMesh{path});
      break;
    case action::FilePurpose::save_mesh:
      if (!has_extension(name_, purpose_)) {
        error_ = "The name must end in .su2, .msh, .vtk, .vtu, .obj, .off, .ply or .stl.";
        return;
      }
      context.emit(action::SaveMesh{path});
      break;
    case action::FilePurpose::export_recipe:
      if (!path.has_extension()) path += ".json";
      context.emit(action::ExportRecipe{path});
      break;
    case action::FilePurpose::replay_recipe:
      if (!fs::exists(path, ignored)) {
        error_ = "There is no such file.";
        return;
      }
      context.emit(action::ReplayRecipe{path});
      break;
    case action::FilePurpose::export_convergence:
      if (!path.has_extension()) path += ".csv";
      context.emit(action::ExportConvergence{path});
      break;
    case action::FilePurpose::picture:
      if (!has_extension(name_, purpose_)) path += ".png";
      context.emit(action::SavePicture{path});
      break;
    case action::FilePurpose::recording:
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
