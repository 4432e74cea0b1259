#pragma once

#include <utility>

#include "core/geometry/curve.h"
#include "core/geometry/element_normals.h"
#include "core/geometry/periodic_pairs.h"
#include "core/geometry/sliding_boundary.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// What sliding nodes stay on: each node has its own line or plane, or geometry shared with other
/// nodes.
class SlidingNodes {
 public:
  /// Lets a node slide on a line (one direction) or a plane (two) through its position.
  void set(Index node, const TangentFrame& frame);
  /// Lets nodes slide on geometry, which gives their directions at x (a point for each node of the
  /// mesh). Returns the directions in which each node may move.
  std::vector<TangentFrame> set(std::span<const Index> nodes,
                                std::shared_ptr<const SlidingGeometry> geometry,
                                const Coordinates& x);
  /// The node no longer slides.
  void erase(Index node);

  /// Null for a node that does not slide.
  const TangentFrame* frame(Index node) const;
  /// Null for a node that slides on no geometry.
  const SlidingGeometry* geometry(Index node) const;

  /// For a surface mesh: the reference normals that identify inverted elements (null: none).
  void set_element_normals(std::shared_ptr<const ElementNormals> normals) {
    element_normals_ = std::move(normals);
  }
  const std::shared_ptr<const ElementNormals>& element_normals() const { return element_normals_; }

  /// Whether the same nodes may move in the same directions on the same geometry.
  bool same_ways(const SlidingNodes& other) const {
    return frames_ == other.frames_ && geometry_ == other.geometry_;
  }

 private:
  std::map<Index, TangentFrame> frames_;
  // #nodes of the mesh; empty as long as no node slides on geometry.
  std::vector<std::shared_ptr<const SlidingGeometry>> geometry_;
  std::shared_ptr<const ElementNormals> element_normals_;
};

/// A node whose position is determined by a node across a periodic boundary.
struct NodeImage {
  Index image, node;
  std::shared_ptr<const RigidImage> transform;  ///< maps the node to the image
  bool operator==(const NodeImage& other) const {
    return image == other.image && node == other.node && *transform == *other.transform;
  }
};

/// Nodes without their own unknowns, whose positions depend on other nodes: images across periodic
/// boundaries, and nodes in rows along curves.
class TiedNodes {
 public:
  /// Throws UsageError if one of the nodes is in a pair already.
  void add(const NodeImage& image);
  /// Removes the pair of a node. Returns the other node of the pair, if there was one.
  std::optional<Index> separate(Index node);
  /// The other node of a node's pair.
  std::optional<Index> partner(Index node) const;
  bool has_image(Index node) const { return image_of_.contains(node); }
  /// Ascending by the image.
  std::vector<NodeImage> images() const;

  void add(std::shared_ptr<const CurveRow> row) { rows_.push_back(std::move(row)); }
  /// In the order in which they were added.
  std::span<const std::shared_ptr<const CurveRow>> rows() const { return rows_; }

  bool operator==(const TiedNodes&) const = default;

 private:
  std::map<Index, NodeImage> images_;  // by the image
  std::map<Index, Index> image_of_;    // by the node
  std::vector<std::shared_ptr<const CurveRow>> rows_;
};

/// How a node may move while a mesh is smoothed.
enum class NodeClass : std::uint8_t {
  fixed,       ///< stays where it is: no unknown
  prescribed,  ///< moved by a motion: no unknown
  image,       ///< moves with its partner across a periodic boundary: no unknown of its own
  follows,     ///< moves along a curve as the ends of its row do: no unknown of its own
  on_curve,    ///< slides along a curve: one unknown
  on_surface,  ///< slides on a surface in space: two
  free         ///< moves freely: as many as the space has dimensions
};

/// The class of every node of a mesh: which nodes have unknowns, how many and in which directions.
/// (Topology::on_boundary() describes the mesh, not what may move.) SlidingNodes has the geometry
/// of sliding nodes, TiedNodes the dependent nodes, NodeUnknowns the numbering of the unknowns.
class NodeClasses {
 public:
  /// The interior nodes are free, all others fixed.
  explicit NodeClasses(std::shared_ptr<const Topology> topology);

  const Topology& topology() const { return *topology_; }
  const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }

  NodeClass operator[](Index node) const { return classes_[static_cast<std::size_t>(node)]; }
  /// True for nodes on curves and surfaces.
  bool slides(Index node) const {
    const NodeClass c = (*this)[node];
    return c == NodeClass::on_curve || c == NodeClass::on_surface;
  }
  /// True for nodes that move while a mesh is smoothed: by their own unknowns or others'.
  bool moves(Index node) const {
    const NodeClass c = (*this)[node];
    return c == NodeClass::image || c == NodeClass::follows || unknowns(node) > 0;
  }
  /// Number of directions in which a node may move: 0 to 3.
  int unknowns(Index node) const;
  /// As many directions as the node has unknowns: for a free node the axes.
  TangentFrame frame(Index node) const;
  /// The position of a node placed at a point, and the directions in which it may move from there.
  /// For a node that slides on geometry this is the foot of the point, otherwise the point itself
  /// with its frame.
  Foot foot(Index node, const Vec3& point) const;

  // Each throws UsageError for a node that the mesh does not have.

  /// For a node of a periodic pair, fixes both nodes.
  void set_fixed(std::span<const Index> nodes) { set(nodes, NodeClass::fixed); }
  void set_prescribed(std::span<const Index> nodes) { set(nodes, NodeClass::prescribed); }
  /// Throws UsageError for a node that no element uses: no equation determines its position.
  void set_free(std::span<const Index> nodes);
  /// tangent: of any length but zero; in the plane its third component must be zero.
  void set_on_curve(Index node, const Vec3& tangent);
  /// normal: of any length but zero. Throws UsageError in the plane.
  void set_on_surface(Index node, const Vec3& normal);
  /// Lets nodes slide on geometry, which gives their directions at x.
  void set_sliding(std::span<const Index> nodes, std::shared_ptr<const SlidingGeometry> geometry,
                   const Coordinates& x);

  /// Couples pairs of nodes: those of the first side become free, those of the second their images.
  /// The same holds at corners where the first node slides. Throws UsageError for nodes that are in
  /// a pair already.
  void set_periodic(const PeriodicPairs& pairs);
  /// Lets the nodes between the ends of a row follow, where possible; at least one end must move.
  void set_following(std::shared_ptr<const CurveRow> row);
  /// For a surface mesh: see SlidingNodes::set_element_normals().
  void set_element_normals(std::shared_ptr<const ElementNormals> normals) {
    sliding_.set_element_normals(std::move(normals));
  }

  /// What nodes slide on.
  const SlidingNodes& sliding() const { return sliding_; }
  /// Nodes that depend on others.
  const TiedNodes& tied() const { return tied_; }

  /// Whether the same nodes may move in the same directions. Fixed and prescribed nodes count as
  /// the same.
  bool same_unknowns(const NodeClasses& other) const;

 private:
  void require(Index node) const;
  void set(std::span<const Index> nodes, NodeClass value);
  void set_one(Index node, NodeClass value);

  std::shared_ptr<const Topology> topology_;
  std::vector<NodeClass> classes_;
  SlidingNodes sliding_;
  TiedNodes tied_;
};

}  // namespace winslow
