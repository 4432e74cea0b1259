#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/types.h"

namespace winslow::gui {

/// What lies at a place of the mesh on screen, as a click there means it.
struct PickedPlace {
  std::optional<Vec2> point;     ///< units of the mesh; none: a row of a list was clicked
  std::vector<Index> markers;    ///< of the body there, ascending; empty: none
  std::optional<Index> node;     ///< near enough to be meant
  std::optional<Index> element;  ///< that contains the point
  /// Of a volume mesh, with the normal of the surface there, towards the viewer.
  std::optional<std::array<Vec3, 2>> in_space = {};
  std::optional<Index> face = {};  ///< of the boundary of a volume mesh, as Topology numbers them
};

}  // namespace winslow::gui
