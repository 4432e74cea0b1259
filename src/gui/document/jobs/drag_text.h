#pragma once

#include <string>

#include "gui/document/jobs/body_drag.h"

/// What is said of a drag while it goes on.
namespace winslow::gui {

/// "Blocked by "main"", where the mesh can follow no further.
std::string blocked_text(const BodyDrag& drag);
/// "Updating mesh... 35 %": how far the mesh on screen has come of what the mouse asks for.
std::string updating_text(const BodyDrag& drag);

}  // namespace winslow::gui
