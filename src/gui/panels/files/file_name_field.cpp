#include "gui/panels/files/file_name_field.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui_stdlib.h>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace fs = std::filesystem;

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
  // Backspace in what was empty before it was pressed.
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

/// "meshes/" goes into that folder, "/" and "~/" to where every shell would.
bool FileNameField::enter_typed_folder(const std::string& text) {
  const auto folder = choice_.folder.typed_folder(text);
  if (!folder) return false;
  choice_.go(*folder);
  choice_.focus_name = false;  // it has the keyboard already
  return true;
}

/// As far as all names that begin so go on alike; a single folder is gone into.
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
