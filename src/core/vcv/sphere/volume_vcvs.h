#pragma once

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/sphere/star_builder.h"

namespace winslow {

/// Virtual control volumes (VCVs) of the interior nodes of a volume mesh, as data: the directions
/// (unit vectors) and lengths of their edges in computational space. The node lies at the origin,
/// neighbour k of Topology::neighbours() in direction k; the triangles of the link (see SphereLink)
/// are the outer triangles.
///
/// Computed directions are stored in single precision: 12 bytes for each neighbour, 180 MB for a
/// million nodes of 15 neighbours, and 4 bytes more if edges have lengths. VCVs that were set are
/// stored in double precision.
class VolumeVcvs {
 public:
  /// Equal angles and unit edges. Throws UsageError for another mesh than a volume mesh, and for
  /// other options; MeshError or NumericError, naming the node, for a star without a VCV (see
  /// SphereLink, SphereStart).
  explicit VolumeVcvs(std::shared_ptr<const Topology> topology,
                      const VolumeVcvOptions& options = {});
  /// Angles of any kind. physical: the mesh, which may be tangled; the fit of a valid star starts
  /// from its directions.
  VolumeVcvs(std::shared_ptr<const Topology> topology, const Coordinates& physical,
             const VolumeVcvOptions& options);

  const Topology& topology() const { return *topology_; }
  const std::shared_ptr<const Topology>& shared_topology() const { return topology_; }
  const VolumeVcvOptions& options() const { return options_; }

  std::size_t bytes() const { return bytes_of(directions_, lengths_, ends_, rows_, targets_); }

  /// Recomputes the adjusted angles from the present mesh, but not the edge lengths. Stars whose
  /// wanted angles changed by more than the tolerance of a fit are solved again from their present
  /// directions; returns their number. VCVs that were set are kept. Throws UsageError unless the
  /// angles are adjusted ones.
  Index adjust(const Coordinates& physical);

  /// Direction of edge k of an interior node, a unit vector.
  Vec3 direction(Index node, Index k) const;
  /// Length of edge k of an interior node. Only ratios within one VCV matter.
  double length(Index node, Index k) const;
  /// Computational position of neighbour k of an interior node, which lies at the origin.
  Vec3 point(Index node, Index k) const { return length(node, k) * direction(node, k); }
  /// Computational positions of the neighbours of an interior node (#neighbours).
  void points(Index node, std::vector<Vec3>& out) const;

  /// Replaces the VCV of an interior node. directions: of any length but zero, so that no triangle
  /// is inverted; lengths: positive, the longest at most 1e12 times the shortest. Throws UsageError
  /// otherwise.
  void set(Index node, std::span<const Vec3> directions, std::span<const double> lengths);
  /// Restores the computed VCV.
  void reset(Index node);
  bool edited(Index node) const { return edited_.contains(node); }

  /// How the fit of the i-th interior node ended; see Topology::interior_nodes().
  SphereFitEnd fit_end(std::size_t i) const { return ends_[i]; }
  /// The wanted solid angles of the i-th interior node with this link, in steradians (#triangles).
  void targets(std::size_t i, const SphereLink& link, std::vector<double>& out) const;

 private:
  class StarSolver;

  Index solve(const Coordinates* physical, bool first);
  void take_lengths(const Coordinates& physical);
  Vec3 computed(Index node, Index k) const;

  std::shared_ptr<const Topology> topology_;
  VolumeVcvOptions options_;
  std::vector<float> directions_;   // 3 for each entry of Topology::neighbour_rows()
  std::vector<float> lengths_;      // of Topology::neighbour_rows(); empty: unit edges
  std::vector<SphereFitEnd> ends_;  // #interior nodes
  std::vector<std::size_t> rows_;   // #interior nodes + 1, into targets_; empty of equal angles
  std::vector<float> targets_;      // of the triangles of each link; empty of equal angles
  SphereStencils edited_;
};

/// Statistics of the VCVs of a mesh: those of AIAA 2009-1362, and the errors relative to the wanted
/// angles. VCVs that were set are excluded.
struct VolumeVcvStatistics {
  Index stars = 0;
  Index triangles = 0;
  double min_angle = 0, max_angle = 0;  ///< solid angles, in steradians
  double min_cost = 0, max_cost = 0;    ///< of a vertex of a star, see star_cost()
  double mean_error = 0;                ///< of |Omega / Omega* - 1| over all triangles
  double max_error = 0;
  Index off = 0;               ///< stars with a triangle whose error exceeds 0.1 %
  Index limited_by_shape = 0;  ///< stars whose fit ended so, see SphereFitEnd
  Index out_of_steps = 0;
};

/// threads: 0 for all cores; no result depends on it.
VolumeVcvStatistics measure_vcvs(const VolumeVcvs& vcvs, int threads = 0);

}  // namespace winslow
