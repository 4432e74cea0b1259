#pragma once

#include <vector>

#include "core/layers/layer_stack.h"
#include "core/layers/layer_wall.h"
#include "core/mesh/mesh.h"

namespace winslow::gui {

/// More layers than any wall has: all that there are.
inline constexpr int every_layer = 1000;

/// Quadrilaterals stand on one of the walls.
bool may_have_layers(const Topology& topology, const std::vector<LayerWall>& walls);
/// The most layers that a column of the stack on the wall has.
int layer_count(const LayerStack& stack, const Topology& topology, const LayerWall& wall);

}  // namespace winslow::gui
