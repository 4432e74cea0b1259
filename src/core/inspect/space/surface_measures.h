#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/surface_faces.h"

/// Areas and volumes of parts of volume meshes. A quadrilateral is taken for the four triangles
/// between its sides and its centre.
namespace winslow {

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
