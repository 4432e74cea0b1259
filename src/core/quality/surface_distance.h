#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

/// Distances from places to a surface mesh: to its plane triangles, quadrilaterals cut along their
/// shorter diagonal.
class SurfaceDistance {
 public:
  /// Throws UsageError unless it is a surface mesh.
  explicit SurfaceDistance(const Mesh& mesh);

  /// To the nearest triangle, in units of the mesh.
  double to(const Vec3& place) const;
  /// Diagonal of the box around the mesh.
  double extent() const { return around_.size().norm(); }

 private:
  using Triangle = std::array<Vec3, 3>;

  std::vector<Triangle> triangles_;
  Box<3> around_ = Box<3>::empty();
  BoxTree<3> tree_;
};

/// How far each element of a surface mesh is from another one of the same shape (#elements): the
/// largest distance of its nodes, the middles of its edges and its own (of a quadrilateral the
/// middles of its two triangles). threads: 0 for all cores; no result depends on it.
std::vector<double> element_distances(const Mesh& mesh, const SurfaceDistance& from,
                                      int threads = 0);
double element_distance(const Mesh& mesh, Index element, const SurfaceDistance& from);
/// The same of its nodes (#nodes); 0 of those that no element has.
std::vector<double> node_distances(const Mesh& mesh, const SurfaceDistance& from, int threads = 0);

/// How far a surface mesh is from another one of the same shape, and the volume that it encloses.
/// Surfaces are those of the elements: plane triangles, quadrilaterals cut along their shorter
/// diagonal.
struct SurfaceChange {
  /// Largest distance, in units of the mesh, from places of one surface to the other: its nodes,
  /// the middles of its edges and of its elements. The larger one is the Hausdorff distance of the
  /// two, as far as these places tell.
  double from_before = 0, from_after = 0;
  double extent = 0;  ///< diagonal of the box around the mesh before
  /// Enclosed volume; none of a surface that is not closed.
  std::optional<double> volume_before, volume_after;

  double hausdorff() const { return from_before > from_after ? from_before : from_after; }
};

/// threads: 0 for all cores; no result depends on it. Throws UsageError unless both are surface
/// meshes.
SurfaceChange compare_surfaces(const Mesh& before, const Mesh& after, int threads = 0);

/// The same of a surface whose distances are known already. after_to_before: what
/// element_distances() says of the mesh after.
SurfaceChange compare_surfaces(const Mesh& before, const SurfaceDistance& to_before,
                               const Mesh& after, std::span<const double> after_to_before,
                               int threads = 0);

/// The volume that a closed surface mesh encloses, positive if its elements face outwards.
double enclosed_volume(const Mesh& mesh);

}  // namespace winslow
