#pragma once

#include "core/mesh/coordinates.h"

namespace winslow {

/// Where a node is, in space: a node of a plane mesh lies in the plane z = 0.
inline Vec3 place_of(const Coordinates& x, Index node) {
  if (x.dimension() == 3) return x.xyz(node);
  const Vec2 p = x.xy(node);
  return {p.x(), p.y(), 0};
}

}  // namespace winslow
