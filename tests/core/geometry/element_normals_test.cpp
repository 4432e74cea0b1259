#include "core/geometry/element_normals.h"

#include <doctest/doctest.h>

#include "core/geometry/sliding_boundary.h"
#include "support/surface_meshes.h"

namespace winslow::test {

TEST_CASE("element normals: those of the surface, on the side that elements show") {
  for (const bool inwards : {false, true}) {
    MeshData data = octasphere(6);
    if (inwards)
      for (std::size_t e = 0; e < data.element_nodes.size(); e += 3)
        std::swap(data.element_nodes[e + 1], data.element_nodes[e + 2]);
    const Mesh mesh = make_mesh(data);
    const MeshState state = on_shape(mesh, sphere_shape(1));
    const auto normals = state.surface->normals->of_elements(mesh.coordinates, 1);
    const SpacePoints x(mesh.coordinates);
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      const auto nodes = mesh.topology->element(e);
      const Vec3 outwards = (x[nodes[0]] + x[nodes[1]] + x[nodes[2]]).normalized();
      CHECK((normals[at(e)] - (inwards ? -1 : 1) * outwards).norm() < 1e-12);
    }
    // They go with the nodes: turned by half a turn, the elements of the top are at the bottom.
    Coordinates turned = mesh.coordinates;
    for (Index i = 0; i < turned.size(); ++i) {
      const Vec3 p = x[i];
      turned.set_xyz(i, {p.x(), -p.y(), -p.z()});
    }
    const auto other = state.surface->normals->of_elements(turned, 2);
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      const Vec3 n = normals[at(e)];
      CHECK((other[at(e)] - Vec3(n.x(), -n.y(), -n.z())).norm() < 1e-12);
    }
  }
}

TEST_CASE("element normals: elements without a node inside a region keep the one they had") {
  const Mesh mesh = make_mesh(skin(cube(1, Volumes::hexahedra)));
  const ElementNormals normals(mesh.topology, mesh.coordinates, SlidingBoundary{});
  const SpacePoints x(mesh.coordinates);
  const auto found = normals.of_elements(mesh.coordinates, 1);
  for (Index e = 0; e < mesh.topology->element_count(); ++e)
    CHECK((found[at(e)] - doubled_area_vector(x, mesh.topology->element(e)).normalized()).norm() <
          1e-14);
}

TEST_CASE("remembered feet: the geometry is asked once for each place") {
  struct Counting final : SlidingGeometry {
    Foot foot(Index, const Vec3& point) const override {
      ++asked;
      Foot foot;
      foot.point = point.normalized();
      return foot;
    }
    mutable int asked = 0;
  };
  const auto counting = std::make_shared<Counting>();
  const RememberedFeet feet(counting, 2);
  const Vec3 a(2, 0, 0), b(0, 3, 0), c(0, 0, 4);
  for (int round = 0; round < 3; ++round) {
    CHECK(feet.foot(0, a).point == Vec3(1, 0, 0));
    CHECK(feet.foot(0, b).point == Vec3(0, 1, 0));
    CHECK(feet.foot(0, Vec3(0, 1, 0)).point == Vec3(0, 1, 0));  // the foot of its own foot
  }
  CHECK(counting->asked == 2);
  feet.foot(0, a);
  feet.foot(0, c);  // b goes
  CHECK(counting->asked == 3);
  feet.foot(0, a);
  CHECK(counting->asked == 3);
  feet.foot(1, a);  // another node
  CHECK(counting->asked == 4);
}

}  // namespace winslow::test
