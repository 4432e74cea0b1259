#pragma once

#include <imgui.h>

#include <cmath>

#include "core/outer/outer_solver.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Values that a strip of a plot shows, and where in pixels.
struct PlotAxis {
  double low = 0, high = 1;  ///< values, or decades if logarithmic
  bool logarithmic = false;

  /// 0 at the bottom of the strip, 1 at its top; what lies beyond is drawn on the edge.
  double share(double value) const {
    constexpr double floor_value = 1e-16, ceiling_value = 1e16;
    const double v =
        logarithmic ? std::log10(std::clamp(value, floor_value, ceiling_value)) : value;
    return std::clamp((v - low) / (high - low), 0.0, 1.0);
  }
};

/// Part of a plot with axes of its own. Strips above one another share the iterations.
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

/// Axis around the positive residuals, moves and the tolerance: whole decades.
PlotAxis residual_axis(std::span<const IterationRecord> history, double tolerance,
                       bool with_residual, bool with_move);
/// From 0 to a little above the most inverted elements.
PlotAxis inverted_axis(std::span<const IterationRecord> history);
/// Around 0 and all sines.
PlotAxis sine_axis(std::span<const IterationRecord> history);

/// Whole decades of a logarithmic axis that are named where there is room for about `wanted` names:
/// evenly apart, the lowest among them; at least two, however little room there is.
std::vector<int> named_decades(const PlotAxis& axis, int wanted);

/// Points left to right with as many of them as can be told apart: of each column of pixels the
/// first, the lowest, the highest and the last.
std::vector<ImVec2> decimated(const std::vector<ImVec2>& points);

/// Text placed by a point of it: align 0 for left or top, 0.5 for the middle, 1 for right or
/// bottom.
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
