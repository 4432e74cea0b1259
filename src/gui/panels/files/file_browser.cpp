#include "gui/panels/files/file_browser.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "gui/base/input.h"
#include "gui/files/recent_files.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

/// Columns of the list, right of the names, in units of the layout.
constexpr float date_width = 130;
constexpr float day_width = 92;
constexpr float size_width = 76;
/// Width of the places beside the list.
constexpr float places_width = 168;

/// The text before a name.
std::string lead_of(const Theme& theme, bool folder) {
  const std::string glyph = theme.icon(folder ? Icon::folder : Icon::file);
  return glyph.empty() ? (folder ? "[ ] " : "") : glyph + "  ";
}

}  // namespace

void FileBrowser::open(bool new_folders) {
  new_folders_ = new_folders;
  new_folder_.reset();
}

bool FileBrowser::draw(const PanelContext& context, float height) {
  draw_places(context, height);
  ImGui::SameLine();
  return draw_list(context, height);
}

void FileBrowser::draw_address(const PanelContext& context) {
  const std::string up = context.theme.icon(Icon::up);
  if (ui::button("dialog/up", up.empty() ? "Up" : up, {"The folder above (Backspace)"}))
    choice_.go_up();
  ImGui::SameLine();
  const float button = new_folders_ ? context.theme.px(110) : 0;
  ImGui::SetNextItemWidth(new_folders_ ? -button - ImGui::GetStyle().ItemSpacing.x : -FLT_MIN);
  if (ImGui::InputText("##folder", &choice_.address, ImGuiInputTextFlags_EnterReturnsTrue)) {
    std::error_code ignored;
    if (fs::is_directory(choice_.address, ignored))
      choice_.go(choice_.address);
    else
      choice_.error = "There is no such folder.";
  }
  ui::note("dialog/folder");
  if (!new_folders_) return;
  ImGui::SameLine();
  if (ui::button("dialog/new_folder", "New folder",
                 {"Make a folder in this one.", ui::ButtonStyle::normal, true, button}))
    new_folder_ = new_folder_ ? std::nullopt : std::optional<std::string>("");
  if (new_folder_) draw_new_folder(context);
}

void FileBrowser::draw_new_folder(const PanelContext& context) {
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
  const fs::path folder = choice_.folder.wanted() / *new_folder_;
  std::error_code failed;
  fs::create_directory(folder, failed);
  new_folder_.reset();
  if (failed)
    choice_.error = "The folder cannot be made: " + failed.message() + ".";
  else
    choice_.go(folder);
}

/// Draws a preview of the chosen mesh, at the foot of the places. Returns its height.
float FileBrowser::draw_preview(const PanelContext& context, float height) {
  const float width = context.theme.px(places_width);
  const float picture = width * static_cast<float>(Thumbnails::height) / Thumbnails::width;
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  const Texture* texture = preview_.picture();
  if (!texture || height < 2 * picture) return 0;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 min(at.x, at.y + height - picture), max(at.x + width, at.y + height);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddImageRounded(texture->id(), min, max, ImVec2(0, 0), ImVec2(1, 1), IM_COL32_WHITE,
                       context.theme.px(4));
  list.AddRect(min, max, palette().border, context.theme.px(4));
  ui::note("dialog/preview", min, max);
  return picture + gap;
}

void FileBrowser::draw_places(const PanelContext& context, float height) {
  const Theme& theme = context.theme;
  const auto chosen = choice_.folder.chosen();
  preview_.want(chosen && !new_folders_ ? choice_.folder.listing().folder() / *chosen : fs::path());
  height -= draw_preview(context, height);
  ImGui::BeginChild("places", ImVec2(theme.px(places_width), height), true);
  std::string group;
  for (const Place& place : places(context.recent.folders())) {
    if (place.group != group) {
      if (!group.empty()) ImGui::Spacing();
      ui::text_colored(palette().text_faint, place.group);
      group = place.group;
    }
    const std::string label =
        ui::elided(place.label, ImGui::GetContentRegionAvail().x) + "###" + place.folder.string();
    const bool present = place.folder == choice_.folder.listing().folder();
    if (ImGui::Selectable(label.c_str(), present, ImGuiSelectableFlags_DontClosePopups))
      choice_.go(place.folder);
    ui::note("dialog/place/" + place.label);
    ui::tooltip(place.folder.string());
  }
  ImGui::EndChild();
}

