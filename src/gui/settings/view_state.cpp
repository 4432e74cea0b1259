#include "gui/settings/view_state.h"

namespace winslow::gui {

void open_left(ViewOptions& view, const ColumnState& columns) {
  view.left_panel = true;
  if (!columns.both_fit) view.right_panel = false;
}

void open_right(ViewOptions& view, const ColumnState& columns) {
  view.right_panel = true;
  if (!columns.both_fit) view.left_panel = false;
}

void fold_left(ViewOptions& view, const ColumnState& columns) {
  view.left_panel = false;
  if (!columns.both_fit) view.right_panel = false;
}

void fold_right(ViewOptions& view, const ColumnState& columns) {
  view.right_panel = false;
  if (!columns.both_fit) view.left_panel = false;
}

}  // namespace winslow::gui
