#include "core/mesh/polyhedron.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <set>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "core/quality/volume_element.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr std::array volume_types{ElementType::tetrahedron, ElementType::pyramid,
                                  ElementType::prism, ElementType::hexahedron};

std::vector<Vec3> places_of(ElementType type) {
  std::vector<Vec3> places;
  for (const auto& place : regular_corners(type)) places.emplace_back(place.data());
  return places;
}

std::vector<Face> faces_of_type(ElementType type) {
  return {shape_of(type).faces.begin(), shape_of(type).faces.end()};
}

/// The tetrahedra by their sorted nodes: their order and that of their nodes do not matter.
std::multiset<std::set<Index>> as_sets(std::span<const std::array<Index, 4>> tetrahedra) {
  std::multiset<std::set<Index>> all;
  for (const auto& nodes : tetrahedra) all.insert({nodes.begin(), nodes.end()});
  return all;
}

double volume6(const std::array<Index, 4>& nodes, std::span<const Vec3> x) {
  const Vec3 p = x[at(nodes[0])];
  return (x[at(nodes[1])] - p).dot((x[at(nodes[2])] - p).cross(x[at(nodes[3])] - p));
}

std::string fault_of(const std::vector<Face>& faces, std::span<const Vec3> places) {
  try {
    const PolyhedronShape shape(faces, places);
    return {};
  } catch (const PolyhedronFault& fault) {
    return fault.text;
  }
}

MoveCommand turn_body(double degrees) {
  MoveCommand move;
  move.bodies[0].markers = {"body"};
  move.bodies[0].motion.rotate = degrees;
  move.bodies[0].motion.axis = Vec3(0.3, 0.5, 1);
  return move;
}

}  // namespace

