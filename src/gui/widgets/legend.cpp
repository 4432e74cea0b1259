#include "gui/widgets/legend.h"

#include <imgui.h>

#include <cstdio>

#include "gui/base/text.h"
#include "gui/render/color_scale.h"

namespace winslow::gui {
namespace {

constexpr int histogram_bins = 40;
constexpr float tick_length = 5;
constexpr float tick_gap = 5;

ImU32 to_color(const std::array<float, 4>& c) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], c[3]));
}

ImU32 to_color(const Rgb& c, float alpha = 1) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], alpha));
}

ImFont& font_of(const LegendStyle& style) {
  return style.font != nullptr ? *style.font : *ImGui::GetFont();
}

ImFont& title_font_of(const LegendStyle& style) {
  return style.title_font != nullptr ? *style.title_font : font_of(style);
}

ImVec2 text_size(const ImFont& font, float size, const std::string& text) {
  return font.CalcTextSizeA(size, 1e6f, 0, text.c_str());
}

float bars_width(const Legend& legend, const LegendStyle& style) {
  return style.bar_width + (legend.histogram.has_value() ? style.histogram_width : 0.0f);
}

float title_height(const Legend& legend, const LegendStyle& style) {
  return legend.title.empty() ? 0.0f : 1.7f * style.font_size;
}

/// Height of the line below the bar for the colour of inverted elements.
float inverted_height(const Legend& legend, const LegendStyle& style) {
  return legend.inverted ? 2.0f * style.font_size : 0.0f;
}

constexpr const char* inverted_text = "inverted";

constexpr int fewest_ticks = 2;
constexpr int most_ticks = 8;

int ticks_for(float bar_height, float font_size) {
  return std::clamp(static_cast<int>(bar_height / (3.5f * font_size)), fewest_ticks, most_ticks);
}

struct Box {
  float left, top, right, bottom;
  float height() const { return bottom - top; }
};

/// Draws the colours, one strip per pixel row or per band, low values at the bottom.
void draw_bar(ImDrawList& list, const Box& box, const ColorScale& scale, float alpha) {
  const int strips = scale.strips(static_cast<int>(box.height()));
  for (int k = 0; k < strips; ++k) {
    const double t = (k + 0.5) / strips;
    const float y1 = box.bottom - box.height() * static_cast<float>(k) / static_cast<float>(strips);
    const float y0 =
        box.bottom - box.height() * static_cast<float>(k + 1) / static_cast<float>(strips);
    list.AddRectFilled({box.left, y0}, {box.right, y1},
                       to_color(scale.color(scale.value_at(t)), alpha));
  }
}

/// Draws bars in the colours of their values on a paler background. Lengths are proportional to the
/// square root of the counts, so that a few bad elements are visible beside many good ones.
void draw_histogram(ImDrawList& list, const Box& box, const Legend& legend) {
  const auto& counts = legend.histogram->counts;
  if (counts.empty()) return;
  draw_bar(list, box, legend.scale, 0.14f);
  const Index most = *std::ranges::max_element(counts);
  if (most <= 0) return;
  const auto n = static_cast<float>(counts.size());
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] <= 0) continue;
    const double share = std::sqrt(static_cast<double>(counts[k]) / most);
    const float length = std::max(static_cast<float>(share) * (box.right - box.left - 2), 1.5f);
    const float y1 = box.bottom - box.height() * static_cast<float>(k) / n;
    const float y0 = box.bottom - box.height() * static_cast<float>(k + 1) / n;
    const double value = legend.scale.value_at((static_cast<double>(k) + 0.5) / n);
    list.AddRectFilled({box.left, y0 + 0.5f}, {box.left + length, y1 - 0.5f},
                       to_color(legend.scale.color(value)));
    // An outline, for colours similar to the background.
    list.AddRect({box.left, y0 + 0.5f}, {box.left + length, y1 - 0.5f},
                 IM_COL32(110, 115, 125, 150));
  }
}

void draw_ticks(ImDrawList& list, const Box& box, const Legend& legend, const LegendStyle& style) {
  const ImFont& font = font_of(style);
  const bool extended = legend.scale.high > legend.scale.low;
  for (const LegendTick& tick : legend_ticks(legend, ticks_for(box.height(), style.font_size))) {
    const double t = extended ? legend.scale.share(tick.value) : 0.5;
    const float y = std::round(box.bottom - box.height() * static_cast<float>(t));
    list.AddLine({box.right, y}, {box.right + tick_length, y}, to_color(style.line_color), 1.0f);
    const ImVec2 size = text_size(font, style.font_size, tick.text);
    list.AddText(&font, style.font_size,
                 {std::round(box.right + tick_length + tick_gap), std::round(y - 0.5f * size.y)},
                 to_color(style.text_color), tick.text.c_str());
  }
}

