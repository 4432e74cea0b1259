#pragma once

#include "core/drag/drag_grip.h"
#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow::gui {

/// Finds the boundary under the mouse. Holds a box tree over all marker edges, and the bodies
/// formed by the boundary loops.
class BoundaryIndex {
 public:
  /// A closed loop of the boundary.
  struct Body {
    std::vector<Index> nodes;    ///< see Topology::boundary_loops()
    std::vector<Index> markers;  ///< on this loop, ascending
    bool hole = false;           ///< a body in the flow, not the outer boundary
  };
  struct Hit {
    Index marker = -1;           ///< the nearest one
    std::vector<Index> markers;  ///< of the whole body
    bool hole = false;           ///< a body in the flow, which can be moved freely
    bool inside = false;         ///< hit inside the body, not on its boundary
  };

  explicit BoundaryIndex(std::shared_ptr<const Topology> topology);

  const std::shared_ptr<const Topology>& topology() const { return topology_; }

  /// Sets new positions. The first call determines which loops are holes.
  void update(const Coordinates& coordinates);

  /// The boundary within `radius` of a point, or the body that contains the point.
  std::optional<Hit> pick(const Vec2& point, double radius) const;

  /// A boundary node under the mouse.
  struct NodeHit {
    Index node = -1;
    Index body = -1;           ///< of bodies()
    std::size_t position = 0;  ///< in the body's nodes
  };
  /// The nearest node of a body within `radius` of a point.
  std::optional<NodeHit> pick_node(const Vec2& point, double radius) const;

  const std::vector<Body>& bodies() const { return bodies_; }
  /// The body of a marker; null for a marker inside the mesh.
  const Body* body_of(Index marker) const;
  /// Present position of a node.
  Vec2 position(Index node) const { return coordinates_.xy(node); }
  /// Largest distance of a point from the markers' nodes.
  double reach(const std::vector<Index>& markers, const Vec2& point) const;

 private:
  struct Edge {
    Index a, b, marker;
  };

  void find_bodies();
  const Edge* nearest(const Vec2& point, double radius) const;
  double edge_distance(const Edge& edge, const Vec2& point) const;
  const Body* body_containing(const Vec2& point) const;
  Hit hit_of(Index marker, bool inside) const;

  std::shared_ptr<const Topology> topology_;
  std::vector<Body> bodies_;
  std::vector<Index> marker_body_;  // -1: none
  std::vector<Edge> edges_;
  std::vector<Box<2>> boxes_;  // of edges_
  BoxTree<2> tree_;
  Coordinates coordinates_;
};

/// Names of markers given by number.
std::vector<std::string> marker_names(const Topology& topology, const std::vector<Index>& markers);
/// The markers of these names that the mesh has, ascending.
std::vector<Index> markers_named(const Topology& topology, const std::vector<std::string>& names);

/// A run of nodes along a closed boundary loop, forward from `first` to `last`.
struct BoundaryArc {
  Index body = 0;                   ///< of BoundaryIndex::bodies()
  std::size_t first = 0, last = 0;  ///< positions in the body's nodes

  bool contains(std::size_t position) const;
  bool operator==(const BoundaryArc&) const = default;
};

/// The arc extended to another position of a loop of n nodes, in the shorter direction.
BoundaryArc extended(const BoundaryArc& arc, std::size_t position, std::size_t n);

/// Boundary nodes of a volume mesh that are dragged together, and the markers over which the drag
/// fades.
struct SurfacePatch {
  std::vector<Index> nodes;    ///< ascending
  std::vector<Index> markers;  ///< ascending

  bool contains(Index node) const;
  bool operator==(const SurfacePatch&) const = default;
};

/// Shape editing: pieces of boundary are dragged instead of whole bodies.
struct ShapeEdit {
  bool active = false;
  double radius = 0;                  ///< over which a drag fades, along the boundary
  std::optional<BoundaryArc> arc;     ///< of a plane mesh
  std::optional<SurfacePatch> patch;  ///< of a volume mesh

  bool holds() const { return arc.has_value() || patch.has_value(); }
};

/// The grip for a drag of the arc.
DragGrip grip_of(const BoundaryArc& arc, double radius, const BoundaryIndex& boundary,
                 const Topology& topology, const Coordinates& rest);
/// The grip for a drag of the patch.
DragGrip grip_of(const SurfacePatch& patch, double radius, const Mesh& rest);

}  // namespace winslow::gui
