#include "gui/panels/layout.h"

namespace winslow::gui {

namespace {

// In units of the layout.
constexpr float folded_width = 40;
constexpr float empty_plot = 40;                      // a strip with its title
constexpr float least_left = 252, least_right = 284;  // no content is clipped
/// Width of the legend's strip with and without the histogram; in a view below `least_view` there
/// is no strip.
constexpr float roomy_strip = 132, narrow_strip = 94, least_view = 230;
/// Least total width of mesh and strip for which the histogram is shown.
constexpr float roomy_view = 620;

}  // namespace

void Layout::arrange(int width, int height, const ViewOptions& view, const Theme& theme,
                     float menu_height, Middle content) {
  const auto w = static_cast<float>(width);
  const auto h = static_cast<float>(height);
  plot_height = std::clamp(plot_height, 120.0f, 480.0f);
  const float tool_height = theme.px(46);
  const float status_height = theme.px(28);
  arrange_columns(w, view, theme);
  if (content == Middle::page) left = right = Area();
  const float l = left.width, r = right.width;
  const float top = menu_height + tool_height;
  const float middle = std::max(h - top - status_height, 1.0f);
  const bool plotted = view.plot_panel && content == Middle::mesh;
  const float wanted = theme.px(plot_empty ? empty_plot : plot_height);
  const float p = plotted ? std::min(wanted, 0.5f * middle) : 0;
  menu = {0, 0, w, menu_height};
  toolbar = {0, menu_height, w, tool_height};
  left = {0, top, l, middle};
  right = {w - r, top, r, middle};
  plot = {l, top + middle - p, w - l - r, p};
  viewport = {l, top, std::max(w - l - r, 1.0f), std::max(middle - p, 1.0f)};
  status = {0, h - status_height, w, status_height};
  legend = Area();
  if (content == Middle::mesh) split_off_legend(view, theme);
}

void Layout::arrange_mesh(int width, int height, const ViewOptions& view, const Theme& theme) {
  menu = toolbar = left = right = plot = status = legend = Area();
  viewport = {0, 0, static_cast<float>(width), static_cast<float>(height)};
  split_off_legend(view, theme);
}

/// Limits both columns together to less than half of the width, since the mesh is more important.
void Layout::arrange_columns(float width, const ViewOptions& view, const Theme& theme) {
  left_width = std::clamp(left_width, least_left, 480.0f);
  right_width = std::clamp(right_width, least_right, 520.0f);
  const float budget = most_columns * width;
  const float fold = theme.px(folded_width);
  columns.both_fit = theme.px(least_left + least_right) <= budget;
  columns.left_open = view.left_panel;
  columns.right_open = view.right_panel && (columns.both_fit || !view.left_panel);
  left = right = Area();
  left.width = columns.left_open ? theme.px(left_width) : fold;
  right.width = columns.right_open ? theme.px(right_width) : fold;
  const float excess = left.width + right.width - budget;
  if (excess <= 0) return;
  if (!columns.left_open || !columns.right_open) {
    Area& open = columns.left_open ? left : right;
    open.width = std::max(open.width - excess, fold);
    return;
  }
  // Each column shrinks in proportion to its excess over its least width.
  const float spare_left = left.width - theme.px(least_left);
  const float spare_right = right.width - theme.px(least_right);
  const float share = excess / (spare_left + spare_right);
  left.width -= share * spare_left;
  right.width -= share * spare_right;
}

void Layout::split_off_legend(const ViewOptions& view, const Theme& theme) {
  if (!legend_has_strip(view)) return;
  const bool roomy = viewport.width >= theme.px(roomy_view);
  const float width = theme.px(roomy ? roomy_strip : narrow_strip);
  if (viewport.width - width < theme.px(least_view)) return;
  viewport.width -= width;
  legend = {viewport.x + viewport.width, viewport.y, width, viewport.height};
  if (view.legend_place == LegendPlace::right) return;
  legend.x = viewport.x;
  viewport.x += width;
}

}  // namespace winslow::gui
