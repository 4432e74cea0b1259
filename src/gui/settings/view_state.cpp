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

void InterfaceScale::set_window(int width, int height) {
  width_ = width;
  height_ = height;
}

float InterfaceScale::of(double chosen) const {
  return fitting(chosen > 0 ? chosen : static_cast<double>(screen_));
}

/// At a larger scale the buttons of a prompt would lie outside the window.
float InterfaceScale::fitting(double wanted) const {
  // Layout size with room for tables and labels; windows can hardly be smaller.
  constexpr double least_width = 720, least_height = 450;
  const double fits = std::min(width_ / least_width, height_ / least_height);
  if (wanted <= fits) return static_cast<float>(wanted);
  double largest = scales.front();
  for (const double s : scales)
    if (s <= fits) largest = s;
  return static_cast<float>(std::min(wanted, largest));
}

}  // namespace winslow::gui
