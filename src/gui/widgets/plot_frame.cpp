#include "gui/widgets/plot_frame.h"

#include "gui/base/text.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

PlotAxis residual_axis(std::span<const IterationRecord> history, double tolerance,
                       bool with_residual, bool with_move) {
  const auto bounded = [](double v) { return std::clamp(v, 1e-16, 1e16); };
  double smallest = bounded(tolerance);
  double largest = smallest;
  const auto take = [&](double v) {
    if (!(v > 0)) return;
    smallest = std::min(smallest, bounded(v));
    largest = std::max(largest, bounded(v));
  };
  for (const IterationRecord& r : history) {
    if (with_residual) take(r.residual);
    if (with_move) take(r.largest_move);
  }
  PlotAxis axis{0, 0, true};
  axis.low = std::floor(std::log10(smallest) - 0.15);
  axis.high = std::max(axis.low + 1, std::ceil(std::log10(largest) + 0.15));
  if (history.empty()) axis.high = std::max(axis.high, 0.0);
  return axis;
}

PlotAxis inverted_axis(std::span<const IterationRecord> history) {
  double most = 1;
  for (const IterationRecord& r : history) most = std::max(most, static_cast<double>(r.inverted));
  return {0, round_up_nicely(most), false};
}

PlotAxis sine_axis(std::span<const IterationRecord> history) {
  double low = 0;
  double high = 0;
  for (const IterationRecord& r : history) {
    if (!std::isfinite(r.min_sine)) continue;
    low = std::min(low, r.min_sine);
    high = std::max(high, r.min_sine);
  }
  if (low == 0 && high == 0) return {0, 1, false};
  return {low < 0 ? -round_up_nicely(-low) : 0, high > 0 ? round_up_nicely(high) : 0, false};
}

std::vector<int> named_decades(const PlotAxis& axis, int wanted) {
  const int low = static_cast<int>(std::ceil(axis.low - 1e-9));
  const int high = static_cast<int>(std::floor(axis.high + 1e-9));
  const int gaps = std::max(wanted - 1, 1);
  const int step = std::max(1, (high - low + gaps - 1) / gaps);
  std::vector<int> decades;
  for (int decade = low; decade <= high; decade += step) decades.push_back(decade);
  return decades;
}

std::vector<ImVec2> decimated(const std::vector<ImVec2>& points) {
  std::vector<ImVec2> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    const float column = std::floor(points[begin].x);
    std::size_t end = begin;
    std::size_t low = begin;
    std::size_t high = begin;
    for (; end < points.size() && std::floor(points[end].x) == column; ++end) {
      if (points[end].y < points[low].y) low = end;
      if (points[end].y > points[high].y) high = end;
    }
    std::vector<std::size_t> chosen{begin, std::min(low, high), std::max(low, high), end - 1};
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t k : chosen) kept.push_back(points[k]);
    begin = end;
  }
  return kept;
}

void text_at(ImDrawList& list, const ImVec2& anchor, const ImVec2& align, ImU32 color,
             const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddText(
      ImVec2(std::round(anchor.x - align.x * size.x), std::round(anchor.y - align.y * size.y)),
      color, text.c_str());
}

}  // namespace winslow::gui

namespace winslow::gui::ui {

namespace {

/// Logarithmic axis that contains all heights: the first may be a thousandth of the last.
std::optional<PlotAxis> axis_of(const LayerHeights& heights) {
  double lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const auto* values : {&heights.wanted, &heights.realised})
    for (const double h : *values) {
      if (!(h > 0)) continue;
      lowest = std::min(lowest, h);
      highest = std::max(highest, h);
    }
  if (!(highest > 0)) return std::nullopt;
  PlotAxis axis{std::log10(lowest), std::log10(highest), true};
  const double room = std::max(0.05 * (axis.high - axis.low), 0.02);
  return PlotAxis{axis.low - room, axis.high + room, true};
}

/// Draws labelled lines at powers of ten, or at the ends of an axis with fewer than two of them.
void draw_heights_axis(ImDrawList& list, const PlotStrip& strip, const PlotAxis& axis,
                       const Theme& theme) {
  const auto line = [&](double decades, const std::string& name) {
    const float y = strip.y(axis, std::pow(10.0, decades));
    list.AddLine(ImVec2(strip.min.x, y), ImVec2(strip.max.x, y), palette().grid, theme.px(1));
    text_at(list, ImVec2(strip.min.x - theme.px(5), y), ImVec2(1, 0.5f), palette().text_dim, name);
  };
  const int room =
      1 + static_cast<int>((strip.max.y - strip.min.y) / (1.2f * ImGui::GetTextLineHeight()));
  const std::vector<int> decades = named_decades(axis, room);
  if (decades.size() < 2) {
    for (const double end : {axis.low, axis.high})
      line(end, formatted(std::pow(10.0, end), "%.2g"));
    return;
  }
  for (const int decade : decades) line(decade, "1e" + std::to_string(decade));
}

}  // namespace

void height_plot(std::string_view id, const LayerHeights& heights, const Theme& theme) {
  const std::size_t count = std::max(heights.wanted.size(), heights.realised.size());
  if (count == 0) return;
  const auto axis = axis_of(heights);
  if (!axis) return;
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = theme.px(104);
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 max(min.x + width, min.y + height);
  ImGui::Dummy(ImVec2(width, height));
  note(id);
  tooltip(
      "Height of each layer in units of the mesh, from the wall outwards, on a logarithmic axis: "
      "wanted (line) and, where layers are in, realised (dots).");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(min, max, palette().card, theme.px(4));
  list.AddRect(min, max, palette().border, theme.px(4));
  const float pad = theme.px(10);
  const PlotStrip strip{ImVec2(min.x + theme.px(46), min.y + pad + theme.px(12)),
                        ImVec2(max.x - pad, max.y - pad), 0.5, static_cast<double>(count) + 0.5};
  draw_heights_axis(list, strip, *axis, theme);
  std::vector<ImVec2> line;
  for (std::size_t k = 0; k < heights.wanted.size(); ++k)
    line.emplace_back(strip.x(static_cast<double>(k + 1)), strip.y(*axis, heights.wanted[k]));
  list.AddPolyline(line.data(), static_cast<int>(line.size()), palette().accent, 0, theme.px(1.5f));
  for (std::size_t k = 0; k < heights.realised.size(); ++k)
    list.AddCircleFilled(
        ImVec2(strip.x(static_cast<double>(k + 1)), strip.y(*axis, heights.realised[k])),
        theme.px(2.5f), palette().text);
  text_at(list, ImVec2(min.x + pad, min.y + theme.px(4)), ImVec2(0, 0), palette().text_dim,
          "layer height");
  text_at(list, ImVec2(max.x - pad, min.y + theme.px(4)), ImVec2(1, 0), palette().text_dim,
          counted(count, "layer"));
}

}  // namespace winslow::gui::ui
