#pragma once

#include "core/mesh/coordinates.h"
#include "core/vcv/virtual_control_volumes.h"

/// One node gets angles of its own, in degrees:
///
///     winslow::EditVcvCommand edit;
///     winslow::VcvEdit angles;
///     angles.node = node;
///     angles.angles = {100, 80, 90, 90};  // of a node with four neighbours
///     edit.edits = {angles};
///     state = winslow::execute(edit, state).state;
namespace winslow {

/// New numbers for the VCV of one node: angles of a plane mesh, directions of a volume mesh.
/// Without any: the VCV again that the node has of itself.
struct VcvEdit {
  Index node = -1;
  /// The node's neighbours to which the numbers belong: of a plane mesh counter-clockwise from any
  /// one on, of a volume mesh in any order; empty: as in Topology::neighbours().
  std::vector<Index> neighbours;
  /// Degrees; angle k lies between neighbour k and neighbour k + 1 (cyclic). Their sum is 360
  /// within 0.01 and is made exact. Empty: equal angles.
  std::vector<double> angles;
  std::vector<double> lengths;  ///< of the edges to the neighbours; empty: all 1
  /// Where the edges point to, of any length but zero; so that no triangle of the link is inverted.
  std::vector<Vec3> directions = {};

  bool resets() const { return angles.empty() && lengths.empty() && directions.empty(); }
  bool operator==(const VcvEdit&) const = default;
};

/// VCVs with edits applied in their order. Throws UsageError naming the node whose numbers are no
/// VCV, or which has none.
std::shared_ptr<const VirtualControlVolumes> edit_vcvs(const VirtualControlVolumes& vcv,
                                                       std::span<const VcvEdit> edits);

/// The edit that gives a node the VCV which it has now.
VcvEdit edit_of(const VirtualControlVolumes& vcv, Index node);

/// Places (counter-clockwise) by which the edges of one physical star are numbered later than those
/// of another of as many edges: edge k of `from` and edge k + shift of `to` (cyclic) point nearly
/// the same way. points: neighbours relative to their node.
std::size_t matching_shift(std::span<const Vec2> from, std::span<const Vec2> to);

/// Edits that give the VCV of one node to others with as many neighbours, each turned so that its
/// edges belong to neighbours in nearly the same directions in the mesh x (#nodes by 2). Of a
/// surface mesh (x: #nodes by 3) directions are those in the tangent planes, that of the target
/// turned into the source's by the smallest rotation. Throws UsageError for a target with another
/// number of neighbours, or without a VCV.
std::vector<VcvEdit> spread_vcv(const VirtualControlVolumes& vcv, const Coordinates& x,
                                Index source, std::span<const Index> targets);

}  // namespace winslow
