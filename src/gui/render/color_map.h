#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::gui {

using Rgb = std::array<float, 3>;  ///< linear in [0, 1] as sent to the screen (sRGB values)

/// Perceptually uniform, colour-blind safe maps.
std::vector<std::string> color_map_names();
/// Colour at t in [0, 1] (clamped). Throws UsageError for an unknown name.
Rgb sample_color_map(std::string_view name, double t);

/// Values to colours: range, map, banding.
struct ColorScale {
  std::string map = "viridis";
  double low = 0, high = 1;
  bool reversed = false;  ///< bad values at the bright end
  int bands = 0;          ///< 0: continuous
  Rgb color(double value) const;
};

}  // namespace winslow::gui
