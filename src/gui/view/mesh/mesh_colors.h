#pragma once

#include <string>

#include "gui/render/backdrop.h"
#include "gui/render/color_map.h"
#include "gui/render/metric_scale.h"
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

}  // namespace winslow::gui
