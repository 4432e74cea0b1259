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

/// What the nodes of a mesh that slide stay on: each a line or a plane of its own, or geometry that
/// it shares with others.
class SlidingNodes {
 public:
  /// A line (one direction) or a plane (two) through wherever the node is.
  void set(Index node, const TangentFrame& frame);
  /// Geometry, which says what it is at the places in x (a point for each node of the mesh).
  /// Returns the directions in which each node may move.
  std::vector<TangentFrame> set(std::span<const Index> nodes,
                                std::shared_ptr<const SlidingGeometry> geometry,
                                const Coordinates& x);
  /// The node no longer slides.
  void erase(Index node);

  /// Null for a node that does not slide.
  const TangentFrame* frame(Index node) const;
  /// Null for a node that slides on no geometry.
  const SlidingGeometry* geometry(Index node) const;

  /// Of a surface mesh, what tells elements that are turned over (null: nothing does).
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

/// A node that goes where another takes it across a periodic boundary.
struct NodeImage {
  Index image, node;
  std::shared_ptr<const RigidImage> transform;  ///< takes the node to the image
  bool operator==(const NodeImage& other) const {
    return image == other.image && node == other.node && *transform == *other.transform;
  }
};

/// Nodes of a mesh that have no unknowns of their own, because others take them along: images
/// across periodic boundaries, and nodes in rows along curves.
class TiedNodes {
 public:
  /// Throws UsageError if one of the nodes is in a pair already.
  void add(const NodeImage& image);
  /// Ends the pair that a node is in; the other node of the pair, if there was one.
  std::optional<Index> separate(Index node);
  /// The other node of the pair that a node is in.
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
  prescribed,  ///< goes where a motion takes it: no unknown
  image,       ///< goes where its partner across a periodic boundary goes: no unknown of its own
  follows,     ///< goes along a curve where the ends of its row take it: no unknown of its own
  on_curve,    ///< slides along a curve: one unknown
  on_surface,  ///< slides on a surface in space: two
  free         ///< moves as it likes: as many as the space has dimensions
};

/// The class of every node of a mesh. What smooths a mesh asks it which nodes have unknowns, how
/// many and in which directions; Topology::on_boundary() says what the mesh is, not what may move.
/// SlidingNodes knows what nodes slide on, TiedNodes which ones others take along, NodeUnknowns the
/// numbers of unknowns.
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
  /// As many directions as the node has unknowns: of a free node the axes.
  TangentFrame frame(Index node) const;
  /// Where a node at a point is, and the directions in which it may move from there: of a node that
  /// slides on geometry the foot of the point, else the point itself and its frame.
  Foot foot(Index node, const Vec3& point) const;

  // Each throws UsageError for a node that the mesh does not have.

  /// Of a periodic pair both nodes.
  void set_fixed(std::span<const Index> nodes) { set(nodes, NodeClass::fixed); }
  void set_prescribed(std::span<const Index> nodes) { set(nodes, NodeClass::prescribed); }
  /// Throws UsageError for a node that no element uses: nothing says where it is to go.
  void set_free(std::span<const Index> nodes);
  /// tangent: of any length but zero; in the plane its third component must be zero.
  void set_on_curve(Index node, const Vec3& tangent);
  /// normal: of any length but zero. Throws UsageError in the plane.
  void set_on_surface(Index node, const Vec3& normal);
  /// Nodes that slide on geometry, which says what it is at the places in x.
  void set_sliding(std::span<const Index> nodes, std::shared_ptr<const SlidingGeometry> geometry,
                   const Coordinates& x);

  /// Pairs of nodes that move as one: those of the first side are free, those of the second their
  /// images; so are those of corners of which the first slides. Throws UsageError for nodes that
  /// are in a pair already.
  void set_periodic(const PeriodicPairs& pairs);
  /// The nodes between the ends of a row that can follow do so; one of its ends at least moves.
  void set_following(std::shared_ptr<const CurveRow> row);
  /// Of a surface mesh: see SlidingNodes::set_element_normals().
  void set_element_normals(std::shared_ptr<const ElementNormals> normals) {
    sliding_.set_element_normals(std::move(normals));
  }

  /// What nodes slide on.
  const SlidingNodes& sliding() const { return sliding_; }
  /// Nodes that others take along.
  const TiedNodes& tied() const { return tied_; }

  /// Whether the same nodes may move in the same directions. What is fixed in one and prescribed in
  /// the other counts as the same.
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
