#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "gui/render/color_scale.h"
#include "gui/render/space/space_view.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Data for the drawing of a star of tetrahedra, or of a VCV, in a rectangle of a panel.
struct SphereDrawing {
  std::string_view title;  ///< in the corner
  std::string_view id;     ///< prefix of script ids: "ID/end/k", "ID/angle/t", "ID/weight/k"
  const SphereLink& link;
  const SphereStar& star;
  const ColorScale& colors;                ///< of the solid angles
  std::span<const double> weights;         ///< of the edges; empty: not shown
  const VolumeNodalView* image = nullptr;  ///< image of the nodal Jacobian; null: not shown
  std::optional<std::size_t> lit;          ///< a highlighted neighbour
  std::optional<std::size_t> lit_face;     ///< a highlighted triangle
};

/// Draws the solid: the triangles of its link are coloured by their solid angles and shaded by
/// their orientation; the rear side shows through faintly. Draws the numbers that fit: solid angles
/// in triangles, weights beside their points, negative ones first; the tables contain all numbers.
/// camera: its viewport is the rectangle.
void draw_sphere(ImDrawList& list, const Theme& theme, const SpaceCamera& camera,
                 const SphereDrawing& drawing);

/// Draws a strip with the colours and both ends of the scale, across the row.
void draw_angle_legend(const Theme& theme, const ColorScale& colors);

/// True for points in front of the solid; only these react to the mouse.
std::vector<bool> points_in_front(const SpaceCamera& camera, const SphereLink& link,
                                  const SphereStar& star);

}  // namespace winslow::gui
