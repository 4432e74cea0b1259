#include <doctest/doctest.h>

#include <algorithm>
#include <span>
#include <vector>

#include "core/mesh/surface_faces.h"

/// Which edges of a surface are sharp where it has slivers.
namespace winslow::test {
namespace {

struct Surface {
  Coordinates x{3, 0};
  std::vector<SurfaceFace> faces;

  void add(Index a, Index b, Index c) { faces.push_back({Face(a, b, c), -1, -1, -1}); }
  /// The number of edges of two faces that are sharp.
  long sharp_inside(double angle) const {
    const SurfaceEdges edges = surface_edges(faces);
    const auto sharp = feature_edges(SpacePoints(x), faces, edges, angle);
    long count = 0;
    for (std::size_t k = 0; k < sharp.size(); ++k)
      count += sharp[k] != 0 && edges.faces[static_cast<Index>(k)].size() == 2 ? 1 : 0;
    return count;
  }
};

}  // namespace

TEST_CASE("face normals: a sliver that stands across its surface by chance is no sharp edge") {
  // Two halves of a plane that meet along an edge, but for a node that was put half-way on it and
  // lies higher by noise.
  Surface s;
  for (const Vec3& p :
       {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, -0.8, 0), Vec3(0.5, 0.8, 0), Vec3(0.5, 0, 0.02)})
    s.x.push_xyz(p);
  s.add(1, 0, 2);
  s.add(0, 1, 4);
  s.add(0, 4, 3);
  s.add(4, 1, 3);
  const SurfaceEdges edges = surface_edges(s.faces);
  const auto normals = face_normals(SpacePoints(s.x), s.faces, edges, 40);
  CHECK(std::abs(area_vector(SpacePoints(s.x), s.faces[1].nodes).normalized().z()) < 1e-12);
  CHECK(normals[1].normalized().z() > 0.99);
  CHECK(s.sharp_inside(40) == 0);
}

TEST_CASE("face normals: the low wall of a step is one, however long its triangles are") {
  Surface s;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0.03), Vec3(1, 0, 0.03),
                        Vec3(0.5, -0.8, 0), Vec3(0.5, 0.8, 0.03)})
    s.x.push_xyz(p);
  s.add(0, 4, 1);
  s.add(0, 1, 3);
  s.add(0, 3, 2);
  s.add(2, 3, 5);
  CHECK(s.sharp_inside(40) == 2);
}

}  // namespace winslow::test
