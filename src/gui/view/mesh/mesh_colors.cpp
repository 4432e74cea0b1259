#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

BackdropColors backdrop_colors(const ViewOptions& view) {
  constexpr Rgba white{1, 1, 1, 1};
  constexpr Rgba night{0.075f, 0.085f, 0.105f, 1};
  constexpr Rgba grey{0.80f, 0.81f, 0.83f, 1};
  constexpr Rgba black{0, 0, 0, 1};
  switch (view.backdrop) {
    case Backdrop::white:
      return {white, white};
    case Backdrop::grey:
      return {grey, grey};
    case Backdrop::gradient:
      if (view.lightness == Lightness::dark)
        return {{0.19f, 0.22f, 0.28f, 1}, {0.04f, 0.05f, 0.07f, 1}};
      return {{0.97f, 0.98f, 1.0f, 1}, {0.74f, 0.79f, 0.87f, 1}};
    case Backdrop::black:
      return {black, black};
    case Backdrop::automatic:
      break;
  }
  return view.lightness == Lightness::dark ? BackdropColors{night, night}
                                           : BackdropColors{white, white};
}

MeshColors mesh_colors(const ViewOptions& view) {
  MeshColors colors;
  colors.dark = backdrop_colors(view).dark();
  const bool colored = view.color && view.fill;
  const bool neutral = colored && color_map_for(*view.color, view.color_map) == "neutral";
  colors.fill = colors.dark ? Rgba{0.15f, 0.17f, 0.205f, 1} : Rgba{0.955f, 0.963f, 0.975f, 1};
  // Dark edges on dark colours would be lost, and black ones would drown the colours.
  if (neutral && colors.dark)
    colors.edge = {0.62f, 0.66f, 0.73f, 0.5f};
  else if (neutral)
    colors.edge = {0.24f, 0.28f, 0.36f, 0.55f};
  else if (colored)
    colors.edge = {0.08f, 0.10f, 0.14f, 0.55f};
  else
    colors.edge = colors.dark ? Rgba{0.62f, 0.66f, 0.73f, 1} : Rgba{0.30f, 0.35f, 0.42f, 1};
  colors.ghost = colored && !neutral ? Rgba{1, 1, 1, 0.75f} : Rgba{0.93f, 0.45f, 0.10f, 0.65f};
  colors.inverted = colors.dark ? Rgba{1.0f, 0.27f, 0.27f, 1} : Rgba{0.90f, 0.10f, 0.12f, 1};
  return colors;
}

Rgb color_of_marker(const ViewOptions& view, const std::string& name, Index marker, bool dark) {
  const MarkerLook look = view.markers.of(name);
  return look.color ? Rgb{(*look.color)[0], (*look.color)[1], (*look.color)[2]}
                    : marker_color(marker, dark);
}

ColorChoice color_choice(const ViewOptions& view) {
  return {view.color_map, view.color_axis, view.percentiles,
          view.range,     view.bands,      backdrop_colors(view).dark()};
}

long long isolated_count(std::span<const double> values, const Isolation& isolation) {
  return std::ranges::count_if(values, [&](double v) { return isolated(v, isolation); });
}

std::vector<float> element_opacity(std::span<const double> values, const Isolation& isolation) {
  if (!isolation.on) return {};
  std::vector<float> opacity;
  opacity.reserve(values.size());
  for (const double v : values)
    opacity.push_back(isolated(v, isolation) ? 1.0f : static_cast<float>(isolation.rest));
  return opacity;
}

Isolation isolation_for(const ElementField& field) {
  Isolation isolation;
  isolation.above = !field_info(field).larger_is_better;
  isolation.threshold = field_info(field).threshold;
  return isolation;
}

}  // namespace winslow::gui
