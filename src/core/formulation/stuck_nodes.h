#pragma once

#include <span>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/problem/node_unknowns.h"

/// Places at which what nodes slide on jumps or folds. The energy has no derivative there, and no
/// step of Newton's method leads a node over them.
namespace winslow {

/// Adds to `stuck` (#nodes with unknowns) the nodes that slide and that `step` times the direction
/// (`stride` numbers for each node, those of its unknowns first) leads over such a place, from x to
/// `there`: its feet are farther apart than the way, or the surface turns between them at once, and
/// not little by little as where it is only curved. Returns how many.
Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck);

}  // namespace winslow
