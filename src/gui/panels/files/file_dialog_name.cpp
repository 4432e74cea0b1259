#include "gui/panels/files/file_dialog.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <system_error>

#include "gui/files/places.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

void replace(ImGuiInputTextCallbackData& data, const std::string& text) {
  data.DeleteChars(0, data.BufTextLen);
  data.InsertChars(0, text.c_str());
}

bool begins_with(const std::string& name, const std::string& begin) {
  return lower_case(name).starts_with(lower_case(begin));
}

}  // namespace

void FileDialog::draw_name(const PanelContext& context) {
  ImGui::AlignTextToFramePadding();
  ui::text_dim("Name");
  ImGui::SameLine(0, context.theme.px(10));
  ImGui::SetNextItemWidth(-FLT_MIN);
  // Backspace in what was empty before it was pressed.
  const bool up = name_.empty() && ImGui::IsKeyPressed(GLFW_KEY_BACKSPACE, false);
  if (focus_name_) ImGui::SetKeyboardFocusHere();
  focus_name_ = false;
  constexpr auto flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackEdit |
                         ImGuiInputTextFlags_CallbackCompletion |
                         ImGuiInputTextFlags_CallbackHistory;
  const auto callback = [](ImGuiInputTextCallbackData* data) {
    return static_cast<FileDialog*>(data->UserData)->edit(*data);
  };
  entered_ = ImGui::InputTextWithHint(
      "##name", "Type, or choose with the arrow keys; Tab completes, Backspace goes up", &name_,
      flags, callback, this);
  const bool active = ImGui::IsItemActive();
  ui::note("dialog/name");
  if (active && up) go_up();
}

int FileDialog::edit(ImGuiInputTextCallbackData& data) {
  const std::string text(data.Buf, static_cast<std::size_t>(data.BufTextLen));
  switch (data.EventFlag) {
    case ImGuiInputTextFlags_CallbackCompletion:
      complete(data);
      break;
    case ImGuiInputTextFlags_CallbackHistory:
      step(data, data.EventKey == ImGuiKey_UpArrow ? -1 : 1);
      break;
    case ImGuiInputTextFlags_CallbackEdit:
      error_.clear();
      if (enter_typed_folder(text))
        data.DeleteChars(0, data.BufTextLen);
      else
        find_typed(text);
      break;
    default:
      break;
  }
  if (data.BufDirty) ui::forget_typed_steps();
  return 0;
}

/// "meshes/" goes into that folder, "/" and "~/" to where every shell would.
bool FileDialog::enter_typed_folder(const std::string& text) {
  if (!text.ends_with('/')) return false;
  const fs::path folder = text == "~/" ? home_folder() : wanted_folder_ / text;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return false;
  go(folder);
  focus_name_ = false;  // it has the keyboard already
  return true;
}

void FileDialog::find_typed(const std::string& text) {
  chosen_.reset();
  if (text.empty()) return;
  for (const FolderEntry* entry : shown())
    if (begins_with(entry->name, text)) {
      chosen_ = entry->name;
      scroll_ = true;
      return;
    }
}

/// As far as all names that begin so go on alike; a single folder is gone into.
void FileDialog::complete(ImGuiInputTextCallbackData& data) {
  const std::string text(data.Buf, static_cast<std::size_t>(data.BufTextLen));
  std::vector<std::string> names;
  for (const FolderEntry* entry : shown())
    if (begins_with(entry->name, text)) names.push_back(entry->name);
  if (names.empty()) return;
  std::string common = names.front();
  for (const std::string& name : names) {
    std::size_t same = 0;
    while (same < std::min(common.size(), name.size()) && common[same] == name[same]) ++same;
    common.resize(same);
  }
  if (common.size() < text.size()) return;
  replace(data, common);
  if (names.size() == 1 && enter_typed_folder(common + "/")) {
    data.DeleteChars(0, data.BufTextLen);
    return;
  }
  find_typed(common);
}

void FileDialog::step(ImGuiInputTextCallbackData& data, int by) {
  const auto rows = shown();
  if (rows.empty()) return;
  const auto at = std::find_if(rows.begin(), rows.end(), [this](const FolderEntry* entry) {
    return chosen_ && entry->name == *chosen_;
  });
  const auto last = static_cast<int>(rows.size()) - 1;
  int row = by > 0 ? 0 : last;
  if (at != rows.end()) row = std::clamp(static_cast<int>(at - rows.begin()) + by, 0, last);
  chosen_ = rows[static_cast<std::size_t>(row)]->name;
  scroll_ = true;
  replace(data, *chosen_);
}

}  // namespace winslow::gui
