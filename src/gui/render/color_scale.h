#pragma once

#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "core/types.h"

namespace winslow::gui {

/// Colour in [0, 1], as sent to the screen (sRGB values).
using Rgb = std::array<float, 3>;

/// Names of the maps, all of them legible for the colour-blind. From dark to bright: neutral, whose
/// upper half is close to the background, so that good elements recede; viridis, cividis, glacier,
/// plasma, magma, inferno; the last three contain red, the colour of inverted elements. Diverging,
/// from orange over white to purple, for fields with both signs: puor (ColorBrewer's PuOr).
std::vector<std::string> color_map_names();
/// Colour at t in [0, 1] (clamped). on_dark: the background is dark; neutral then goes from bright
/// to dark and recedes into it. Throws UsageError for an unknown name.
Rgb sample_color_map(std::string_view name, double t, bool on_dark = false);

/// True for a map with white in the middle and a hue of its own on either side. Throws UsageError
/// for an unknown name.
bool is_diverging(std::string_view name);

/// How values are mapped to colours: by their differences or by their ratios; automatic: whichever
/// distinguishes more values.
enum class ColorAxis { automatic, linear, logarithmic };

/// Maps values to colours: range, map, bands.
struct ColorScale {
  std::string map = "viridis";
  double low = 0, high = 1;
  bool reversed = false;  ///< low values have the colours of the map's end
  int bands = 0;          ///< 0: continuous
  /// The value in the middle of a diverging map: each side of it has half of the map, and the
  /// number of bands is even. None: the middle of the range. Other maps ignore it.
  std::optional<double> centre = {};
  /// Equal ratios have equal parts of the map. Ignored unless the range is positive.
  bool logarithmic = false;
  bool on_dark = false;  ///< see sample_color_map()

  /// Clamped to the range; a NaN is grey. Throws UsageError for an unknown map.
  Rgb color(double value) const;
  /// True if the map diverges and has a centre.
  bool diverges() const;
  /// Position of a value along a legend: 0 at low, 1 at high, clamped.
  double share(double value) const;
  /// The value at a share of the way: the inverse of share().
  double value_at(double share) const;
  /// True if values are mapped by their ratios.
  bool by_ratio() const { return logarithmic && low > 0 && high > low; }
  /// Number of strips of equal height in which a legend shows the scale: its bands if they are
  /// exact, else `fine`.
  int strips(int fine) const;
};

/// Colour of the i-th marker: dark and distinguishable, by the colour-blind too; repeats.
Rgb marker_color(Index marker, bool dark_background = false);

/// The user's settings for the colours of values.
struct ColorChoice {
  std::string map = "automatic";  ///< or one of color_map_names()
  ColorAxis axis = ColorAxis::automatic;
  /// Range from the one percentile of the values to the other, in percent; none: automatic.
  std::optional<std::array<double, 2>> percentiles = {};
  std::optional<std::array<double, 2>> range = {};  ///< by its ends; overrides percentiles
  int bands = 0;                                    ///< 0: continuous
  bool on_dark = false;                             ///< the background is dark

  bool operator==(const ColorChoice&) const = default;
};

/// "automatic" and color_map_names().
std::vector<std::string> color_map_choices();
/// The map that "automatic" stands for on a linear scale: neutral for fields that rate elements,
/// viridis for others (area, layer), puor for fields whose best value 1 lies between two bad ends.
/// Logarithmic scales have viridis. Other names stay.
std::string color_map_for(const ElementField& field, const std::string& choice);

/// The scale in which a metric is shown: bad elements stand out, good ones do not. Ranges, if the
/// user chose none: Normalized Jacobian: 0 to 1. Aspect ratio, condition number and kappa: from 1
/// to a round number above all but the worst half percent (at least 1.5), so that a single sliver
/// does not wash out the rest. Area: to the same percentile. Residual: from 0 to that percentile.
/// Smallest weight: to 1, from 0 or the worst half percent if that is less. Values that are not
/// finite are left out. Fields with a sign (sine, area, smallest weight) have the middle of a
/// diverging map at zero: negative values are orange. Ratios with the best value 1 have it at 1. If
/// that would show a mesh in one colour, as in boundary layers for aspect ratio, condition number
/// and area, the scale is logarithmic, from the first to the last percentile. A logarithmic scale
/// on request leaves out values that are not positive; if none is positive, the scale is linear.
ColorScale color_scale(const ElementField& field, std::span<const double> values,
                       const ColorChoice& choice);

/// Counts values in equal bins over the scale's range. Values beyond it count in the last bin on
/// their side; values that are not finite are left out.
Histogram histogram_over(std::span<const double> values, const ColorScale& scale, int bins);

}  // namespace winslow::gui
