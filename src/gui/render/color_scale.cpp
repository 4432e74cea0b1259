#include "gui/render/color_scale.h"

#include <iterator>

#include "core/error.h"
#include "gui/base/text.h"

namespace winslow::gui {
namespace {

/// Evenly spaced colours of a map (0xRRGGBB). They are published ones, except for our own neutral
/// and glacier, whose light ends leave the lines of a good mesh legible. Smooth interpolation
/// between them stays within a few of 255 of the published tables. A diverging map has an odd
/// number, with one in the middle.
struct Map {
  std::string_view name;
  std::array<std::uint32_t, 11> stops;
  int count = 10;

  bool diverging() const { return count % 2 == 1; }
};

constexpr std::array<Map, 8> maps{{
    {"neutral",
     {0x2E0B5E, 0x4F2488, 0x7446A6, 0x9A70BF, 0xBD9CD4, 0xD8C3E4, 0xE8DDEE, 0xEEE9F2, 0xF1F0F5,
      0xF3F5F8}},
    {"viridis",
     {0x440154, 0x482878, 0x3E4A89, 0x31688E, 0x26828E, 0x1F9E89, 0x35B779, 0x6DCD59, 0xB4DE2C,
      0xFDE725}},
    {"cividis",
     {0x00204D, 0x00336F, 0x39486B, 0x575C6D, 0x707173, 0x8A8779, 0xA69D75, 0xC4B56C, 0xE4CF5B,
      0xFFEA46}},
    {"glacier",
     {0x17193F, 0x1D2F66, 0x22498A, 0x2C68A2, 0x3C87AF, 0x58A5B8, 0x82C0C1, 0xAFD8CE, 0xD6EBDD,
      0xF4FAEF}},
    {"plasma",
     {0x0D0887, 0x47039F, 0x7301A8, 0x9C179E, 0xBD3786, 0xD8576B, 0xED7953, 0xFA9E3B, 0xFDC926,
      0xF0F921}},
    {"magma",
     {0x000004, 0x180F3E, 0x451077, 0x721F81, 0x9F2F7F, 0xCD4071, 0xF1605D, 0xFD9567, 0xFEC98D,
      0xFCFDBF}},
    {"inferno",
     {0x000004, 0x1B0C42, 0x4B0C6B, 0x781C6D, 0xA52C60, 0xCF4446, 0xED6925, 0xFB9A06, 0xF7D03C,
      0xFCFFA4}},
    {"puor",
     {0x7F3B08, 0xB35806, 0xE08214, 0xFDB863, 0xFEE0B6, 0xF7F7F7, 0xD8DAEB, 0xB2ABD2, 0x8073AC,
      0x542788, 0x2D004B},
     11},
}};

/// Neutral on a dark background.
constexpr Map neutral_on_dark{"neutral",
                              {0xF6E3FF, 0xDDBBF2, 0xBF94DC, 0x9C71BE, 0x79559A, 0x5B4576, 0x463B5A,
                               0x39364A, 0x303340, 0x2A303A}};

constexpr float channel(std::uint32_t color, int c) {
  return static_cast<float>((color >> (16 - 8 * c)) & 0xFFU) / 255.0f;
}

constexpr Rgb to_rgb(std::uint32_t color) {
  return {channel(color, 0), channel(color, 1), channel(color, 2)};
}

/// Interpolates with a Catmull-Rom spline through the stops.
Rgb interpolate(const Map& map, double t) {
  const double position = std::clamp(t, 0.0, 1.0) * (map.count - 1);
  const int k = std::min(static_cast<int>(position), map.count - 2);
  const auto u = static_cast<float>(position - k);
  const auto stop = [&](int i, int c) {
    return channel(map.stops[static_cast<std::size_t>(std::clamp(i, 0, map.count - 1))], c);
  };
  Rgb result{};
  for (int c = 0; c < 3; ++c) {
    const float a = stop(k, c);
    const float b = stop(k + 1, c);
    const float slope_a = 0.5f * (b - stop(k - 1, c));
    const float slope_b = 0.5f * (stop(k + 2, c) - a);
    const float bend_a = 3.0f * (b - a) - 2.0f * slope_a - slope_b;
    const float bend_b = 2.0f * (a - b) + slope_a + slope_b;
    const float value = a + u * (slope_a + u * (bend_a + u * bend_b));
    result[static_cast<std::size_t>(c)] = std::clamp(value, 0.0f, 1.0f);
  }
  return result;
}

const Map& find_map(std::string_view name) {
  const auto found = std::ranges::find_if(maps, [&](const Map& m) { return m.name == name; });
  if (found == maps.end()) {
    std::string message = "unknown colour map '" + std::string(name) + "'; known:";
    for (const Map& m : maps) message += " " + std::string(m.name);
    throw UsageError(message);
  }
  return *found;
}

/// Position in a diverging map: each side of the centre has half of the map, however short its
/// range.
double diverging_share(const ColorScale& scale, double centre, double value) {
  const double side = (value < centre ? scale.low : scale.high) - centre;
  const double away = value - centre;
  if (away == 0) return 0.5;
  // On a side without extent, every value lies at its end.
  const double share = side * away > 0 ? std::min(away / side, 1.0) : 1.0;
  return 0.5 + std::copysign(0.5 * share, away);
}

}  // namespace

std::vector<std::string> color_map_names() {
  std::vector<std::string> names;
  for (const Map& map : maps) names.emplace_back(map.name);
  return names;
}

Rgb sample_color_map(std::string_view name, double t, bool on_dark) {
  if (on_dark && name == neutral_on_dark.name) return interpolate(neutral_on_dark, t);
  return interpolate(find_map(name), t);
}

bool is_diverging(std::string_view name) { return find_map(name).diverging(); }

bool ColorScale::diverges() const { return centre && !by_ratio() && is_diverging(map); }

double ColorScale::share(double value) const {
  if (by_ratio())
    return value > low ? std::min(std::log(value / low) / std::log(high / low), 1.0) : 0.0;
  const double span = high - low;
  if (!(span > 0)) return value > low ? 1.0 : 0.0;
  return std::clamp((value - low) / span, 0.0, 1.0);
}

double ColorScale::value_at(double share) const {
  return by_ratio() ? low * std::pow(high / low, share) : low + share * (high - low);
}

Rgb ColorScale::color(double value) const {
  if (std::isnan(value)) return {0.6f, 0.6f, 0.6f};
  double t = share(value);
  int steps = bands;
  if (diverges()) {
    t = diverging_share(*this, *centre, value);
    // With an odd number, the middle band would contain both signs.
    if (steps > 1) steps -= steps % 2;
  }
  if (steps > 1) t = std::min(std::floor(t * steps), steps - 1.0) / (steps - 1.0);
  if (steps == 1) t = 0.5;
  return sample_color_map(map, reversed ? 1.0 - t : t, on_dark);
}

int ColorScale::strips(int fine) const {
  return std::max(bands > 0 && !diverges() ? bands : fine, 1);
}

Rgb marker_color(Index marker, bool dark_background) {
  constexpr std::array<std::uint32_t, 8> on_light{0x0B3C8C, 0xA63A00, 0x00664A, 0x8A2A6B,
                                                  0x5B4B00, 0x2B2B2B, 0x1B6E9C, 0x7A1E1E};
  constexpr std::array<std::uint32_t, 8> on_dark{0x7DB7FF, 0xFFA24D, 0x4FD3A5, 0xE58CC6,
                                                 0xE6D34A, 0xDCDCDC, 0x7FD8F5, 0xFF8F80};
  const auto& palette = dark_background ? on_dark : on_light;
  return to_rgb(palette[static_cast<std::size_t>(std::max<Index>(marker, 0)) % palette.size()]);
}

namespace {

std::vector<double> finite_values(std::span<const double> values) {
  std::vector<double> finite;
  finite.reserve(values.size());
  for (const double v : values) {
    if (std::isfinite(v)) finite.push_back(v);
  }
  return finite;
}

double percentile(std::vector<double>& values, double share) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

/// Sets range and direction of a linear scale for which the user chose no range.
void set_linear(ColorScale& scale, ColorRange range, std::vector<double>& finite) {
  constexpr double robust = 0.995;
  const double high = percentile(finite, robust);
  switch (range) {
    case ColorRange::zero_to_one:
      break;
    case ColorRange::up_to_one:
      scale.low = std::min(0.0, percentile(finite, 1 - robust));
      break;
    case ColorRange::from_zero:
      scale.high = high > 0 ? round_up_nicely(high) : 1;
      scale.reversed = true;
      break;
    case ColorRange::from_one:
      scale.low = 1;
      scale.high = std::max(round_up_nicely(high), 1.5);
      scale.reversed = true;
      break;
    case ColorRange::robust_both_sides:
      scale.low = std::min(0.0, percentile(finite, 1 - robust));
      scale.high = high > scale.low ? round_up_nicely(high) : scale.low + 1;
      break;
    case ColorRange::around_one: {
      constexpr double least = 1.1;  // deviations by rounding must not fill the map
      scale.low = finite.empty() ? 1 / least : std::min(percentile(finite, 1 - robust), 1 / least);
      scale.high = std::max(round_up_nicely(high), least);
      break;
    }
    case ColorRange::counts:
      scale.low = 1;
      scale.high = std::max(percentile(finite, 1), 2.0);
      break;
  }
}

std::vector<double> positive(const std::vector<double>& values) {
  std::vector<double> found;
  std::ranges::copy_if(values, std::back_inserter(found), [](double v) { return v > 0; });
  return found;
}

/// True if a linear scale would show most elements in the colours of one end.
bool wants_ratios(const ElementField& field, std::vector<double>& above_zero) {
  constexpr double flat = 20;
  const ColorRange range = field_info(field).colors;
  // Angles are compared by their differences.
  if (field_info(field).unit == "degrees") return false;
  if (range != ColorRange::from_one && range != ColorRange::robust_both_sides) return false;
  const double low = range == ColorRange::from_one ? 1 : percentile(above_zero, 0.01);
  return low > 0 && percentile(above_zero, 0.99) > flat * low;
}

/// Sets a logarithmic range from the first to the last percentile of the positive values.
void set_by_ratio(ColorScale& scale, ColorRange range, std::vector<double>& above_zero) {
  const double low = range == ColorRange::from_one ? 1 : percentile(above_zero, 0.01);
  const double high = percentile(above_zero, 0.99);
  if (!(high > low)) return;
  scale.low = low;
  scale.high = range == ColorRange::from_one ? round_up_nicely(high) : high;
  scale.logarithmic = true;
}

/// Sets the range that the user chose, if it is valid.
void set_range(ColorScale& scale, const std::array<double, 2>& range) {
  if (!(range[1] > range[0])) return;
  scale.low = range[0];
  scale.high = range[1];
}

}  // namespace

std::vector<std::string> color_map_choices() {
  std::vector<std::string> names = color_map_names();
  names.insert(names.begin(), "automatic");
  return names;
}

std::string color_map_for(const ElementField& field, const std::string& choice) {
  if (choice != "automatic") return choice;
  if (field_info(field).one_is_best) return "puor";
  const bool quality = field.metric()
                           ? metric_info(*field.metric(), field.cell_dimension()).rates()
                           : field != LayerField::layer && field != WallField::first_height;
  return quality ? "neutral" : "viridis";
}

ColorScale color_scale(const ElementField& field, std::span<const double> values,
                       const ColorChoice& choice) {
  const FieldInfo& info = field_info(field);
  ColorScale scale;
  scale.map = color_map_for(field, choice.map);
  scale.bands = choice.bands;
  scale.on_dark = choice.on_dark;
  if (info.has_sign) scale.centre = 0;
  if (info.one_is_best) scale.centre = 1;
  std::vector<double> finite = finite_values(values);
  set_linear(scale, info.colors, finite);
  std::vector<double> above_zero = positive(finite);
  const bool ratios = choice.axis == ColorAxis::automatic
                          ? !above_zero.empty() && wants_ratios(field, above_zero)
                          : choice.axis == ColorAxis::logarithmic;
  if (ratios) set_by_ratio(scale, info.colors, above_zero);
  if (choice.percentiles) {
    std::vector<double>& shown = ratios && !above_zero.empty() ? above_zero : finite;
    set_range(scale, {percentile(shown, (*choice.percentiles)[0] / 100),
                      percentile(shown, (*choice.percentiles)[1] / 100)});
  }
  if (choice.range) set_range(scale, *choice.range);
  scale.logarithmic = ratios && scale.low > 0;
  // Over decades, both ends have structure, and nothing should recede.
  if (choice.map == "automatic" && scale.by_ratio()) scale.map = "viridis";
  return scale;
}

Histogram histogram_over(std::span<const double> values, const ColorScale& scale, int bins) {
  Histogram histogram{scale.low, scale.high, {}};
  histogram.counts.assign(static_cast<std::size_t>(std::max(bins, 1)), 0);
  const auto n = static_cast<double>(histogram.counts.size());
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    const double bin = std::clamp(std::floor(scale.share(v) * n), 0.0, n - 1);
    ++histogram.counts[static_cast<std::size_t>(bin)];
  }
  return histogram;
}

}  // namespace winslow::gui
