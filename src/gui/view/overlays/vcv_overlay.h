#pragma once

#include <imgui.h>

#include "core/inspect/nodal_view.h"
#include "core/mesh/mesh.h"
#include "gui/render/color_scale.h"
#include "gui/render/space/space_view.h"
#include "gui/render/view.h"

namespace winslow::gui {

/// Draws VCVs over the mesh at their nodes, as in figure 1 of AIAA 2009-1362: each scaled to the
/// mean size of its star and turned to lie over it. unit: width of a hair line, pixels; font: of
/// the node numbers, which are left out where there is no room.
void draw_vcvs(ImDrawList& list, const View& view, std::span<const NodalView> nodes, float unit,
               ImFont* font);

/// Draws the VCV of one node of a surface mesh, in its tangent plane.
void draw_vcv(ImDrawList& list, const View& view, const NodalView& node, const StarPlane& plane,
              float unit, ImFont* font);

/// Draws a ring around a node.
void draw_node_ring(ImDrawList& list, const ImVec2& at, float radius, float width, ImU32 ink);

/// Colours of VCVs over a mesh, on screen and on paper: seen on plain meshes, on every colour map
/// and in both themes.
struct VcvColors {
  Rgb fill{234 / 255.0f, 88 / 255.0f, 12 / 255.0f};
  Rgb line{194 / 255.0f, 65 / 255.0f, 12 / 255.0f};
  Rgb casing{1, 1, 1};                                   ///< beneath lines
  Rgb negative{201 / 255.0f, 34 / 255.0f, 43 / 255.0f};  ///< edges of negative weight
  float fill_alpha = 84 / 255.0f, casing_alpha = 200 / 255.0f, label_alpha = 235 / 255.0f;
};

/// Ends of a VCV's edges in the physical plane, scaled to the mean size of its star and turned to
/// lie over it.
std::vector<Vec2> vcv_over_star(const NodalView& node);

/// True if part of a VCV may lie in a box of the plane.
bool vcv_in_sight(const NodalView& node, const Bounds& seen);

/// Draws the VCV of a node of a volume mesh at that node, scaled to the mean size of its star and
/// turned to lie over it. The VCV lies above everything, since the mesh hides its own interior.
/// unit: width of a hair line, pixels; font: of the node's number, which is left out where there is
/// no room.
void draw_sphere_vcv(ImDrawList& list, const SpaceCamera& camera, const VolumeNodalView& node,
                     float unit, ImFont* font);

/// Positions in the mesh of the points of a VCV drawn so.
std::vector<Vec3> sphere_over_star(const VolumeNodalView& node);

}  // namespace winslow::gui