/// Draws a swatch and a word, below the bar and its lowest label.
void draw_inverted(ImDrawList& list, float x, float bottom, const Legend& legend,
                   const LegendStyle& style) {
  const ImVec2 size = text_size(font_of(style), style.font_size, inverted_text);
  const float y = std::round(bottom - size.y);
  list.AddRectFilled({x, y}, {x + style.bar_width, y + size.y}, to_color(*legend.inverted));
  list.AddText(&font_of(style), style.font_size, {x + style.bar_width + tick_gap, y},
               to_color(style.text_color), inverted_text);
}

}  // namespace

Legend legend_of(const ElementField& field, std::span<const double> values,
                 const ColorScale& scale) {
  Legend legend;
  legend.title = std::string(field_info(field).label);
  legend.scale = scale;
  legend.histogram = histogram_over(values, scale, histogram_bins);
  const double slack = 1e-9 * (scale.high - scale.low);
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    legend.more_below |= v < scale.low - slack;
    legend.more_above |= v > scale.high + slack;
  }
  return legend;
}

std::vector<LegendTick> legend_ticks(const Legend& legend, int wanted) {
  const ColorScale& scale = legend.scale;
  const bool decades = scale.by_ratio() && scale.high >= 10 * scale.low;
  const std::vector<double> values = decades ? log_ticks(scale.low, scale.high, wanted)
                                             : nice_ticks(scale.low, scale.high, wanted);
  const double step = values.size() > 1 ? values[1] - values[0] : scale.high - scale.low;
  std::vector<LegendTick> ticks;
  for (const double v : values)
    ticks.push_back({v, decades ? format_power(v) : format_tick(v, step)});
  // At this distance the label of an end does not touch that of the next tick.
  const double apart =
      values.size() > 1 ? scale.share(values[1]) - scale.share(values[0]) : 1.0 / wanted;
  const double clear = 0.6 * std::min(apart, 1.0 / wanted);
  if (values.empty() || scale.share(values.front()) > clear)
    ticks.push_back({scale.low, format_power(scale.low)});
  if (values.empty() || 1 - scale.share(values.back()) > clear)
    ticks.push_back({scale.high, format_power(scale.high)});
  for (auto& [v, text] : ticks) {
    if (legend.more_above && scale.share(v) > 1 - 1e-6) text = "\u2265 " + text;
    if (legend.more_below && scale.share(v) < 1e-6) text = "\u2264 " + text;
  }
  return ticks;
}

float legend_width(const Legend& legend, const LegendStyle& style) {
  // The widest labels for any number of ticks that may fit the height.
  float ticks = 0;
  for (int wanted = fewest_ticks; wanted <= most_ticks; ++wanted) {
    for (const LegendTick& tick : legend_ticks(legend, wanted)) {
      ticks = std::max(ticks, text_size(font_of(style), style.font_size, tick.text).x);
    }
  }
  const float bar = bars_width(legend, style) + tick_length + tick_gap + ticks;
  float widest = std::max(bar, text_size(title_font_of(style), style.font_size, legend.title).x);
  if (legend.inverted)
    widest = std::max(widest, style.bar_width + tick_gap +
                                  text_size(font_of(style), style.font_size, inverted_text).x);
  return std::ceil(widest);
}

LegendBars legend_bars(float x, float y, float height, const Legend& legend,
                       const LegendStyle& style) {
  // Half a line below, so that the lowest tick's label stays inside.
  return {x, y + title_height(legend, style), x + bars_width(legend, style),
          y + height - 0.5f * style.font_size - inverted_height(legend, style)};
}

void draw_legend(ImDrawList& list, float x, float y, float height, const Legend& legend,
                 const LegendStyle& style) {
  if (!legend.title.empty()) {
    list.AddText(&title_font_of(style), style.font_size, {std::round(x), std::round(y)},
                 to_color(style.text_color), legend.title.c_str());
  }
  if (legend.inverted) draw_inverted(list, x, y + height, legend, style);
  const LegendBars bars = legend_bars(x, y, height, legend, style);
  const Box whole{bars.left, bars.top, bars.right, bars.bottom};
  if (whole.height() < style.font_size) return;
  const Box bar{whole.left, whole.top, whole.left + style.bar_width, whole.bottom};
  draw_bar(list, bar, legend.scale, 1);
  if (legend.histogram.has_value()) {
    draw_histogram(list, {bar.right, whole.top, whole.right, whole.bottom}, legend);
    list.AddLine({bar.right, whole.top}, {bar.right, whole.bottom}, to_color(style.line_color));
  }
  list.AddRect({whole.left, whole.top}, {whole.right, whole.bottom}, to_color(style.line_color));
  draw_ticks(list, whole, legend, style);
}

}  // namespace winslow::gui
