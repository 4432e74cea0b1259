#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// How a node may move while a mesh is smoothed.
enum class NodeClass : std::uint8_t {
  fixed,       ///< stays where it is: no unknown
  prescribed,  ///< goes where a motion takes it: no unknown
  on_curve,    ///< slides along a curve: one unknown
  on_surface,  ///< slides on a surface in space: two
  free         ///< moves as it likes: as many as the space has dimensions
};

/// Orthonormal directions in which a node may move, one per unknown. In the plane their third
/// component is zero.
class TangentFrame {
 public:
  TangentFrame() = default;
  /// The axes of a space of that many dimensions.
  static TangentFrame axes(int dimension);
  void add(const Vec3& direction) { directions_[static_cast<std::size_t>(count_++)] = direction; }

  int count() const { return count_; }
  const Vec3* begin() const { return directions_.data(); }
  const Vec3* end() const { return directions_.data() + count_; }

  bool operator==(const TangentFrame&) const = default;

 private:
  std::array<Vec3, 3> directions_{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  int count_ = 0;
};

/// The class of every node of a mesh. What smooths a mesh asks it which nodes have unknowns, how
/// many and in which directions; Topology::on_boundary() says
/// what the mesh is, not what may move.
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
  /// Number of directions in which a node may move: 0 to 3.
  int unknowns(Index node) const;
  /// As many directions as the node has unknowns: of a free node the axes.
  TangentFrame frame(Index node) const;

  // Each throws UsageError for a node that the mesh does not have.

  void set_fixed(std::span<const Index> nodes) { set(nodes, NodeClass::fixed); }
  void set_prescribed(std::span<const Index> nodes) { set(nodes, NodeClass::prescribed); }
  /// Throws UsageError for a node that no element uses: nothing says where it is to go.
  void set_free(std::span<const Index> nodes);
  /// tangent: of any length but zero; in the plane its third component must be zero.
  void set_on_curve(Index node, const Vec3& tangent);
  /// normal: of any length but zero. Throws UsageError in the plane.
  void set_on_surface(Index node, const Vec3& normal);

  /// Whether the same nodes may move in the same directions. What is fixed in one and prescribed in
  /// the other counts as the same.
  bool same_unknowns(const NodeClasses& other) const;

 private:
  void require(Index node) const;
  void set(std::span<const Index> nodes, NodeClass value);

  std::shared_ptr<const Topology> topology_;
  std::vector<NodeClass> classes_;
  std::map<Index, TangentFrame> frames_;  // of nodes on curves and surfaces
};

}  // namespace winslow
