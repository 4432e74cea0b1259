#pragma once

#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "gui/render/color_scale.h"

struct ImDrawList;
struct ImFont;

namespace winslow::gui {

/// A vertical colour bar with ticks, a title and a histogram of the values beside it.
struct Legend {
  std::string title;
  ColorScale scale;
  std::optional<Histogram> histogram;  ///< over the scale's range, see histogram_over()
  bool more_below = false;  ///< values below the range exist: the lowest tick reads "<= 0"
  bool more_above = false;  ///< values above the range exist: the highest tick reads ">= 3"
  /// Colour of the inverted elements, shown below the bar; none: there are no such elements, or
  /// they are coloured by their values.
  std::optional<Rgb> inverted = {};
};

/// The legend of these values, with their histogram.
Legend legend_of(const ElementField& field, std::span<const double> values,
                 const ColorScale& scale);

/// Sizes in pixels of the draw list.
struct LegendStyle {
  float font_size = 14;
  float bar_width = 14;
  float histogram_width = 44;  ///< used only with a histogram
  std::array<float, 4> text_color{0.13f, 0.15f, 0.18f, 1};
  std::array<float, 4> line_color{0.45f, 0.48f, 0.53f, 1};
  ImFont* font = nullptr;        ///< null: the current font
  ImFont* title_font = nullptr;  ///< null: `font`
};

/// About `wanted` round values along a legend's bar, and its ends.
struct LegendTick {
  double value;
  std::string text;
};
std::vector<LegendTick> legend_ticks(const Legend& legend, int wanted);

/// Width of a legend with ticks and title, in the fonts of the current ImGui context.
float legend_width(const Legend& legend, const LegendStyle& style);

/// The box of a legend's colours and histogram, in pixels; values increase from bottom to top.
struct LegendBars {
  float left, top, right, bottom;
};
LegendBars legend_bars(float x, float y, float height, const Legend& legend,
                       const LegendStyle& style);

/// Draws a legend with its top left corner at (x, y), `height` high, title included.
void draw_legend(ImDrawList& list, float x, float y, float height, const Legend& legend,
                 const LegendStyle& style);

}  // namespace winslow::gui
