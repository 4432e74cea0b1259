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

/// Colour of a marker: the user's choice, else by its number. dark: the background is dark.
Rgb color_of_marker(const ViewOptions& view, const std::string& name, Index marker, bool dark);
/// The view's settings for the colours of elements.
ColorChoice color_choice(const ViewOptions& view);

/// Isolation of elements by their values of a metric.

inline bool isolated(double value, const Isolation& isolation) {
  return isolation.above ? value > isolation.threshold : value < isolation.threshold;
}
long long isolated_count(std::span<const double> values, const Isolation& isolation);
/// Opacity per element: 1 if isolated, else that of the others; empty if nothing is isolated.
std::vector<float> element_opacity(std::span<const double> values, const Isolation& isolation);
/// Isolation that is off, preset to the threshold and side that single out bad elements by a field.
Isolation isolation_for(const ElementField& field);

}  // namespace winslow::gui
