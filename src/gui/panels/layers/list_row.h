#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "gui/widgets/theme.h"

namespace winslow::gui {

/// What a row of a list in the panel of layers says: two lines.
struct ListRow {
  std::string id;
  std::string title, summary;
  std::string tip, remove_tip;
  bool selected = false;
};
enum class RowAnswer { none, pressed, removed };

/// Draws a row, with a cross at its end that removes it.
RowAnswer draw_list_row(const ListRow& row, const Theme& theme);

/// A frame for so many rows, those beyond the fifth by scrolling. draw: one row, false: no more.
void draw_list(const char* id, std::size_t count, const Theme& theme,
               const std::function<bool(std::size_t)>& draw);

}  // namespace winslow::gui
