#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "gui/render/color_map.h"

namespace winslow::gui {

/// What a user says of the colours of values.
struct ColorChoice {
  std::string map = "automatic";  ///< or one of color_map_names()
  ColorAxis axis = ColorAxis::automatic;
  /// Range from the one percentile of the values to the other, in percent; none: automatic.
  std::optional<std::array<double, 2>> percentiles = {};
  std::optional<std::array<double, 2>> range = {};  ///< by its ends; it goes before percentiles
  int bands = 0;                                    ///< 0: continuous
  bool on_dark = false;                             ///< of the ground

  bool operator==(const ColorChoice&) const = default;
};

/// "automatic" and color_map_names().
std::vector<std::string> color_map_choices();
/// The map that "automatic" is on a linear scale: neutral where a field says how good elements are,
/// viridis where it does not (area, layer), puor where 1 is best on a way between two bad ends.
/// Logarithmic scales have viridis. Other names stay.
std::string color_map_for(const ElementField& field, const std::string& choice);

/// The colours in which a metric is shown: bad elements stand out, good ones do not. Where the user
/// chose no range: Normalized Jacobian: 0 to 1. Aspect ratio and condition number: from 1 to a
/// round number above all but the worst half percent (at least 1.5), so that a single sliver does
/// not wash out the rest; kappa likewise. Area: to the same percentile. Residual: from 0 to that
/// percentile. Smallest weight: to 1, from 0 or the worst half percent if that is less. Values that
/// are not finite are left out. Fields with a sign (sine, area, smallest weight) have the middle of
/// a diverging map at zero: negative ones are orange; ratios of which 1 is best have it there.
/// Where that would show a mesh in one colour, as boundary layers make it of aspect ratio,
/// condition number and area, the scale is logarithmic, from the first to the last percentile. A
/// logarithmic scale that is asked for leaves out what is not positive; where nothing is, the scale
/// is linear.
ColorScale color_scale(const ElementField& field, std::span<const double> values,
                       const ColorChoice& choice);

/// Counts of values in equal bins over the scale's range; values beyond it count in the last bin on
/// their side, those that are not finite nowhere.
Histogram histogram_over(std::span<const double> values, const ColorScale& scale, int bins);

}  // namespace winslow::gui
