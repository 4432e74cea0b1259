#pragma once

#include <functional>
#include <string>

#include "gui/widgets/theme.h"

/// Short lists of what the user has put together: walls with their layers, bodies with their
/// motions.
namespace winslow::gui::ui {

/// A row of two lines.
struct ListRow {
  std::string id;  ///< of the row; its cross has the id "ID/remove"
  std::string title, summary;
  std::string tip, remove_tip;
  bool selected = false;
};
enum class RowAnswer { none, pressed, removed };

/// Draws a row, with a cross at its end that removes it.
RowAnswer draw_list_row(const ListRow& row, const Theme& theme);

/// Draws a frame with `count` rows, scrolling beyond five. draw: draws one row; false: stop.
void draw_list(const char* id, std::size_t count, const Theme& theme,
               const std::function<bool(std::size_t)>& draw);

}  // namespace winslow::gui::ui
