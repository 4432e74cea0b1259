#pragma once

#include <span>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/problem/node_unknowns.h"

/// Places at which what nodes slide on jumps or folds. The energy has no derivative there, and no
/// step of Newton's method leads a node over them.
namespace winslow {

/// Whether a short way (its length in the tangent plane, units of the mesh) of the node of a row,
/// which slides, leads from one foot to another over such a place.
bool leads_astray(const NodeUnknowns& nodes, Index row, const Foot& from, const Foot& to,
                  double way);

/// Adds to `stuck` (#rows) the nodes that slide and that `step` times the direction (`stride`
/// numbers for each row, those of its unknowns first) leads over such a place, from x to `there`.
/// Returns how many.
Index add_nodes_led_astray(const NodeUnknowns& nodes, const Coordinates& x,
                           const Coordinates& there, std::span<const double> direction,
                           std::size_t stride, double step, std::vector<bool>& stuck);

}  // namespace winslow
