#pragma once

#include "core/mesh/coordinates.h"
#include "core/problem/node_unknowns.h"

/// Finds nodes that stop at jumps and folds of what they slide on. The energy has no derivative
/// there, and no step of Newton's method takes a node across.
namespace winslow {

/// Adds to `stuck` (#nodes with unknowns) the sliding nodes that a step takes across a jump or a
/// fold; returns how many. At a jump the feet of x and `there` are farther apart than the step is
/// long. At a fold the surface turns between them all at once, not gradually as a curved one does.
///
/// The step is `step` times the direction, from x to `there`. stride: numbers per node in the
/// direction, those of its unknowns first.
Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck);

}  // namespace winslow
