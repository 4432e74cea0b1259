#pragma once

#include <vector>

#include "core/inspect/nodal_view.h"
#include "core/mesh/mesh.h"
#include "gui/render/color_map.h"

namespace winslow::gui {

/// Colours of VCVs over a mesh, on screen and on paper: seen on plain meshes, on every colour map
/// and in both themes.
struct VcvColors {
  Rgb fill{234 / 255.0f, 88 / 255.0f, 12 / 255.0f};
  Rgb line{194 / 255.0f, 65 / 255.0f, 12 / 255.0f};
  Rgb casing{1, 1, 1};                                   ///< beneath lines
  Rgb negative{201 / 255.0f, 34 / 255.0f, 43 / 255.0f};  ///< edges of negative weight
  float fill_alpha = 84 / 255.0f, casing_alpha = 200 / 255.0f, label_alpha = 235 / 255.0f;
};

/// Ends of a VCV's edges in the physical plane: as large as its star on average, turned to lie over
/// it.
std::vector<Vec2> vcv_over_star(const NodalView& node);

/// Some of it may lie in a part of the plane.
bool vcv_in_sight(const NodalView& node, const Bounds& seen);

}  // namespace winslow::gui
