#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/vcv/sphere/star_builder.h"
#include "core/vcv/vcv_edit.h"

namespace winslow {

/// The VCV of one node of a volume mesh that was given by hand: where its neighbours lie.
struct SphereStencil {
  std::vector<Vec3> directions;  ///< unit vectors, by Topology::neighbours()
  std::vector<double> lengths;   ///< of the edges; only ratios act

  bool operator==(const SphereStencil&) const = default;
};
/// By node.
using SphereStencils = std::map<Index, SphereStencil>;

/// A stencil with directions of length 1. Throws UsageError, naming the node, unless it is an
/// interior node of a volume mesh, the directions (of any length but zero) cover the sphere without
/// an inverted triangle, and the lengths are positive, the longest at most 1e12 times the shortest.
SphereStencil checked_stencil(const Topology& topology, Index node,
                              std::span<const Vec3> directions, std::span<const double> lengths);

/// The VCV of one node of a volume mesh, by itself.
struct NodeVcv {
  Index node = -1;
  SphereLink link;
  SphereStencil stencil;
  std::vector<double> targets;  ///< wanted solid angles of the link's triangles, steradians
  SphereFitEnd end = SphereFitEnd::converged;
  bool edited = false;  ///< given by hand: the targets are what it would have otherwise

  /// Computational positions of the neighbours (#neighbours); the node lies at the origin.
  std::vector<Vec3> points() const;
};

/// The VCV that VolumeVcvs would have for this node, in double precision, without those of all
/// others. physical: the mesh that angles and lengths are taken from. edited: null if it was not
/// given by hand. Throws UsageError for a node that has no VCV; MeshError, naming it, for a star
/// that has none.
NodeVcv make_node_vcv(const Topology& topology, const Coordinates& physical, Index node,
                      const VolumeVcvOptions& options, const SphereStencil* edited = nullptr);

/// The VCVs of a volume mesh that are given by hand, with edits applied in their order; null: none
/// is. before: null for none. Throws UsageError naming the node whose numbers are no VCV, or which
/// has none.
std::shared_ptr<const SphereStencils> edit_vcvs(const Topology& topology,
                                                const SphereStencils* before,
                                                std::span<const VcvEdit> edits);

/// The edit that gives a node this VCV.
VcvEdit edit_of(const Topology& topology, Index node, const SphereStencil& stencil);

/// The least solid angle, over 4 pi / #triangles, of the triangles of a link around one of its
/// vertices; of them which one.
struct LeastAngle {
  double share = 0;
  Index triangle = -1;
};
LeastAngle least_angle_at(const SphereLink& link, std::span<const Vec3> directions, Index vertex);

}  // namespace winslow
