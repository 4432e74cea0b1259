#pragma once

#include <vector>

#include "core/command/command.h"
#include "gui/document/jobs/wall_layers.h"
#include "gui/document/session/session.h"

/// What is known of the layers that walls have.
namespace winslow::gui {

/// The layers of all these walls are held.
bool all_held(const Session& session, const std::vector<LayerWall>& walls);
/// Sets how many layers of each wall a command works on: those that are known to be there. Of
/// a wall without known ones: all that are found, to hold them; to space them anew, what the
/// wall's spacing says.
void limit_to_present_layers(const Session& session, LayersCommand& command);

}  // namespace winslow::gui
