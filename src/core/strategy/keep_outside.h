#pragma once

#include <optional>

#include "core/mesh/local_frame.h"
#include "core/options/option.h"
#include "core/problem/node_classes.h"

namespace winslow {

/// A circle, a box, or both, outside which nothing moves but the boundary that a motion takes.
/// Places are those of the mesh that a command is given, before anything moves.
struct KeepOutside {
  /// Of the circle, in units of the mesh. None: no circle.
  std::optional<double> radius = std::nullopt;
  /// Of the circle. None: the centre of the bounding box of all that moves.
  std::optional<Vec2> centre = std::nullopt;
  /// Opposite corners of the box, in any order. Both or none.
  std::optional<Vec2> corner = std::nullopt;
  std::optional<Vec2> opposite = std::nullopt;

  bool given() const { return radius || corner || opposite; }
  bool operator==(const KeepOutside&) const = default;
};

OptionTable option_table(KeepOutside& keep);

/// Throws UsageError for a box with one corner, or a centre without a radius.
void validate(const KeepOutside& keep);

/// The same region, of a mesh in that frame.
KeepOutside to_local(KeepOutside keep, const LocalFrame& frame);

/// Fixes the free nodes outside the region (with circle and box: outside either).
/// x: the mesh that the region is about. moving: nodes of a motion.
/// Throws UsageError for a circle without centre where nothing moves, where nodes of the motion lie
/// outside, and where no free node lies inside.
void keep_outside(const KeepOutside& keep, const Coordinates& x, std::span<const Index> moving,
                  NodeClasses& classes);

}  // namespace winslow
