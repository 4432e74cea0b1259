#pragma once

#include <optional>

#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/mesh/volume_view.h"

namespace winslow::gui {

/// The place of a border line of a surface mesh that is seen nearest to a place of the screen, no
/// more than `reach` pixels away. None where it is hidden, by its marker's eye or by the surface,
/// and for other meshes.
std::optional<SeenPlace> seen_border(const ScreenPoint& at, double reach, const VolumeView& picture,
                                     const SpaceView& view, const MarkerLooks& looks);

}  // namespace winslow::gui
