#pragma once

#include <vector>

#include "core/index.h"

namespace winslow {

/// What counts as a feature of a boundary, and which of its nodes slide.
struct FeatureRules {
  double angle = 40;             ///< degrees by which a boundary turns at a corner or an edge
  bool slide_along = false;      ///< in space nodes slide along feature lines, too
  std::vector<Index> hold = {};  ///< nodes that stay, whatever was found of them
  /// Nodes at which the boundary counts as smooth, however much it turns: they slide on the curve
  /// or the surface through them.
  std::vector<Index> smooth = {};

  bool operator==(const FeatureRules&) const = default;
};

}  // namespace winslow
