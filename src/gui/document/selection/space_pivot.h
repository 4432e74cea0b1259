#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mesh/coordinates.h"

namespace winslow::gui {

/// What a pivot in space, and the axis through it, are taken from.
enum class PivotFrom {
  centre,  ///< of the bounding box of what is selected; the axis is any
  typed,   ///< numbers
  node,    ///< the axis is any
  edge,    ///< from one end of an edge, or of a row of them, to the other
  nodes,   ///< from one node to another
  face     ///< its centre and normal
};

/// Nodes from which a pivot is taken: one, the two ends of a line, the corners of a face.
struct PivotSource {
  PivotFrom from = PivotFrom::node;
  std::vector<Index> nodes;

  bool operator==(const PivotSource&) const = default;
};

/// The point about which a selection turns, and the axis through it.
struct SpacePivot {
  PivotFrom from = PivotFrom::centre;
  std::vector<Index> nodes;  ///< of the source, whose pivot goes wherever they go
  Vec3 point{0, 0, 0};
  Vec3 axis{0, 0, 1};  ///< of any length but 0

  bool picked() const { return !nodes.empty(); }
};

/// The pivot that a source has in a mesh; with `axis` where the source has none. None if the nodes
/// are not in the mesh, or lie on one another.
std::optional<SpacePivot> pivot_at(const PivotSource& source, const Coordinates& x,
                                   const Vec3& axis);

/// "node", "edge", ...
const char* pivot_from_name(PivotFrom from);

}  // namespace winslow::gui
