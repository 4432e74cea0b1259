#pragma once

#include <map>

#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// Checks for the VCVs of plane and volume meshes.

/// Throws UsageError unless it is an interior node that some element uses.
void require_vcv_node(const Topology& topology, Index node);

/// Throws UsageError, naming the node, unless the lengths are positive and the longest is at most
/// 1e12 times the shortest.
void require_edge_lengths(Index node, std::span<const double> lengths);

/// Virtual control volumes (VCVs) of the interior nodes, as data: for each the angles between its
/// consecutive edges and the lengths of its edges, in computational space.
///
/// Karman & Sahasrabudhe, AIAA 2009-1362, section "Virtual Control Volume (2D)": the node lies at
/// the origin, its edge neighbours on the unit circle in the order of connectivity, separated by
/// equal angles; quadrilaterals are cut at the corner, so each element gives one triangle. Changing
/// these numbers controls angles and spacing. Only changed VCVs are stored, so a copy is cheap.
///
/// At a hanging node, which is a flat corner of one polygon (corners_of_polygon()), that polygon
/// has half of the circle, and the others have equal parts of the other half.
class VirtualControlVolumes {
 public:
  /// Unit edges and equal angles: 2 pi / #neighbours, but for hanging nodes. In a surface mesh they
  /// lie in the tangent planes. Throws UsageError for a volume mesh.
  explicit VirtualControlVolumes(std::shared_ptr<const Topology> topology);

  const Topology& topology() const { return *topology_; }
  const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }

  /// Angle k, in radians, lies between edge k and edge k + 1 (cyclic); they sum to 2 pi.
  /// Empty for nodes of the boundary.
  std::span<const double> angles(Index node) const;
  /// Length of edge k. Only ratios within one VCV matter. Empty for nodes of the boundary.
  std::span<const double> lengths(Index node) const;
  /// Computational position of neighbour k of an interior node: edge 0 lies on the positive x axis.
  Vec2 point(Index node, Index k) const;

  /// Replaces the VCV of an interior node. Angles are in (0, pi) (2 edges, and the polygon at a
  /// hanging node: up to pi) and sum to 2 pi within 1e-9; lengths are positive, the longest at most
  /// 1e12 times the shortest. Throws UsageError otherwise.
  void set(Index node, std::span<const double> angles, std::span<const double> lengths);
  /// The angles of a node whose VCV is not edited. Empty for nodes of the boundary.
  std::span<const double> equal_angles(Index node) const;
  /// Whether a node is a flat corner of one of its three or more elements.
  bool hangs(Index node) const { return hanging_.contains(node); }
  /// Resets the VCV to equal angles and unit edges. Throws UsageError for a node of the boundary.
  void reset(Index node);

  /// Angles and lengths of one node.
  struct Stencil {
    std::vector<double> angles, lengths;
  };
  /// True if the node's VCV was set and not reset since.
  bool edited(Index node) const { return edited_.contains(node); }
  /// What was set, by node.
  const std::map<Index, Stencil>& edits() const { return edited_; }

 private:
  const Stencil* stencil(Index node) const;
  const Stencil* equal_stencil(Index node) const;
  void find_hanging_nodes();

  std::shared_ptr<const Topology> topology_;
  std::vector<Stencil> equal_;        // by number of neighbours
  std::map<Index, Stencil> hanging_;  // of hanging nodes
  std::map<Index, Stencil> edited_;
};

}  // namespace winslow
