#pragma once

#include "core/mesh/mesh.h"

namespace winslow::app {

/// Mean of an element's corners, in units of the mesh: tells a user where to look.
inline Vec2 element_centre(const Mesh& mesh, Index element) {
  Vec2 sum(0, 0);
  const auto corners = mesh.topology->element(element);
  for (const Index node : corners) sum += mesh.coordinates.xy(node);
  return sum / static_cast<double>(corners.size());
}

}  // namespace winslow::app
