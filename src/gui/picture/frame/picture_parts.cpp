#include "gui/picture/frame/picture_parts.h"

#include <algorithm>

#include "core/error.h"
#include "gui/picture/frame/picture_frame.h"

namespace winslow::gui {
namespace {

/// 12345 -> "12 345", with a space that does not break.
std::string grouped(Index number) {
  std::string digits = std::to_string(number);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, "\u00a0");
  return digits;
}

}  // namespace

std::string inverted_text(Index inverted) {
  if (inverted == 0) return {};
  return grouped(inverted) + (inverted == 1 ? " inverted element" : " inverted elements");
}

void check_colors(const std::optional<ElementField>& field, const ColorChoice& choice) {
  if (choice.range && !((*choice.range)[0] < (*choice.range)[1])) {
    throw UsageError("the range of the colours is LOW HIGH with LOW < HIGH");
  }
  if (field) sample_color_map(color_map_for(*field, choice.map), 0);
}

ColorScale picture_colors(const ElementField& field, ColorChoice choice, bool dark,
                          std::span<const double> values) {
  choice.on_dark = dark;
  return color_scale(field, values, choice);
}

void use_scale(ColorChoice& colors, const ColorScale& scale) {
  colors.range = {scale.low, scale.high};
  colors.axis = scale.logarithmic ? ColorAxis::logarithmic : ColorAxis::linear;
}

ColorScale joined(ColorScale a, const ColorScale& b) {
  a.low = std::min(a.low, b.low);
  a.high = std::max(a.high, b.high);
  a.logarithmic = a.logarithmic && b.logarithmic;
  return a;
}

Legend picture_legend(const ElementField& field, std::span<const double> values,
                      const ColorScale& scale, bool with_inverted) {
  Legend legend = legend_of(field, values, scale);
  const Rgba red = MeshStyle{}.inverted_color;
  if (with_inverted) legend.inverted = Rgb{red[0], red[1], red[2]};
  return legend;
}

Rgba edges_on_colors(const ElementField& field, const ColorChoice& choice, bool dark) {
  // On colours, dark lines are legible in both themes, but for the map that recedes into the dark.
  const bool neutral = color_map_for(field, choice.map) == "neutral";
  Rgba edge = picture_theme(dark && neutral).edge;
  edge[3] = 0.55f;
  return edge;
}

}  // namespace winslow::gui
