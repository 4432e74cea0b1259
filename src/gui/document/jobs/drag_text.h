#pragma once

#include <string>

#include "gui/document/jobs/body_drag.h"

/// What is said of a drag while it goes on.
namespace winslow::gui {

/// What is in a body's way: "Blocked by "main"".
std::string blocked_text(const EdgePair& contact);
/// The same of a drag, where the mesh can follow no further.
std::string blocked_text(const BodyDrag& drag);
/// "Updating mesh... 35 %": how far the mesh on screen has come of what the mouse asks for.
std::string updating_text(const BodyDrag& drag);

}  // namespace winslow::gui
