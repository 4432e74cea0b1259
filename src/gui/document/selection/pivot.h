#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh.h"
#include "core/motion/rigid_motion.h"

namespace winslow::gui {

/// Points of a selection about which it is often turned.
enum class PivotPlace { centre, centroid, leading_edge, trailing_edge };

struct BodyAnchors {
  Vec2 centre{0, 0};         ///< of the bounding box
  Vec2 centroid{0, 0};       ///< of the enclosed area; of the nodes where none is enclosed
  Vec2 trailing_edge{0, 0};  ///< the sharper end of the chord
  Vec2 leading_edge{0, 0};   ///< the other end

  const Vec2& point(PivotPlace place) const;
};

/// loops: closed boundary loops of the selection, nodes in order. nodes: of the selection that are
/// on no closed loop. At least one node in all. The chord joins the two nodes farthest apart.
BodyAnchors find_anchors(const std::vector<std::vector<Index>>& loops,
                         const std::vector<Index>& nodes, const Coordinates& x);

/// "leading edge" ...
const char* pivot_place_name(PivotPlace place);

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

/// A motion of a mesh of the plane, which has no axis, or of one in space.
RigidMotion motion_of(bool in_plane, double rotate, const Vec3& translate, const Vec3& pivot,
                      const Vec3& axis);

}  // namespace winslow::gui
