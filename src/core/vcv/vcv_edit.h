#pragma once

#include "core/mesh/coordinates.h"
#include "core/vcv/virtual_control_volumes.h"

/// Sets the VCV angles of one node, in degrees:
///
///     winslow::EditVcvCommand edit;
///     winslow::VcvEdit angles;
///     angles.node = node;
///     angles.angles = {100, 80, 90, 90};  // of a node with four neighbours
///     edit.edits = {angles};
///     state = winslow::execute(edit, state).state;
namespace winslow {

/// New numbers for the VCV of one node: angles of a plane mesh, directions of a volume mesh.
/// Without any: resets the node's VCV to the default.
struct VcvEdit {
  Index node = -1;
  /// The neighbours to which the numbers belong: in a plane mesh counter-clockwise from any one, in
  /// a volume mesh in any order; empty: as in Topology::neighbours().
  std::vector<Index> neighbours;
  /// Degrees; angle k lies between neighbour k and neighbour k + 1 (cyclic). Their sum is 360
  /// within 0.01 and is made exact. Empty: equal angles.
  std::vector<double> angles;
  std::vector<double> lengths;  ///< of the edges to the neighbours; empty: all 1
  /// Directions of the edges, of any length but zero, such that no triangle of the link is
  /// inverted.
  std::vector<Vec3> directions = {};

  bool resets() const { return angles.empty() && lengths.empty() && directions.empty(); }
  bool operator==(const VcvEdit&) const = default;
};

/// VCVs with edits applied in their order. Throws UsageError naming the node if its numbers are no
/// valid VCV, or if the node has no VCV.
std::shared_ptr<const VirtualControlVolumes> edit_vcvs(const VirtualControlVolumes& vcv,
                                                       std::span<const VcvEdit> edits);

/// The edit that reproduces the present VCV of a node.
VcvEdit edit_of(const VirtualControlVolumes& vcv, Index node);

/// The cyclic shift that matches the edges of two physical stars with the same number of edges:
/// edge k of `from` and edge k + shift of `to` (counter-clockwise) have nearly the same direction.
/// points: neighbours relative to their node.
std::size_t matching_shift(std::span<const Vec2> from, std::span<const Vec2> to);

/// Edits that copy the VCV of one node to others with as many neighbours. Each copy is rotated so
/// that its edges match the neighbours with nearly the same directions in the mesh x (#nodes by 2).
/// In a surface mesh (x: #nodes by 3) directions lie in the tangent planes; the smallest rotation
/// maps the target's plane to the source's. Throws UsageError for a target with another number of
/// neighbours, or without a VCV.
std::vector<VcvEdit> spread_vcv(const VirtualControlVolumes& vcv, const Coordinates& x,
                                Index source, std::span<const Index> targets);

}  // namespace winslow
