#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/layers/layer_spacing.h"
#include "core/types.h"

namespace winslow {

/// A box, in units of the mesh. The default holds everything.
struct WallPart {
  double xmin = -std::numeric_limits<double>::infinity();
  double xmax = std::numeric_limits<double>::infinity();
  double ymin = -std::numeric_limits<double>::infinity();
  double ymax = std::numeric_limits<double>::infinity();

  bool holds(const Vec2& p) const {
    return p.x() >= xmin && p.x() <= xmax && p.y() >= ymin && p.y() <= ymax;
  }
  bool operator==(const WallPart&) const = default;
};

/// A wall and the layers that it is to have.
struct LayerWall {
  std::vector<std::string> markers;
  LayerSpacing spacing;
  WallPart part = {};  ///< only edges of the markers with both ends in this box

  bool operator==(const LayerWall&) const = default;
};

}  // namespace winslow
