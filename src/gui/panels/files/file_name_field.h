#pragma once

#include <string>

#include "gui/panels/files/file_choice.h"
#include "gui/panels/panel.h"

struct ImGuiInputTextCallbackData;

namespace winslow::gui {

/// Where the name of a file is typed. Letters find a row of the folder, Tab completes, arrow keys
/// choose, a slash goes into a folder, Backspace in an empty field goes up.
class FileNameField {
 public:
  explicit FileNameField(FileChoice& choice) : choice_(choice) {}
  /// True if Enter was pressed.
  bool draw(const PanelContext& context);

 private:
  int edit(ImGuiInputTextCallbackData& data);
  void complete(ImGuiInputTextCallbackData& data, const std::string& text);
  void step(ImGuiInputTextCallbackData& data, int by);
  bool enter_typed_folder(const std::string& text);

  FileChoice& choice_;
};

}  // namespace winslow::gui
