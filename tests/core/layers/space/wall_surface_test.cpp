#include "core/layers/space/wall_surface.h"

#include <doctest/doctest.h>

#include <set>

#include "core/error.h"
#include "support/walled_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<LayerWall> walls_at(const std::vector<std::string>& markers) {
  return {{markers, {.count = 3, .first = 0.01}}};
}

std::string refusal(const Mesh& mesh, const std::vector<LayerWall>& walls) {
  try {
    find_wall_surface(mesh, walls);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a cavity is a closed wall, with convex ridges where it juts into the mesh") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    const WallSurface surface = find_wall_surface(mesh, walls_at({"cavity"}));
    CHECK(surface.nodes.size() == 26);
    CHECK(surface.rim_faces.empty());
    double ridges = 0;
    for (const WallEdge& edge : surface.edges) {
      REQUIRE_FALSE(edge.at_rim());
      CHECK((std::abs(edge.turning) < 1e-9 || std::abs(edge.turning - pi / 2) < 1e-9));
      const Vec3 along = mesh.coordinates.xyz(edge.nodes[1]) - mesh.coordinates.xyz(edge.nodes[0]);
      if (edge.turning > 1) ridges += along.norm();
    }
    CHECK(ridges == doctest::Approx(12.0 / 3));  // of a cube a third as wide
    const auto euler = static_cast<long>(surface.nodes.size() + surface.faces.size()) -
                       static_cast<long>(surface.edges.size());
    CHECK(euler == 2);
    for (const WallFace& face : surface.faces) {
      Vec3 middle(0, 0, 0);
      for (const Index node : face.nodes) middle += mesh.coordinates.xyz(node);
      middle /= static_cast<double>(face.nodes.size());
      CHECK(face.normal.dot(middle - Vec3::Constant(0.5)) > 0);
      for (std::size_t k = 0; k < face.nodes.size(); ++k) {
        const WallFace& other = surface.faces[at(face.beside[k])];
        CHECK(std::ranges::count(other.nodes, face.nodes[k]) == 1);
        CHECK(std::ranges::count(other.nodes, face.nodes[(k + 1) % face.nodes.size()]) == 1);
      }
    }
  }
}

TEST_CASE("the outer boundary turns into the mesh: its ridges are concave") {
  const Mesh mesh = make_mesh(cube_with_cavity(3, Volumes::tetrahedra));
  const WallSurface surface = find_wall_surface(mesh, walls_at({"outer"}));
  double least = 0, most = 0;
  for (const WallEdge& edge : surface.edges) {
    least = std::min(least, edge.turning);
    most = std::max(most, edge.turning);
  }
  CHECK(least == doctest::Approx(-pi / 2));
  CHECK(most < 1e-9);
}

TEST_CASE("a wall ends at its rim, beside boundary faces without layers") {
  const Mesh mesh = half_ball_on_floor(6, Volumes::tetrahedra);
  const WallSurface surface = find_wall_surface(mesh, walls_at({"body"}));
  std::size_t rim = 0;
  for (const WallEdge& edge : surface.edges) {
    if (!edge.at_rim()) continue;
    ++rim;
    for (const Index node : edge.nodes) CHECK(mesh.coordinates.xyz(node).z() == 0);
  }
  CHECK(rim == 8);
  REQUIRE_FALSE(surface.rim_faces.empty());
  for (const RimFace& face : surface.rim_faces) CHECK((face.normal - Vec3(0, 0, 1)).norm() < 1e-12);
  for (Index i = 0; i < static_cast<Index>(surface.nodes.size()); ++i) {
    const bool at_floor = mesh.coordinates.xyz(surface.nodes[at(i)]).z() == 0;
    CHECK(surface.rim_faces_at[i].empty() != at_floor);
    CHECK(surface.number(surface.nodes[at(i)]) == i);
  }
}

TEST_CASE("a part of a marker is a wall of its own") {
  const Mesh mesh = make_mesh(cube(4, Volumes::hexahedra));
  auto walls = walls_at({"floor"});
  walls[0].part.xmax = 0.5;
  CHECK(find_wall_surface(mesh, walls).faces.size() == 8);
  walls[0].part.xmin = 0.3;
  CHECK(refusal(mesh, walls).starts_with("no face of marker 'floor' lies in the part"));
}

TEST_CASE("what cannot get layers is refused, by name") {
  const Mesh mesh = make_mesh(cube(3, Volumes::tetrahedra));
  CHECK(refusal(mesh, walls_at({"roof"})) ==
        "the mesh has no marker 'roof'; it has: floor, walls, lid");
  auto twice = walls_at({"floor"});
  twice.push_back(twice.front());
  CHECK(refusal(mesh, twice) == "the layers of marker 'floor' are asked for twice");
  CHECK(refusal(mesh, {}) == "no marker is given to insert layers at");
  CHECK(refusal(make_mesh(square_with_hole(8, Cells::triangles)), walls_at({"hole"}))
            .find("plane mesh") != std::string::npos);

  MeshData inside = cube(2, Volumes::hexahedra);
  inside.markers.push_back(
      {"middle", 9, {by_nodes(shape_of(ElementType::hexahedron).faces[5], inside.element(0))}});
  CHECK(refusal(make_mesh(inside), walls_at({"middle"})).find("has elements on both sides") !=
        std::string::npos);
  const Mesh polyhedra = make_mesh(as_polyhedra(cube(3, Volumes::hexahedra)));
  CHECK(refusal(polyhedra, walls_at({"floor"})).find("is a polyhedron") != std::string::npos);
  const Mesh polygons = make_mesh(split_box_with_body(4));
  CHECK(refusal(polygons, walls_at({"body"})).find("beneath tetrahedra") != std::string::npos);
}
