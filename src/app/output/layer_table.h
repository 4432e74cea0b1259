#pragma once

#include <iosfwd>

#include "core/layers/layer_stack.h"

namespace winslow::app {

/// Heights, error and tilt of the layers in a mesh, and the columns that were cut most: at most
/// `limit` of them, thinnest for what was asked first. x: #nodes by 2.
void print_layers(std::ostream& out, const LayerStack& stack, const Coordinates& x, int limit);

}  // namespace winslow::app
