#include "core/inspect/space/surface_measures.h"

#include <doctest/doctest.h>

#include "support/space_meshes.h"

namespace winslow::test {

TEST_CASE("areas and volumes of a cube with a hole, of any elements") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube_with_cavity(3, volumes));
    const SpacePoints x(mesh.coordinates);
    const std::vector<SurfaceFace> faces = boundary_faces(*mesh.topology);
    CHECK(mesh_volume(x, faces) == doctest::Approx(26.0 / 27));
    const Index outer = *mesh.topology->markers().find("outer");
    const Index cavity = *mesh.topology->markers().find("cavity");
    const SurfaceMeasures body =
        measure_surface(x, faces_of_markers(faces, std::vector<Index>{cavity}));
    CHECK(body.area == doctest::Approx(6.0 / 9));
    REQUIRE(body.volume.has_value());
    CHECK(*body.volume == doctest::Approx(1.0 / 27));
    CHECK((body.centroid - Vec3::Constant(0.5)).norm() < 1e-12);
    CHECK(body.area_vector.norm() < 1e-12);
    const SurfaceMeasures all =
        measure_surface(x, faces_of_markers(faces, std::vector<Index>{outer, cavity}));
    CHECK(all.faces == static_cast<Index>(faces.size()));
    CHECK(all.area == doctest::Approx(6 + 6.0 / 9));
  }
}

TEST_CASE("a surface with a rim encloses nothing, and has a resultant area") {
  MeshData data = cube(2, Volumes::hexahedra);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) { return p.z() > 1 - 1e-9 ? "lid" : "rest"; });
  const Mesh mesh = make_mesh(data);
  const std::vector<SurfaceFace> faces = boundary_faces(*mesh.topology);
  const Index lid = *mesh.topology->markers().find("lid");
  const SurfaceMeasures measures =
      measure_surface(SpacePoints(mesh.coordinates), faces_of_markers(faces, std::vector{lid}));
  CHECK_FALSE(measures.volume.has_value());
  CHECK((measures.area_vector - Vec3(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("planes turn from one another by 0 to 90 degrees") {
  CHECK(angle_between(Vec3(0, 0, 1), Vec3(0, 0, -2)) == doctest::Approx(0));
  CHECK(angle_between(Vec3(0, 0, 1), Vec3(3, 0, 0)) == doctest::Approx(90));
  CHECK(angle_between(Vec3(0, 0, 1), Vec3(1, 0, -1)) == doctest::Approx(45));
}

TEST_CASE("layers at a wall are counted element by element") {
  MeshData data = cube(4, Volumes::hexahedra);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) { return p.z() < 1e-9 ? "wall" : "rest"; });
  const Mesh mesh = make_mesh(data);
  const Topology& topology = *mesh.topology;
  const std::vector<Index> layers =
      element_layers(topology, topology.markers().nodes(*topology.markers().find("wall")));
  const SpacePoints x(mesh.coordinates);
  for (Index e = 0; e < topology.element_count(); ++e) {
    double z = 0;
    for (const Index node : topology.element(e)) z += x[node].z() / 8;
    CHECK(layers[at(e)] == 1 + static_cast<Index>(4 * z));
  }
  const std::vector<Index> none = element_layers(topology, {});
  CHECK(std::ranges::count(none, 0) == topology.element_count());
}

}  // namespace winslow::test
