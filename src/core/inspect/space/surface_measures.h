#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/surface_faces.h"
#include "core/mesh/topology.h"

namespace winslow {

/// How many elements deep each element lies below some nodes (#elements): 1 for elements that have
/// one of the nodes, 2 for those beside them (with a node in common), and so on; 0 where none of
/// the nodes can be reached.
std::vector<Index> element_layers(const Topology& topology, std::span<const Index> nodes);

/// Which faces of a boundary enclose bodies (#faces, 1 or 0): a box around a wing does, the wing
/// does not, though both may hang together in a plane of symmetry. All are 0 where nothing is
/// enclosed: of a solid body, that is, which is to be seen from outside.
///
/// Parts are faces of one marker that hang together by edges. A part encloses if most of its area
/// lies on the convex hull of the mesh, up to 1 % of the mesh's extent; the others are bodies
/// if they lie inside or bound it from inside: the sum of (c - c_part) . a over the faces of
/// the boundary among them, of centres c and area vectors a, is not positive.
std::vector<unsigned char> enclosing_faces(const Mesh& mesh, std::span<const SurfaceFace> faces);

/// Areas and volumes of parts of volume meshes. A quadrilateral is taken for the four triangles
/// between its sides and its centre.

double face_area(const SpacePoints& x, const Face& face);
/// Angle by which two faces, or surfaces with these normals, turn from one another: 0 to 90
/// degrees, whichever way the normals point.
double angle_between(const Vec3& normal_a, const Vec3& normal_b);

/// What a surface of some faces measures.
struct SurfaceMeasures {
  Index faces = 0;
  double area = 0;
  Vec3 centroid{0, 0, 0};     ///< of its area
  Vec3 area_vector{0, 0, 0};  ///< sum of the faces' vectors, out of the mesh; 0 of a closed surface
  /// What it encloses: none unless each of its edges has two of its faces.
  std::optional<double> volume;
};
SurfaceMeasures measure_surface(const SpacePoints& x, std::span<const SurfaceFace> faces);

/// The faces of some markers; faces inside the mesh among them.
std::vector<SurfaceFace> faces_of_markers(std::span<const SurfaceFace> faces,
                                          std::span<const Index> markers);

/// Of all elements, by the boundary around them: faces inside are left out.
double mesh_volume(const SpacePoints& x, std::span<const SurfaceFace> boundary);

}  // namespace winslow