TEST_CASE("a polyhedron with the faces of a type has its edges, links and tetrahedra") {
  for (const ElementType type : volume_types) {
    const ElementShape& expected = shape_of(type);
    CAPTURE(expected.name);
    const std::vector<Vec3> places = places_of(type);
    const PolyhedronShape made(faces_of_type(type), places);
    const ElementShape& shape = made.shape();
    CHECK(shape.type == ElementType::polyhedron);
    CHECK(shape.like == type);
    CHECK(shape.edges.size() == expected.edges.size());
    REQUIRE(shape.links.size() == expected.links.size());
    for (std::size_t k = 0; k < shape.links.size(); ++k) {
      const Face &link = shape.links[k], &other = expected.links[k];
      REQUIRE(link.size() == other.size());
      const std::size_t from = index_of(other, link[0]);
      for (std::size_t i = 0; i < link.size(); ++i)
        CHECK(link[i] == other[(from + i) % other.size()]);
    }
    CHECK(as_sets(shape.corner_tetrahedra) == as_sets(expected.corner_tetrahedra));
    CHECK(as_sets(shape.edge_tetrahedra) == as_sets(expected.edge_tetrahedra));
    for (const auto* list : {&shape.corner_tetrahedra, &shape.edge_tetrahedra})
      for (const auto& nodes : *list) CHECK(volume6(nodes, places) > 0);
    // The regular corners are those of the type.
    for (std::size_t k = 0; k < shape.corner_tetrahedra.size(); ++k) {
      const auto edges = regular_corner(shape.face_sizes[k]);
      const auto& nodes = shape.corner_tetrahedra[k];
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = places[at(nodes[i + 1])] - places[at(nodes[0])];
        const Vec3 b = places[at(nodes[(i + 1) % 3 + 1])] - places[at(nodes[0])];
        CHECK(edges[i].dot(edges[(i + 1) % 3]) ==
              doctest::Approx(a.dot(b) / (a.norm() * b.norm())).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("regular corners of a dodecahedron, and of faces that would not close") {
  const auto pentagons = regular_corner({5, 5, 5});
  CHECK(pentagons[0].dot(pentagons[1]) == doctest::Approx(std::cos(108 * pi / 180)));
  CHECK(pentagons[1].dot(pentagons[2]) == doctest::Approx(std::cos(108 * pi / 180)));
  CHECK(pentagons[2].dot(pentagons[0]) == doctest::Approx(std::cos(108 * pi / 180)));
  for (const std::array<std::uint8_t, 3> sizes :
       {std::array<std::uint8_t, 3>{6, 6, 6}, {8, 8, 4}, {3, 3, 12}}) {
    const auto edges = regular_corner(sizes);
    CHECK(edges[0].dot(edges[1].cross(edges[2])) > 0.1);
  }
}

TEST_CASE("faces that bound no solid are refused") {
  const std::vector<Vec3> places = places_of(ElementType::hexahedron);
  std::vector<Face> open = faces_of_type(ElementType::hexahedron);
  open.pop_back();
  CHECK(fault_of(open, places).find("are not closed") != std::string::npos);
  std::vector<Face> turned = faces_of_type(ElementType::hexahedron);
  turned[2] = turned[2].reversed();
  CHECK(fault_of(turned, places).find("in the same direction") != std::string::npos);
  CHECK(fault_of({turned[0], turned[1]}, places).find("has 2 faces") != std::string::npos);
  // Two tetrahedra that have one corner in common.
  std::vector<Face> twins = faces_of_type(ElementType::tetrahedron);
  const std::vector<Index> second{0, 4, 5, 6};
  for (const Face& face : faces_of_type(ElementType::tetrahedron))
    twins.push_back(by_nodes(face, second));
  const std::vector<Vec3> spread{{0, 0, 0},  {1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                 {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  CHECK(fault_of(twins, spread).find("meets itself in corner 0") != std::string::npos);
}

TEST_CASE("a mesh refuses polyhedra with faces between other nodes, or with few nodes") {
  MeshData data = as_polyhedra(cube(2, Volumes::hexahedra));
  const auto message = [&] {
    try {
      make_mesh(data);
      return std::string();
    } catch (const MeshError& error) {
      CHECK(error.index() == 3);
      return std::string(error.what());
    }
  };
  Face& face = data.faces[at(data.face_offsets[3])];
  const Face good = face;
  face = Face(good[0], good[1]);
  CHECK(message().find("a face of 2 nodes") != std::string::npos);
  face = Face(good[0], good[1], 1000000, good[3]);
  CHECK(message().find("expected nodes among its corners") != std::string::npos);
  face = Face(good[0], good[1], good[1], good[3]);
  CHECK(message().find("a node twice") != std::string::npos);
}

TEST_CASE("the topology of polyhedra is that of the same elements by their types") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const MeshData data = cube(3, volumes);
    const auto expected = Topology::build(data);
    for (const bool turned : {false, true}) {
      MeshData polyhedra = as_polyhedra(data);
      if (turned)
        for (Face& face : polyhedra.faces) face = face.reversed();
      const auto topology = Topology::build(polyhedra);
      CHECK(topology->reversed_elements() == (turned ? data.element_count() : 0));
      REQUIRE(topology->face_count() == expected->face_count());
      for (Index f = 0; f < expected->face_count(); ++f) {
        CHECK(topology->face(f).elements == expected->face(f).elements);
        CHECK(topology->face(f).nodes.sorted() == expected->face(f).nodes.sorted());
      }
      for (Index node = 0; node < expected->node_count(); ++node) {
        CHECK(std::ranges::equal(topology->neighbours(node), expected->neighbours(node)));
        CHECK(std::ranges::equal(topology->star(node), expected->star(node)));
      }
      CHECK(check_validity(*topology, data.coordinates).inverted == 0);
      for (Index e = 0; e < data.element_count(); ++e) {
        const VolumeElement one(data.coordinates, topology->shape(e), topology->element(e));
        const VolumeElement other(data.coordinates, expected->shape(e), expected->element(e));
        CHECK(one.volume() == doctest::Approx(other.volume()));
        CHECK(one.scaled_jacobian() == doctest::Approx(other.scaled_jacobian()));
        CHECK(one.condition_number() == doctest::Approx(other.condition_number()));
        CHECK(one.smallest_solid_angle() == doctest::Approx(other.smallest_solid_angle()));
      }
    }
  }
}

TEST_CASE("elements given by their faces move like the same elements by their types") {
  for (const Volumes volumes :
       {Volumes::tetrahedra, Volumes::pyramids, Volumes::prisms, Volumes::hexahedra}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = box_with_body(5, volumes);
    MeshData data = cubes_with_holes(
        5, volumes, [](Index i, Index j, Index k) { return i == 2 && j == 2 && k == 2; });
    data.markers = mesh.topology->markers().list();
    const CommandResult by_types = execute(turn_body(15), make_state(mesh));
    const CommandResult by_faces =
        execute(turn_body(15), make_state(make_mesh(as_polyhedra(data))));
    CHECK(by_faces.smooth.converged);
    CHECK(by_faces.smooth.inverted == 0);
    const Coordinates &a = by_types.state.mesh.coordinates, &b = by_faces.state.mesh.coordinates;
    double apart = 0, way = 0;
    for (Index i = 0; i < a.size(); ++i) {
      apart = std::max(apart, (a.xyz(i) - b.xyz(i)).norm());
      way = std::max(way, (a.xyz(i) - mesh.coordinates.xyz(i)).norm());
    }
    CHECK(way > 0.01);
    CHECK(apart < 1e-9);
  }
}

TEST_CASE("a mesh of split hexahedra has flat corners, and moves there and back") {
  const MeshData data = split_box_with_body(6);
  const Mesh mesh = make_mesh(data);
  const Topology& topology = *mesh.topology;
  Index with_flat = 0;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const ElementShape& shape = topology.shape(e);
    CHECK(VolumeElement(mesh.coordinates, shape, topology.element(e)).scaled_jacobian() ==
          doctest::Approx(1));
    CHECK(shape.real_corners == 8);
    CHECK(regular_volume(shape) == doctest::Approx(6 * std::sqrt(2.0)));
    if (shape.links.size() > 8) ++with_flat;
    // pi / 2 at the corners of the cube, pi inside its edges, 2 pi inside its faces.
    const VolumeElement element(mesh.coordinates, shape, topology.element(e));
    CHECK(element.smallest_solid_angle() == doctest::Approx(pi / 2));
    CHECK(element.largest_solid_angle() <= 2 * pi + 1e-9);
    // The eight corners of a cube have one tetrahedron each, nodes in its faces have none.
    std::set<Index> corners;
    for (const auto& nodes : shape.corner_tetrahedra) corners.insert(nodes[0]);
    CHECK(corners.size() >= 8);
  }
  CHECK(with_flat > 10);
  const MeshState state = make_state(mesh);
  const CommandResult there = execute(turn_body(20), state);
  CHECK(there.smooth.converged);
  CHECK(there.smooth.inverted == 0);
  MeshState moved = there.state;
  const CommandResult back = execute(turn_body(-20), moved);
  CHECK(back.smooth.converged);
  double apart = 0;
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    apart = std::max(apart, (back.state.mesh.coordinates.xyz(i) - mesh.coordinates.xyz(i)).norm());
  CHECK(apart < 1e-6);  // of a cube with edges of 1, by the tolerance of two solves
}

TEST_CASE("a moved mesh of polyhedra that is read anew finds back to its reference mesh") {
  const Mesh mesh = make_mesh(split_box_with_body(6));
  const auto turn = [](double degrees) {
    MoveCommand move = turn_body(degrees);
    move.smooth.tolerance = 1e-9;
    return move;
  };
  const CommandResult there = execute(turn(60), make_state(mesh));
  MeshData moved = split_box_with_body(6);
  moved.coordinates = there.state.mesh.coordinates;
  // Read anew, its hanging nodes are corners: the motion has bent the faces.
  const MeshState read = make_state(make_mesh(moved));
  const MeshState told = with_reference(read, mesh);
  CHECK(told.mesh.topology == mesh.topology);
  const CommandResult back = execute(turn(-60), told);
  CHECK(back.smooth.converged);
  double apart = 0;
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    apart = std::max(apart, (back.state.mesh.coordinates.xyz(i) - mesh.coordinates.xyz(i)).norm());
  CHECK(apart < 1e-6);
}

TEST_CASE("walls of cells by faces may meet in an edge, those of elements by types may not") {
  // The cubes 0 0 and 1 1 of the two lower layers share an edge and no face.
  const MeshData data = cubes_with_holes(4, Volumes::hexahedra, [](Index i, Index j, Index k) {
    return k < 2 && i < 2 && j < 2 && i != j;
  });
  CHECK_THROWS_AS(make_mesh(data), MeshError);
  const MeshState state = make_state(make_mesh(as_polyhedra(data)));
  CHECK(state.mesh.topology->element_count() == data.element_count());
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  MeshState shaken = state;
  Random random(5);
  for (const Index node : state.mesh.topology->interior_nodes())
    shaken.mesh.coordinates.set_xyz(
        node, state.mesh.coordinates.xyz(node) + 0.03 * random_vector(random));
  const CommandResult result = execute(smooth, shaken);
  CHECK(result.smooth.converged);
  for (const Index node : state.mesh.topology->interior_nodes())
    CHECK((result.state.mesh.coordinates.xyz(node) - state.mesh.coordinates.xyz(node)).norm() <
          1e-5);
}

TEST_CASE("a hexahedron with one flat corner has face tetrahedra over it") {
  std::vector<Vec3> places = places_of(ElementType::hexahedron);
  const std::vector<Face> faces = faces_of_type(ElementType::hexahedron);
  CHECK(PolyhedronShape(faces, places).shape().face_tetrahedra.empty());
  CHECK_FALSE(has_flat_corner(shape_of(ElementType::hexahedron), places));
  places[6] = Vec3(0.68, 0.68, 0.68);  // near the plane of its three neighbours
  CHECK(has_flat_corner(shape_of(ElementType::hexahedron), places));
  const PolyhedronShape flat(faces, places);
  const ElementShape& shape = flat.shape();
  CHECK(shape.corner_tetrahedra.size() == 7);
  CHECK(shape.face_tetrahedra.size() == 3);  // one for each of its faces
  for (const auto& [corner, a, b, behind] : shape.face_tetrahedra) {
    CHECK(corner == 6);
    const auto place = [&](Index k) { return places[static_cast<std::size_t>(k)]; };
    const Vec3 p = place(corner);
    CHECK((place(a) - p).dot((place(b) - p).cross(place(behind) - p)) > 0.1);
  }
  // All corners of a sheared hexahedron are alike.
  for (Vec3& p : places = places_of(ElementType::hexahedron)) p.x() += 12 * p.z();
  CHECK_FALSE(has_flat_corner(shape_of(ElementType::hexahedron), places));
}

TEST_CASE("smoothing leaves a mesh of regular split hexahedra as it is, and mends a shaken one") {
  const Mesh mesh = make_mesh(split_box_with_body(6));
  MeshState state = make_state(mesh);
  Random random(77);
  for (const Index node : mesh.topology->interior_nodes())
    state.mesh.coordinates.set_xyz(node,
                                   state.mesh.coordinates.xyz(node) + 0.01 * random_vector(random));
  REQUIRE(check_validity(*mesh.topology, state.mesh.coordinates).inverted == 0);
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend{.element = 1};
  const CommandResult result = execute(smooth, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(check_validity(*mesh.topology, result.state.mesh.coordinates).min_sine >
        check_validity(*mesh.topology, state.mesh.coordinates).min_sine);
}
