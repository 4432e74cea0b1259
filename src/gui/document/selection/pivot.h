#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/mesh.h"
#include "core/motion/rigid_motion.h"

namespace winslow::gui {

/// Named points of a selection, common pivots of rotations.
enum class PivotPlace { centre, centroid, leading_edge, trailing_edge };

struct BodyAnchors {
  Vec2 centre{0, 0};         ///< of the bounding box
  Vec2 centroid{0, 0};       ///< of the enclosed area; if there is none, of the nodes
  Vec2 trailing_edge{0, 0};  ///< the sharper end of the chord
  Vec2 leading_edge{0, 0};   ///< the other end

  const Vec2& point(PivotPlace place) const;
};

/// loops: closed boundary loops of the selection, nodes in order. nodes: nodes of the selection on
/// no closed loop. At least one node in total. The chord joins the two nodes farthest apart.
BodyAnchors find_anchors(const std::vector<std::vector<Index>>& loops,
                         const std::vector<Index>& nodes, const Coordinates& x);

/// "leading edge" ...
const char* pivot_place_name(PivotPlace place);

/// The source of a pivot in space and of the axis through it.
enum class PivotFrom {
  centre,  ///< of the selection's bounding box; any axis
  typed,   ///< typed numbers
  node,    ///< the axis is any
  edge,    ///< from one end of an edge, or chain of edges, to the other
  nodes,   ///< from the first node to the second
  face     ///< centre and normal of the face
};

/// Nodes that define a pivot: one node, the two ends of a line, or the corners of a face.
struct PivotSource {
  PivotFrom from = PivotFrom::node;
  std::vector<Index> nodes;

  bool operator==(const PivotSource&) const = default;
};

/// The point about which a selection rotates, and the axis through it.
struct SpacePivot {
  PivotFrom from = PivotFrom::centre;
  std::vector<Index> nodes;  ///< of the source; the pivot moves with them
  Vec3 point{0, 0, 0};
  Vec3 axis{0, 0, 1};  ///< of any length but 0

  bool picked() const { return !nodes.empty(); }
};

/// The pivot that a source defines in a mesh; `axis` is used if the source defines none. None if
/// the nodes are not in the mesh or coincide.
std::optional<SpacePivot> pivot_at(const PivotSource& source, const Coordinates& x,
                                   const Vec3& axis);

/// A motion of a plane mesh, which ignores `axis`, or of a mesh in space.
RigidMotion motion_of(bool in_plane, double rotate, const Vec3& translate, const Vec3& pivot,
                      const Vec3& axis);

}  // namespace winslow::gui
