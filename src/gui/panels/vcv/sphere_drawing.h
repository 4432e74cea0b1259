#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "gui/render/color_scale.h"
#include "gui/render/space/space_view.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// What is drawn of a star of tetrahedra, or of a VCV, in a rectangle of a panel.
struct SphereDrawing {
  std::string_view title;  ///< in the corner
  std::string_view id;     ///< of what scripts find: "ID/end/k", "ID/angle/t", "ID/weight/k"
  const SphereLink& link;
  const SphereStar& star;
  const ColorScale& colors;                ///< of the solid angles
  std::span<const double> weights;         ///< of the edges; empty: none are shown
  const VolumeNodalView* image = nullptr;  ///< the nodal Jacobian's, if it is shown
  std::optional<std::size_t> lit;          ///< a neighbour that is lit up
  std::optional<std::size_t> lit_face;     ///< a triangle that is
};

/// The solid with the triangles of its link coloured by their solid angles and shaded by how they
/// face the viewer; what lies behind shines through faintly. Numbers stand where they are legible:
/// a solid angle in a triangle that has room for it, weights beside their points, negative ones
/// first; the rest is left to the tables. camera: with the rectangle for its viewport.
void draw_sphere(ImDrawList& list, const Theme& theme, const SpaceCamera& camera,
                 const SphereDrawing& drawing);

/// A strip with the colours and both ends of the scale, across the row.
void draw_angle_legend(const Theme& theme, const ColorScale& colors);

/// Points that lie before the solid, the others have none of the mouse.
std::vector<bool> points_in_front(const SpaceCamera& camera, const SphereLink& link,
                                  const SphereStar& star);

}  // namespace winslow::gui
