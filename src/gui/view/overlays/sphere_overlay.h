#pragma once

#include <imgui.h>

#include "core/inspect/space/volume_nodal_view.h"
#include "gui/render/space/space_camera.h"

namespace winslow::gui {

/// The VCV of a node of a volume mesh, drawn over the mesh at its node: as large as its star on
/// average, turned to lie over it; above all that would hide it, as the middle of a volume mesh is.
/// unit: width of a hair line, pixels; font: of the node's number, which is left out where there is
/// no room.
void draw_sphere_vcv(ImDrawList& list, const SpaceCamera& camera, const VolumeNodalView& node,
                     float unit, ImFont* font);

/// Where the points of the VCV lie then.
std::vector<Vec3> sphere_over_star(const VolumeNodalView& node);

}  // namespace winslow::gui
