#include "gui/widgets/line_breaks.h"

#include <imgui.h>

#include <algorithm>

namespace winslow::gui::ui {

std::string with_line_breaks(std::string_view text, float width) {
  std::string broken;
  std::size_t line = 0;  // where it begins in `broken`
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string word(text.substr(at, end - at));
    const std::string longer = broken.substr(line) + word;
    const bool fits = ImGui::CalcTextSize(longer.c_str()).x <= width;
    if (!fits && broken.size() > line && broken.back() == ' ') {
      broken.back() = '\n';
      line = broken.size();
    }
    broken += word;
    if (end < text.size()) broken += text[end];
    if (end < text.size() && text[end] == '\n') line = broken.size();
    at = end + 1;
  }
  return broken;
}

}  // namespace winslow::gui::ui
