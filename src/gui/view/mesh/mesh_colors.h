#pragma once

#include "core/inspect/element_field.h"
#include "gui/render/color_scale.h"
#include "gui/render/mesh_renderer.h"
#include "gui/settings/view_options.h"

/// Colours of the mesh and of what lies behind it.
namespace winslow::gui {

BackdropColors backdrop_colors(const ViewOptions& view);

struct MeshColors {
  bool dark = false;  ///< of the backdrop
  Rgba fill;          ///< of elements without colours of their own
  Rgba edge;
  Rgba ghost;  ///< edges of the state before
  Rgba inverted;
};
MeshColors mesh_colors(const ViewOptions& view);

/// Of a marker: what the user has chosen, or else by its number. dark: what it is seen on.
Rgb color_of_marker(const ViewOptions& view, const std::string& name, Index marker, bool dark);
/// Of the colours of elements.
ColorChoice color_choice(const ViewOptions& view);

/// Which elements stay when some are isolated by their values of a metric.

inline bool isolated(double value, const Isolation& isolation) {
  return isolation.above ? value > isolation.threshold : value < isolation.threshold;
}
long long isolated_count(std::span<const double> values, const Isolation& isolation);
/// Per element: 1 if it stays, else the opacity of the others; empty if nothing is isolated.
std::vector<float> element_opacity(std::span<const double> values, const Isolation& isolation);
/// Off, with the threshold and the side that single out bad elements by a field.
Isolation isolation_for(const ElementField& field);

}  // namespace winslow::gui
