#include "core/mesh/surface_faces.h"
#include "core/mesh/enclosing_faces.h"

#include <doctest/doctest.h>

#include <map>

#include "core/error.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Vec3 sum_of_areas(const Mesh& mesh, const std::vector<SurfaceFace>& faces) {
  const SpacePoints x(mesh.coordinates);
  Vec3 sum = Vec3::Zero();
  for (const SurfaceFace& face : faces) sum += area_vector(x, face.nodes);
  return sum;
}

/// By the divergence theorem; exact for plane faces.
double volume_within(const Mesh& mesh, const std::vector<SurfaceFace>& faces) {
  const SpacePoints x(mesh.coordinates);
  double sum = 0;
  for (const SurfaceFace& face : faces)
    sum += centre_of(x, face.nodes).dot(area_vector(x, face.nodes)) / 3;
  return sum;
}

double area_of(const Mesh& mesh, const std::vector<SurfaceFace>& faces,
               const std::vector<unsigned char>& chosen) {
  const SpacePoints x(mesh.coordinates);
  double sum = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (chosen[f] != 0) sum += area_vector(x, faces[f].nodes).norm();
  return sum;
}

}  // namespace

TEST_CASE("The faces of the boundary are seen from outside and know their markers") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    const auto faces = boundary_faces(*mesh.topology);
    CHECK(volume_within(mesh, faces) == doctest::Approx(1));
    const SpacePoints x(mesh.coordinates);
    double lid = 0;
    for (const SurfaceFace& face : faces) {
      CHECK(face.neighbour == -1);
      if (mesh.topology->markers()[at(face.marker)].name == "lid")
        lid += area_vector(x, face.nodes).z();
    }
    CHECK(lid == doctest::Approx(1));
  }
}

TEST_CASE("What bounds a set of elements is closed, and holds their volume") {
  Random random(5);
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    std::vector<unsigned char> chosen;
    double volume = 0;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      chosen.push_back(static_cast<unsigned char>(random.index(2)));
      if (chosen.back() != 0) volume += element_value(mesh, e, Metric::volume);
    }
    const auto faces = outer_faces(*mesh.topology, chosen);
    CHECK(sum_of_areas(mesh, faces).norm() < 1e-12);
    CHECK(volume_within(mesh, faces) == doctest::Approx(volume));
    const SurfaceEdges edges = surface_edges(faces);
    for (Index k = 0; k < edges.faces.rows(); ++k) CHECK(edges.faces[k].size() % 2 == 0);
    for (const SurfaceFace& face : faces) {
      CHECK(chosen[at(face.element)] == 1);
      if (face.neighbour >= 0) CHECK(chosen[at(face.neighbour)] == 0);
    }
  }
}

TEST_CASE("Feature edges are those of the cube, whatever its sides are made of") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    MeshData data = cube(4, volumes);
    data.markers.clear();
    const Mesh mesh = make_mesh(data);
    const SpacePoints x(mesh.coordinates);
    auto faces = boundary_faces(*mesh.topology);
    faces[0].nodes = faces[0].nodes.reversed();  // which way a face is seen does not matter
    const SurfaceEdges edges = surface_edges(faces);
    const auto sharp = feature_edges(x, faces, edges, 30);
    double length = 0;
    for (std::size_t k = 0; k < sharp.size(); ++k)
      if (sharp[k] != 0) length += (x[edges.nodes[k][1]] - x[edges.nodes[k][0]]).norm();
    CHECK(length == doctest::Approx(12));
  }
}

TEST_CASE(
    "Edges between markers and at the rim of a surface are features, those of flat ones not") {
  const Mesh mesh = make_mesh(cube(4, Volumes::hexahedra));
  std::vector<SurfaceFace> faces;
  for (const SurfaceFace& face : boundary_faces(*mesh.topology))
    if (mesh.topology->markers()[at(face.marker)].name == "lid") faces.push_back(face);
  const SurfaceEdges edges = surface_edges(faces);
  const SpacePoints x(mesh.coordinates);
  const auto count = [&] {
    const auto sharp = feature_edges(x, faces, edges, 30);
    return std::count(sharp.begin(), sharp.end(), 1);
  };
  CHECK(count() == 16);
  for (SurfaceFace& face : faces)
    if (centre_of(x, face.nodes).x() > 0.5) face.marker = -1;
  CHECK(count() == 20);
}

TEST_CASE("A box around a body encloses it") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::mixed}) {
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    const auto faces = boundary_faces(*mesh.topology);
    CHECK(area_of(mesh, faces, enclosing_faces(mesh, faces)) == doctest::Approx(6));
  }
}

TEST_CASE(
    "A body that stands on a side of the box is none of the box, if markers tell them apart") {
  // A cavity that opens to the floor.
  MeshData data = cubes_with_holes(6, Volumes::hexahedra, [](Index i, Index j, Index k) {
    return i / 2 == 1 && j / 2 == 1 && k < 2;
  });
  mark_volume(data, [](const Vec3& p) {
    return (p - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9 ? "box" : "body";
  });
  const Mesh mesh = make_mesh(data);
  const auto faces = boundary_faces(*mesh.topology);
  CHECK(area_of(mesh, faces, enclosing_faces(mesh, faces)) == doctest::Approx(6 - 1.0 / 9));
}

TEST_CASE("A box around a plate without thickness encloses it") {
  MeshData data = cube(6, Volumes::hexahedra);
  Marker plate{"plate", 9, {}};
  for (Index e = 0; e < data.element_count(); ++e) {
    for (const Face& face : faces_of(data, e)) {
      Vec3 middle = Vec3::Zero();
      for (const Index node : face) middle += data.coordinates.xyz(node) / 4;
      const Vec3 from_centre = middle - Vec3::Constant(0.5);
      if (std::abs(from_centre.z()) < 1e-9 && from_centre.cwiseAbs().maxCoeff() < 0.2 &&
          face[0] == *std::min_element(face.begin(), face.end()))
        plate.faces.push_back(face);
    }
  }
  REQUIRE(plate.faces.size() >= 4);
  data.markers.push_back(plate);
  const Mesh mesh = make_mesh(data);
  const auto faces = boundary_faces(*mesh.topology);
  CHECK(area_of(mesh, faces, enclosing_faces(mesh, faces)) == doctest::Approx(6));
}

TEST_CASE("Nothing encloses a solid body") {
  // A cube, a cube with markers for each side, and a cross whose arms' ends alone lie on the hull.
  MeshData cross = cubes_with_holes(9, Volumes::hexahedra, [](Index i, Index j, Index k) {
    return (i / 3 != 1) + (j / 3 != 1) + (k / 3 != 1) > 1;
  });
  mark_volume(cross, [](const Vec3& p) {
    return (p - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9 ? "ends" : "arms";
  });
  MeshData bare = cube(3, Volumes::prisms);
  bare.markers.clear();
  for (const MeshData& data : {cube(3, Volumes::tetrahedra), bare, cross}) {
    const Mesh mesh = make_mesh(data);
    const auto faces = boundary_faces(*mesh.topology);
    CHECK(area_of(mesh, faces, enclosing_faces(mesh, faces)) == 0);
  }
}

TEST_CASE("Surfaces of elements are for volume meshes") {
  const Mesh flat = make_mesh(square(2, Cells::quads));
  CHECK_THROWS_AS(boundary_faces(*flat.topology), UsageError);
}