FileBrowser::Columns FileBrowser::columns_for(const Theme& theme, float width, float longest_name) {
  const float gap = theme.px(12);
  const Columns all{theme.px(date_width), theme.px(size_width), true};
  const Columns days{theme.px(day_width), theme.px(size_width), false};
  const Columns sizes{0, theme.px(size_width), false};
  for (const Columns& columns : {all, days, sizes})
    if (longest_name + gap <= width - columns.date - columns.size) return columns;
  return {0, 0, false};
}

/// Draws the arrow beside the header of the sorted column, which was the last item.
void FileBrowser::draw_sort_arrow() const {
  const ImVec2 text = ImGui::CalcTextSize(sort_ == SortBy::name   ? "Name"
                                          : sort_ == SortBy::date ? "Changed"
                                                                  : "Size");
  const ImVec2 min = ImGui::GetItemRectMin();
  const float scale = 0.6f;
  const float drop = (text.y - scale * text.y) / 2;
  const ImVec2 at(min.x + ImGui::GetStyle().ItemSpacing.x / 2 + text.x, min.y + drop);
  // Names go up from the first, dates and sizes down from the newest and the largest.
  const bool up = (sort_ == SortBy::name) != reversed_;
  ImGui::RenderArrow(ImGui::GetWindowDrawList(), at, palette().text,
                     up ? ImGuiDir_Up : ImGuiDir_Down, scale);
  ui::note(up ? "dialog/sorted/up" : "dialog/sorted/down", at,
           ImVec2(at.x + scale * text.y, at.y + scale * text.y));
}

void FileBrowser::draw_headers(const PanelContext& context) {
  const float right = ImGui::GetContentRegionMax().x;
  struct Header {
    SortBy by;
    const char* label;
    const char* id;
    float x, width;
  };
  const float start = ImGui::GetCursorPosX();
  const float names = right - columns_.date - columns_.size;
  const std::array<Header, 3> headers{
      {{SortBy::name, "Name", "dialog/sort/name", start, names - start},
       {SortBy::date, "Changed", "dialog/sort/date", names, columns_.date},
       {SortBy::size, "Size", "dialog/sort/size", right - columns_.size, columns_.size}}};
  for (const Header& header : headers) {
    if (header.width <= 0) continue;
    if (header.by != SortBy::name) ImGui::SameLine();
    ImGui::SetCursorPosX(header.x);
    const bool present = sort_ == header.by;
    ImGui::PushStyleColor(ImGuiCol_Text, present ? palette().text : palette().text_dim);
    if (ImGui::Selectable((std::string(header.label) + "###" + header.id).c_str(), false,
                          ImGuiSelectableFlags_DontClosePopups,
                          ImVec2(header.width - context.theme.px(4), 0))) {
      reversed_ = present && !reversed_;
      sort_ = header.by;
      choice_.folder.sort(sort_, reversed_);
      choice_.focus_name = true;
    }
    ui::note(header.id);
    if (present) draw_sort_arrow();
    ui::tooltip("Sort by this; again: the other way round.");
    ImGui::PopStyleColor();
  }
  ImGui::Separator();
}

bool FileBrowser::draw_list(const PanelContext& context, float height) {
  ImGui::BeginChild("files", ImVec2(0, height), true);
  const auto rows = choice_.folder.shown();
  float longest = 0;
  for (const FolderEntry* entry : rows)
    longest = std::max(
        longest,
        ImGui::CalcTextSize((lead_of(context.theme, entry->folder) + entry->name).c_str()).x);
  const float bar = ImGui::GetStyle().ScrollbarSize;
  columns_ = columns_for(context.theme, ImGui::GetContentRegionAvail().x - bar, longest);
  draw_headers(context);
  ImGui::BeginChild("entries");
  const FolderEntry* pressed = nullptr;
  const std::string chosen = choice_.folder.chosen().value_or(choice_.name);
  for (const FolderEntry* entry : rows)
    if (draw_entry(context, *entry, entry->name == chosen)) pressed = entry;
  if (rows.empty())
    ui::text_dim(choice_.folder.listing().busy() ? "Reading the folder ..."
                                                 : "Nothing of this kind is here.");
  ImGui::EndChild();
  ImGui::EndChild();
  if (!pressed) return false;
  choice_.focus_name = true;
  const std::string name = pressed->name;  // copied, since showing another folder removes the entry
  if (pressed->folder) {
    choice_.go(choice_.folder.wanted() / name);
    return false;
  }
  choice_.name = name;
  choice_.folder.choose(name);
  return ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
}

