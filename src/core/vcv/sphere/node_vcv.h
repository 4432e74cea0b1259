#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/vcv/sphere/star_builder.h"
#include "core/vcv/vcv_edit.h"

namespace winslow {

/// A VCV given by hand for one node of a volume mesh: the positions of its neighbours.
struct SphereStencil {
  std::vector<Vec3> directions;  ///< unit vectors, by Topology::neighbours()
  std::vector<double> lengths;   ///< of the edges; only ratios matter

  bool operator==(const SphereStencil&) const = default;
};
/// By node.
using SphereStencils = std::map<Index, SphereStencil>;

/// Checks a stencil and normalises its directions. Throws UsageError, naming the node, unless it is
/// an interior node of a volume mesh, the directions (of any length but zero) cover the sphere
/// without an inverted triangle, and the lengths are positive, the longest at most 1e12 times the
/// shortest.
SphereStencil checked_stencil(const Topology& topology, Index node,
                              std::span<const Vec3> directions, std::span<const double> lengths);

/// The VCV of a single node of a volume mesh.
struct NodeVcv {
  Index node = -1;
  SphereLink link;
  SphereStencil stencil;
  std::vector<double> targets;  ///< wanted solid angles of the link's triangles, steradians
  SphereFitEnd end = SphereFitEnd::converged;
  bool edited = false;  ///< given by hand; `targets` are those without the edit

  /// Computational positions of the neighbours (#neighbours); the node lies at the origin.
  std::vector<Vec3> points() const;
};

/// Computes the VCV that VolumeVcvs would have for this node, in double precision and without
/// computing any others. physical: the mesh that defines angles and lengths. edited: the VCV given
/// by hand; null: none. Throws UsageError for a node without a VCV; MeshError, naming the node, if
/// its star has no VCV.
NodeVcv make_node_vcv(const Topology& topology, const Coordinates& physical, Index node,
                      const VolumeVcvOptions& options, const SphereStencil* edited = nullptr);

/// The VCVs given by hand of a volume mesh, after edits in their order; null: none. before: null
/// for none. Throws UsageError naming the node if its numbers are no valid VCV, or if the node has
/// no VCV.
std::shared_ptr<const SphereStencils> edit_vcvs(const Topology& topology,
                                                const SphereStencils* before,
                                                std::span<const VcvEdit> edits);

/// The edit that gives a node this VCV.
VcvEdit edit_of(const Topology& topology, Index node, const SphereStencil& stencil);

/// The least solid angle, divided by 4 pi / #triangles, among the triangles of a link at one of its
/// vertices, and this triangle.
struct LeastAngle {
  double share = 0;
  Index triangle = -1;
};
LeastAngle least_angle_at(const SphereLink& link, std::span<const Vec3> directions, Index vertex);

}  // namespace winslow
