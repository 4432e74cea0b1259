#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/quality/quality.h"

namespace winslow {

/// First heights of one mesh over those of another.
struct FirstHeightChange {
  /// A height has changed if it differs by more than this share of what it was.
  static constexpr double tolerance = 0.05;

  Quantiles ratio;  ///< after / before, of the nodes that have both; count 0: there are none
  double off = 0;   ///< share of these nodes whose height has changed
  /// The node whose height has changed by the largest factor; -1: there is none.
  Index worst_node = -1;
  double worst_ratio = 1;
};

/// Empty where the walls are not of the same nodes: another mesh, or layers in between.
std::optional<FirstHeightChange> compare_first_heights(std::span<const WallMeasures> before,
                                                       std::span<const WallMeasures> after);

/// Whether the walls' cells are not what they were: at more than 5 % of the nodes the height has
/// changed, or at any of them by more than 20 %.
bool spoils_walls(const FirstHeightChange& change);

/// What a motion or a smoothing run has spoilt, for a flow solver.
struct Damage {
  /// With the figures and the worst places, as the beginning of a sentence without its full stop;
  /// empty: nothing is spoilt.
  std::string text;
  std::optional<Index> node;     ///< of a wall, whose first height has changed most
  std::optional<Index> element;  ///< with the smallest sine, if that has fallen
};

/// First heights (as above), and a smallest sine that is less than half of what it was. Of a mesh
/// that has or had inverted elements nothing is said, nor of meshes of different connectivity.
Damage find_damage(const Mesh& before, const Mesh& after);

}  // namespace winslow
