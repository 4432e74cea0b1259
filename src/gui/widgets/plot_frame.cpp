#include "gui/widgets/plot_frame.h"

#include "gui/render/ticks.h"

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
