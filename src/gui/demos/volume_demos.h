#pragma once

#include <vector>

#include "gui/demos/demo.h"

namespace winslow::gui {

/// Those on volume meshes.
std::vector<Demo> volume_demos();

}  // namespace winslow::gui
