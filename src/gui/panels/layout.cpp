#include "gui/panels/layout.h"

#include <algorithm>

namespace winslow::gui {

namespace {

constexpr float strip_height = 40;

}  // namespace

void Layout::arrange(int width, int height, const ViewOptions& view, const Theme& theme,
                     float menu_height) {
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  left_width = std::clamp(left_width, 200.0f, 480.0f);
  right_width = std::clamp(right_width, 240.0f, 520.0f);
  plot_height = std::clamp(plot_height, 120.0f, 480.0f);
  const float tool_height = theme.px(46);
  const float status_height = theme.px(28);
  const float l = view.left_panel ? std::min(theme.px(left_width), 0.34f * w) : 0;
  const float r = view.right_panel ? std::min(theme.px(right_width), 0.36f * w) : 0;
  const float top = menu_height + tool_height;
  const float middle = std::max(h - top - status_height, 1.0f);
  const float wanted = theme.px(plot_empty ? strip_height : plot_height);
  const float p = view.plot_panel ? std::min(wanted, 0.5f * middle) : 0;
  menu = {0, 0, w, menu_height};
  toolbar = {0, menu_height, w, tool_height};
  left = {0, top, l, middle};
  right = {w - r, top, r, middle};
  plot = {l, top + middle - p, w - l - r, p};
  viewport = {l, top, std::max(w - l - r, 1.0f), std::max(middle - p, 1.0f)};
  status = {0, h - status_height, w, status_height};
}

}  // namespace winslow::gui
