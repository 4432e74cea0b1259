#pragma once

#include "core/mesh/coordinates.h"

namespace winslow::test {

/// A component of a node's position, in any dimension.
inline double& coordinate(Coordinates& x, Index node, Index k) {
  return x.values()[at(node) * at(x.dimension()) + at(k)];
}
inline double coordinate(const Coordinates& x, Index node, Index k) {
  return x.values()[at(node) * at(x.dimension()) + at(k)];
}

}  // namespace winslow::test
