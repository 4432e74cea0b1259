#pragma once

#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "core/types.h"

namespace winslow::gui {

/// Colour in [0, 1], as sent to the screen (sRGB values).
using Rgb = std::array<float, 3>;

/// Maps that the colour-blind can read, too. From dark to bright: neutral, whose upper half is
/// nearly the ground, so that good elements recede; viridis, cividis, glacier, plasma, magma,
/// inferno; the last three contain red, which inverted elements wear. Diverging, from orange over
/// white to purple, for fields with both signs: puor (ColorBrewer's PuOr).
std::vector<std::string> color_map_names();
/// Colour at t in [0, 1] (clamped). on_dark: on a dark ground, into which neutral then recedes: it
/// goes from bright to dark. Throws UsageError for an unknown name.
Rgb sample_color_map(std::string_view name, double t, bool on_dark = false);

/// White in the middle, a hue of its own on either side. Throws UsageError for an unknown name.
bool is_diverging(std::string_view name);

/// How values are spread over colours: by their differences, or by their ratios; automatic: what
/// shows more of them.
enum class ColorAxis { automatic, linear, logarithmic };

/// Values to colours: range, map, banding.
struct ColorScale {
  std::string map = "viridis";
  double low = 0, high = 1;
  bool reversed = false;  ///< low values get the map's end, high ones its start
  int bands = 0;          ///< 0: continuous
  /// The value that a diverging map has in its middle: each side of it takes half of the map, and
  /// an even number of bands. None: the middle of the range. Other maps take no notice.
  std::optional<double> centre = {};
  /// Equal ratios take equal parts of the map. Only of a positive range; else no notice is taken.
  bool logarithmic = false;
  bool on_dark = false;  ///< see sample_color_map()

  /// Clamped to the range; a NaN is grey. Throws UsageError for an unknown map.
  Rgb color(double value) const;
  /// Its map diverges, and from a centre.
  bool diverges() const;
  /// Where a value lies along a legend: 0 at low, 1 at high, clamped.
  double share(double value) const;
  /// The value at a share of the way: the inverse of share().
  double value_at(double share) const;
  /// Its values are spread by their ratios.
  bool by_ratio() const { return logarithmic && low > 0 && high > low; }
  /// Strips of equal height in which a legend shows it exactly; `fine` where it takes many.
  int strips(int fine) const;
};

/// Colour of the i-th marker: dark and distinguishable, by the colour-blind too; repeats.
Rgb marker_color(Index marker, bool dark_background = false);

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
