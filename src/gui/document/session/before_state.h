#pragma once

#include <cstddef>

#include "gui/document/session/live_mesh.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// Position in the history of the state with which the mesh on screen is compared. Needs a mesh.
std::size_t position_before(const LiveMesh& mesh, BeforeState which);

}  // namespace winslow::gui
