#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

/// Distances of points from a surface mesh: from its triangles and the two triangles of each
/// quadrilateral, which is cut along its shorter diagonal.
class SurfaceDistance {
 public:
  /// Throws UsageError unless it is a surface mesh.
  explicit SurfaceDistance(const Mesh& mesh);

  /// Distance to the nearest triangle, in units of the mesh.
  double to(const Vec3& point) const;
  /// Diagonal of the box around the mesh.
  double extent() const { return around_.size().norm(); }

 private:
  using Triangle = std::array<Vec3, 3>;

  std::vector<Triangle> triangles_;
  Box<3> around_ = Box<3>::empty();
  BoxTree<3> tree_;
};

/// Distance of each element of a surface mesh from another mesh of the same shape (#elements): the
/// largest distance of its nodes, of the midpoints of its edges and of its centre (of a
/// quadrilateral the centres of its two triangles). threads: 0 for all cores; no result depends on
/// it.
std::vector<double> element_distances(const Mesh& mesh, const SurfaceDistance& from,
                                      int threads = 0);
double element_distance(const Mesh& mesh, Index element, const SurfaceDistance& from);
/// The distances of the nodes of a mesh (#nodes); 0 for nodes that no element uses.
std::vector<double> node_distances(const Mesh& mesh, const SurfaceDistance& from, int threads = 0);

/// The change from one surface mesh to another one of the same shape: distances and enclosed
/// volumes. Surfaces consist of triangles; quadrilaterals are cut along their shorter diagonal.
struct SurfaceChange {
  /// Largest distance, in units of the mesh, of sample points of one surface from the other one:
  /// its nodes, the midpoints of its edges and the centres of its elements. The larger one
  /// approximates the Hausdorff distance of the two.
  double from_before = 0, from_after = 0;
  double extent = 0;  ///< diagonal of the box around the mesh before
  /// Enclosed volume; none of a surface that is not closed.
  std::optional<double> volume_before, volume_after;

  double hausdorff() const { return from_before > from_after ? from_before : from_after; }
};

/// threads: 0 for all cores; no result depends on it. Throws UsageError unless both are surface
/// meshes.
SurfaceChange compare_surfaces(const Mesh& before, const Mesh& after, int threads = 0);

/// The same with known distances. after_to_before: element_distances() of `after`.
SurfaceChange compare_surfaces(const Mesh& before, const SurfaceDistance& to_before,
                               const Mesh& after, std::span<const double> after_to_before,
                               int threads = 0);

/// The volume that a closed surface mesh encloses, positive if its elements face outwards.
double enclosed_volume(const Mesh& mesh);

}  // namespace winslow
