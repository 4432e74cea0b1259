#pragma once

#include <imgui.h>

#include <cmath>

#include "core/outer/outer_solver.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// The range of values shown in a strip of a plot.
struct PlotAxis {
  double low = 0, high = 1;  ///< values, or decades if logarithmic
  bool logarithmic = false;

  /// 0 at the bottom of the strip, 1 at its top; values beyond are clamped.
  double share(double value) const {
    constexpr double floor_value = 1e-16, ceiling_value = 1e16;
    const double v =
        logarithmic ? std::log10(std::clamp(value, floor_value, ceiling_value)) : value;
    return std::clamp((v - low) / (high - low), 0.0, 1.0);
  }
};

/// A part of a plot with separate axes. Strips above one another share the iterations.
struct PlotStrip {
  ImVec2 min, max;             ///< of the plotting area, pixels
  double first = 0, last = 1;  ///< iterations at the left and at the right

  float x(double iteration) const {
    return min.x + static_cast<float>((iteration - first) / (last - first)) * (max.x - min.x);
  }
  float y(const PlotAxis& axis, double value) const {
    return max.y - static_cast<float>(axis.share(value)) * (max.y - min.y);
  }
};

/// Axis that contains the positive residuals, moves and the tolerance, in whole decades.
PlotAxis residual_axis(std::span<const IterationRecord> history, double tolerance,
                       bool with_residual, bool with_move);
/// Axis from 0 to slightly above the largest number of inverted elements.
PlotAxis inverted_axis(std::span<const IterationRecord> history);
/// Axis that contains 0 and all sines.
PlotAxis sine_axis(std::span<const IterationRecord> history);

/// The decades of a logarithmic axis to label, with room for about `wanted` labels: equally spaced,
/// including the lowest; at least two if the axis has as many.
std::vector<int> named_decades(const PlotAxis& axis, int wanted);

/// Reduces points, ordered from left to right, to distinguishable ones: the first, lowest, highest
/// and last of each column of pixels.
std::vector<ImVec2> decimated(const std::vector<ImVec2>& points);

/// Draws text with an anchor: align 0 for left or top, 0.5 for the middle, 1 for right or bottom.
void text_at(ImDrawList& list, const ImVec2& anchor, const ImVec2& align, ImU32 color,
             const std::string& text);

}  // namespace winslow::gui

namespace winslow::gui::ui {

/// Heights of layers, from the wall outwards, in units of the mesh.
struct LayerHeights {
  std::vector<double> wanted;    ///< a line
  std::vector<double> realised;  ///< dots; empty: none yet
};

/// A small plot of height over the number of the layer, as wide as the row.
void height_plot(std::string_view id, const LayerHeights& heights, const Theme& theme);

}  // namespace winslow::gui::ui
