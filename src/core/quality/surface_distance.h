#pragma once

#include <array>
#include <vector>

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

}  // namespace winslow
