#include "gui/panels/files/file_dialog.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "gui/files/places.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

/// Columns of the list, right of the names.
constexpr float date_width = 130;
constexpr float size_width = 76;

}  // namespace

std::vector<const FolderEntry*> FileDialog::shown() const {
  std::vector<const FolderEntry*> rows;
  for (const FolderEntry& entry : listing_.entries()) {
    if (entry.name.starts_with(".") && !hidden_files_) continue;
    if (entry.folder || matches(kind_.kinds[filter_], entry.name)) rows.push_back(&entry);
  }
  return rows;
}

void FileDialog::draw_bar(const PanelContext& context) {
  const std::string up = context.theme.icon(Icon::up);
  if (ui::button("dialog/up", up.empty() ? "Up" : up, {"The folder above (Backspace)"})) go_up();
  ImGui::SameLine();
  const float button = kind_.saves ? context.theme.px(110) : 0;
  ImGui::SetNextItemWidth(kind_.saves ? -button - ImGui::GetStyle().ItemSpacing.x : -FLT_MIN);
  if (ImGui::InputText("##folder", &typed_folder_, ImGuiInputTextFlags_EnterReturnsTrue)) {
    std::error_code ignored;
    if (fs::is_directory(typed_folder_, ignored))
      go(typed_folder_);
    else
      error_ = "There is no such folder.";
  }
  ui::note("dialog/folder");
  if (!kind_.saves) return;
  ImGui::SameLine();
  if (ui::button("dialog/new_folder", "New folder",
                 {"Make a folder in this one.", ui::ButtonStyle::normal, true, button}))
    new_folder_ = new_folder_ ? std::nullopt : std::optional<std::string>("");
}

void FileDialog::draw_new_folder(const PanelContext& context) {
  const float button = context.theme.px(110);
  ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::IsItemDeactivated() || new_folder_->empty()) ImGui::SetKeyboardFocusHere();
  const bool entered =
      ImGui::InputTextWithHint("##new_folder", "Name of the new folder", &*new_folder_,
                               ImGuiInputTextFlags_EnterReturnsTrue);
  ui::note("dialog/new_folder_name");
  ImGui::SameLine();
  const bool pressed = ui::button("dialog/make_folder", "Make",
                                  {"", ui::ButtonStyle::normal, !new_folder_->empty(), button});
  if ((!entered && !pressed) || new_folder_->empty()) return;
  const fs::path folder = wanted_folder_ / *new_folder_;
  std::error_code failed;
  fs::create_directory(folder, failed);
  new_folder_.reset();
  if (failed)
    error_ = "The folder cannot be made: " + failed.message() + ".";
  else
    go(folder);
}

void FileDialog::draw_places(const PanelContext& context, float height) {
  const Theme& theme = context.theme;
  ImGui::BeginChild("places", ImVec2(theme.px(168), height), true);
  std::string group;
  for (const Place& place : places(context.recent.folders())) {
    if (place.group != group) {
      if (!group.empty()) ImGui::Spacing();
      ui::text_colored(palette().text_faint, place.group);
      group = place.group;
    }
    const std::string label =
        ui::elided(place.label, ImGui::GetContentRegionAvail().x) + "###" + place.folder.string();
    const bool present = place.folder == listing_.folder();
    if (ImGui::Selectable(label.c_str(), present, ImGuiSelectableFlags_DontClosePopups))
      go(place.folder);
    ui::note("dialog/place/" + place.label);
    ui::tooltip(place.folder.string());
  }
  ImGui::EndChild();
}

void FileDialog::draw_headers(const PanelContext& context) {
  const Theme& theme = context.theme;
  const float right = ImGui::GetContentRegionMax().x;
  struct Header {
    SortBy by;
    const char* label;
    const char* id;
    float x;
  };
  const std::array<Header, 3> headers{
      {{SortBy::name, "Name", "dialog/sort/name", ImGui::GetCursorPosX()},
       {SortBy::date, "Changed", "dialog/sort/date", right - theme.px(date_width + size_width)},
       {SortBy::size, "Size", "dialog/sort/size", right - theme.px(size_width)}}};
  for (const Header& header : headers) {
    ImGui::SetCursorPosX(header.x);
    const bool present = sort_ == header.by;
    ImGui::PushStyleColor(ImGuiCol_Text, present ? palette().text : palette().text_dim);
    const std::string label = std::string(header.label) + (present ? reversed_ ? " ^" : " v" : "");
    const float width = header.by == SortBy::name ? headers[1].x - header.x : theme.px(70);
    if (ImGui::Selectable((label + "###" + header.id).c_str(), false,
                          ImGuiSelectableFlags_DontClosePopups, ImVec2(width, 0))) {
      reversed_ = present && !reversed_;
      sort_ = header.by;
      listing_.sort(sort_, reversed_);
      focus_name_ = true;
    }
    ui::note(header.id);
    ui::tooltip("Sort by this; again: the other way round.");
    ImGui::PopStyleColor();
    if (header.by != SortBy::size) ImGui::SameLine();
  }
  ImGui::Separator();
}

void FileDialog::draw_list(const PanelContext& context, float height) {
  ImGui::BeginChild("files", ImVec2(0, height), true);
  draw_headers(context);
  ImGui::BeginChild("entries");
  const FolderEntry* pressed = nullptr;
  const auto rows = shown();
  for (const FolderEntry* entry : rows)
    if (draw_entry(context, *entry, chosen_ ? entry->name == *chosen_ : entry->name == name_))
      pressed = entry;
  if (rows.empty())
    ui::text_dim(listing_.busy() ? "Reading the folder ..." : "Nothing of this kind is here.");
  ImGui::EndChild();
  ImGui::EndChild();
  if (!pressed) return;
  focus_name_ = true;
  const std::string name = pressed->name;  // the entry goes when another folder is shown
  if (pressed->folder) return go(wanted_folder_ / name);
  name_ = name;
  chosen_ = name;
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) accept(context);
}

bool FileDialog::draw_entry(const PanelContext& context, const FolderEntry& entry, bool chosen) {
  const Theme& theme = context.theme;
  const std::string glyph = theme.icon(entry.folder ? Icon::folder : Icon::file);
  const std::string lead = glyph.empty() ? (entry.folder ? "[ ] " : "") : glyph + "  ";
  const float right = ImGui::GetContentRegionMax().x;
  const float room = right - theme.px(date_width + size_width) - ImGui::GetCursorPosX();
  const bool pressed = ImGui::Selectable(
      ("##" + entry.name).c_str(), chosen,
      ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups);
  ui::note("dialog/entry/" + entry.name);
  if (chosen && scroll_) {
    ImGui::SetScrollHereY(0.5f);
    scroll_ = false;
  }
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted(ui::elided(lead + entry.name, room).c_str());
  ImGui::SameLine(right - theme.px(date_width + size_width));
  ui::text_colored(palette().text_faint, date_text(entry.changed));
  if (!entry.folder) {
    ImGui::SameLine(right - theme.px(size_width));
    ui::text_colored(palette().text_faint, size_text(entry.size));
  }
  return pressed;
}

}  // namespace winslow::gui
