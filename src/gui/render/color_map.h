#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.h"

namespace winslow::gui {

/// Colour in [0, 1], as sent to the screen (sRGB values).
using Rgb = std::array<float, 3>;

/// Sequential maps from dark to bright, told apart by the colour-blind too: viridis, cividis,
/// glacier, plasma, magma, inferno. The last three contain red, which inverted elements wear.
std::vector<std::string> color_map_names();
/// Colour at t in [0, 1] (clamped). Throws UsageError for an unknown name.
Rgb sample_color_map(std::string_view name, double t);

/// Values to colours: range, map, banding.
struct ColorScale {
  std::string map = "viridis";
  double low = 0, high = 1;
  bool reversed = false;  ///< low values get the map's end, high ones its start
  int bands = 0;          ///< 0: continuous
  /// Clamped to the range; a NaN is grey. Throws UsageError for an unknown map.
  Rgb color(double value) const;
};

/// Colour of the i-th marker: dark and distinguishable, by the colour-blind too; repeats.
Rgb marker_color(Index marker, bool dark_background = false);

}  // namespace winslow::gui
