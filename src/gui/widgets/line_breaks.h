#pragma once

#include <string>
#include <string_view>

namespace winslow::gui::ui {

/// The text on lines of that width (pixels) in the present font, broken at spaces alone: Dear ImGui
/// also breaks after a point, amid a number. A word that is longer keeps its line.
std::string with_line_breaks(std::string_view text, float width);

}  // namespace winslow::gui::ui
