#pragma once

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// Whether a box of the plane shows any of a plane mesh: its boundary runs through the box, or the
/// box lies inside the mesh.
bool anything_in_view(const Topology& topology, const Coordinates& coordinates, const Bounds& box);

}  // namespace winslow::gui
