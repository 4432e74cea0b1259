#pragma once

#include <imgui.h>

#include <cstddef>
#include <span>
#include <string>

#include "gui/base/screen.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

// More would be no help to anyone, and slow.
inline constexpr std::size_t most_id_labels = 600;

/// The number of a node or of an element, where it is on the screen.
struct IdLabel {
  ScreenPoint at;  ///< middle of the text
  std::string text;
  bool node = false;
};

ImVec2 id_label_size(const Theme& theme, const std::string& text);
/// Nodes on cards, elements bare but for what sets them off: the two are told apart.
void draw_id_label(ImDrawList& list, const Theme& theme, const IdLabel& label);
/// What stands in place of numbers that have no room. at: its upper left corner.
void draw_no_id_labels(ImDrawList& list, const Theme& theme, const ImVec2& at);

}  // namespace winslow::gui
