#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/surface_faces.h"
#include "core/mesh/topology.h"

namespace winslow {

/// The layer of each element counted from some nodes (#elements): 1 for elements with one of the
/// nodes, 2 for elements that share a node with these, and so on; 0 for elements that are not
/// connected with the nodes.
std::vector<Index> element_layers(const Topology& topology, std::span<const Index> nodes);

/// Areas and volumes of parts of volume meshes. A quadrilateral counts as the four triangles of its
/// sides with its centre.

double face_area(const SpacePoints& x, const Face& face);
/// Angle between two planes with these normals, 0 to 90 degrees, for any sign of the normals.
double angle_between(const Vec3& normal_a, const Vec3& normal_b);

/// Measures of a surface.
struct SurfaceMeasures {
  Index faces = 0;
  double area = 0;
  Vec3 centroid{0, 0, 0};     ///< of its area
  Vec3 area_vector{0, 0, 0};  ///< sum over the faces, out of the mesh; 0 of a closed surface
  /// Enclosed volume; only of a closed surface, with two faces at each edge.
  std::optional<double> volume;
};
SurfaceMeasures measure_surface(const SpacePoints& x, std::span<const SurfaceFace> faces);

/// The faces of some markers, also those inside the mesh.
std::vector<SurfaceFace> faces_of_markers(std::span<const SurfaceFace> faces,
                                          std::span<const Index> markers);

/// Volume of all elements, from the boundary faces; faces inside the mesh do not count.
double mesh_volume(const SpacePoints& x, std::span<const SurfaceFace> boundary);

}  // namespace winslow
