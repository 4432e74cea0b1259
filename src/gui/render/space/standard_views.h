#pragma once

#include <string>
#include <vector>

#include "core/inspect/space/plane.h"
#include "gui/render/space/space_camera.h"
#include "gui/render/space/volume_scene.h"

/// Directions to look from, and cuts to begin with.
namespace winslow::gui {

/// "iso", "+x", "-x", ...: names of directions to look from.
const std::vector<std::string>& view_names();
/// Throws UsageError listing the names.
ViewDirection named_view(const std::string& name, int up = 2);

/// Where one looks from unless told: onto a cut from its front, or three quarters from ahead.
ViewDirection automatic_view(const std::vector<Plane>& cuts, int up = 2);
/// The cut that one sees unless told: through the middle of the bodies, at right angles to
/// the axis that points to the viewer most. None where nothing encloses bodies.
std::vector<Plane> automatic_cuts(const Mesh& mesh, const VolumeBoundary& boundary,
                                  const ViewDirection& view);

}  // namespace winslow::gui