bool FileBrowser::draw_entry(const PanelContext& context, const FolderEntry& entry, bool chosen) {
  const float right = ImGui::GetContentRegionMax().x;
  const float names = right - columns_.date - columns_.size;
  const std::string text = lead_of(context.theme, entry.folder) + entry.name;
  const std::string shown = ui::elided(text, names - ImGui::GetCursorPosX());
  const bool pressed = ImGui::Selectable(
      ("##" + entry.name).c_str(), chosen,
      ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups);
  ui::note("dialog/entry/" + entry.name);
  if (shown != text) {
    ui::tooltip(entry.name);
    ui::note("dialog/cut/" + entry.name);
  }
  if (chosen && choice_.folder.take_reveal()) ImGui::SetScrollHereY(0.5f);
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted(shown.c_str());
  if (columns_.date > 0) {
    ImGui::SameLine(names);
    const std::string date = date_text(entry.changed);
    ui::text_colored(palette().text_faint, columns_.whole_date ? date : date.substr(0, 10));
    ui::note("dialog/date/" + entry.name);
  }
  if (!entry.folder && columns_.size > 0) {
    ImGui::SameLine(right - columns_.size);
    ui::text_colored(palette().text_faint, size_text(entry.size));
  }
  return pressed;
}

namespace {

void replace(ImGuiInputTextCallbackData& data, const std::string& text) {
  data.DeleteChars(0, data.BufTextLen);
  data.InsertChars(0, text.c_str());
}

}  // namespace

bool FileNameField::draw(const PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ui::text_dim("Name");
  ImGui::SameLine(0, context.theme.px(10));
  ImGui::SetNextItemWidth(-FLT_MIN);
  // Backspace in a field that was already empty.
  const bool up = choice_.name.empty() && ImGui::IsKeyPressed(GLFW_KEY_BACKSPACE, false);
  if (choice_.focus_name) ImGui::SetKeyboardFocusHere();
  choice_.focus_name = false;
  constexpr auto flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackEdit |
                         ImGuiInputTextFlags_CallbackCompletion |
                         ImGuiInputTextFlags_CallbackHistory;
  const auto callback = [](ImGuiInputTextCallbackData* data) {
    return static_cast<FileNameField*>(data->UserData)->edit(*data);
  };
  const bool entered = ImGui::InputTextWithHint(
      "##name", "Type, or choose with the arrow keys; Tab completes, Backspace goes up",
      &choice_.name, flags, callback, this);
  const bool active = ImGui::IsItemActive();
  ui::note("dialog/name");
  if (active && up) choice_.go_up();
  return entered;
}

int FileNameField::edit(ImGuiInputTextCallbackData& data) {
  const std::string text(data.Buf, static_cast<std::size_t>(data.BufTextLen));
  switch (data.EventFlag) {
    case ImGuiInputTextFlags_CallbackCompletion:
      complete(data, text);
      break;
    case ImGuiInputTextFlags_CallbackHistory:
      step(data, data.EventKey == ImGuiKey_UpArrow ? -1 : 1);
      break;
    case ImGuiInputTextFlags_CallbackEdit:
      choice_.error.clear();
      if (enter_typed_folder(text))
        data.DeleteChars(0, data.BufTextLen);
      else
        choice_.folder.find(text);
      break;
    default:
      break;
  }
  if (data.BufDirty) ui::forget_typed_steps();
  return 0;
}

/// Enters a typed folder: "meshes/"; "/" and "~/" as in a shell.
bool FileNameField::enter_typed_folder(const std::string& text) {
  const auto folder = choice_.folder.typed_folder(text);
  if (!folder) return false;
  choice_.go(*folder);
  choice_.focus_name = false;  // it has the keyboard already
  return true;
}

/// Completes to the common beginning of all matching names; enters a folder if it is the only
/// match.
void FileNameField::complete(ImGuiInputTextCallbackData& data, const std::string& text) {
  const auto completion = choice_.folder.complete(text);
  if (!completion) return;
  replace(data, completion->text);
  if (completion->single && enter_typed_folder(completion->text + "/")) {
    data.DeleteChars(0, data.BufTextLen);
    return;
  }
  choice_.folder.find(completion->text);
}

void FileNameField::step(ImGuiInputTextCallbackData& data, int by) {
  choice_.folder.step(by);
  if (choice_.folder.chosen()) replace(data, *choice_.folder.chosen());
}

}  // namespace winslow::gui
