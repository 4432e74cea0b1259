#include <doctest/doctest.h>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "support/coordinate.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// Builds, and returns the error that must come of it.
MeshError refusal_of_topology(const MeshData& data) {
  try {
    Topology::build(data);
  } catch (const MeshError& error) {
    return error;
  }
  FAIL("the mesh was accepted");
  return {MeshEntity::mesh, -1, ""};
}

MeshData plane_points(std::initializer_list<std::array<double, 2>> list) {
  MeshData data;
  for (const auto& p : list) data.coordinates.push_xy({p[0], p[1]});
  return data;
}

bool says(const MeshError& error, const std::string& text) {
  CAPTURE(error.what());
  return std::string(error.what()).find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("a mesh without elements is refused") {
  const MeshError error = refusal_of_topology(plane_points({{0, 0}, {1, 0}, {0, 1}}));
  CHECK(error.entity() == MeshEntity::mesh);
  CHECK(says(error, "no elements"));
}

TEST_CASE("node ids out of range name the element and the id") {
  for (const Index bad : {-1, 4, 1000000}) {
    MeshData data = plane_points({{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    add_triangle(data, 0, 1, 2);
    add_triangle(data, 1, bad, 2);
    const MeshError error = refusal_of_topology(data);
    CHECK(error.entity() == MeshEntity::element);
    CHECK(error.index() == 1);
    CHECK(says(error, "uses node " + std::to_string(bad) + ", expected 0 to 3"));
  }
}

TEST_CASE("a corner given twice is refused") {
  MeshData data = plane_points({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_quad(data, 0, 1, 2, 1);
  const MeshError error = refusal_of_topology(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 0);
  CHECK(says(error, "uses node 1 twice"));
}

TEST_CASE("an edge of three elements is refused") {
  MeshData data = plane_points({{0, 0}, {1, 0}, {0.5, 1}, {0.5, -1}, {0.5, 2}});
  add_triangle(data, 0, 1, 2);
  add_triangle(data, 0, 1, 3);
  add_triangle(data, 1, 0, 4);
  const MeshError error = refusal_of_topology(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 2);
  CHECK(says(error, "shared by 3 elements"));
}

TEST_CASE("parts that touch in one node only are refused") {
  MeshData data = plane_points({{0, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}});
  add_triangle(data, 0, 1, 2);
  add_triangle(data, 0, 3, 4);
  const MeshError error = refusal_of_topology(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(error.index() == 0);
  CHECK(says(error, "non-manifold"));
}

TEST_CASE("three parts that touch in one node are refused") {
  MeshData data = plane_points({{0, 0}, {2, 0}, {2, 1}, {-1, 2}, {-2, 2}, {-2, -2}, {-1, -2}});
  add_triangle(data, 0, 1, 2);
  add_triangle(data, 0, 3, 4);
  add_triangle(data, 0, 5, 6);
  CHECK(refusal_of_topology(data).index() == 0);
}

TEST_CASE("a Moebius strip is refused") {
  MeshData data;
  constexpr Index n = 5;
  for (Index k = 0; k < n; ++k) {
    const double phi = 2 * pi * k / n;
    data.coordinates.push_xy(Vec2(std::cos(phi), std::sin(phi)));
    data.coordinates.push_xy(2 * Vec2(std::cos(phi), std::sin(phi)));
  }
  for (Index k = 0; k + 1 < n; ++k) add_quad(data, 2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2);
  add_quad(data, 2 * n - 2, 2 * n - 1, 0, 1);
  const MeshError error = refusal_of_topology(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(says(error, "one-sided"));
}

TEST_CASE("a closed surface is refused: it has no boundary to hold") {
  SUBCASE("the same triangle twice") {
    MeshData data = plane_points({{0, 0}, {1, 0}, {0, 1}});
    add_triangle(data, 0, 1, 2);
    add_triangle(data, 1, 2, 0);
    CHECK(says(refusal_of_topology(data), "no boundary"));
  }
  SUBCASE("a flattened tetrahedron beside a good mesh") {
    MeshData data = square(2, Cells::triangles);
    const Index o = data.node_count();
    for (const Vec2& p : {Vec2(3, 0), Vec2(4, 0), Vec2(3, 1), Vec2(3.2, 0.2)}) {
      data.coordinates.push_xy(p);
    }
    const Index first = data.element_count();
    add_triangle(data, o, o + 1, o + 2);
    add_triangle(data, o, o + 1, o + 3);
    add_triangle(data, o + 1, o + 2, o + 3);
    add_triangle(data, o + 2, o, o + 3);
    const MeshError error = refusal_of_topology(data);
    CHECK(error.entity() == MeshEntity::element);
    CHECK(error.index() == first);
  }
}

TEST_CASE("a marker edge that is no edge of an element is refused with marker and position") {
  MeshData data = square(2, Cells::quads);
  SUBCASE("a diagonal") { data.markers[1].faces.push_back({0, 2}); }
  SUBCASE("an id out of range") { data.markers[1].faces.push_back({0, 99}); }
  SUBCASE("a negative id") { data.markers[1].faces.push_back({-3, 0}); }
  SUBCASE("one node twice") { data.markers[1].faces.push_back({1, 1}); }
  const MeshError error = refusal_of_topology(data);
  CHECK(error.entity() == MeshEntity::marker_face);
  CHECK(error.marker() == 1);
  CHECK(error.index() == 2);
  CHECK(says(error, "expected an edge of an element"));
}

namespace {

MeshData points(std::initializer_list<Vec3> list) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (const Vec3& p : list) data.coordinates.push_xyz(p);
  return data;
}

bool is_middle(Index i, Index j, Index k) { return i == 1 && j == 1 && k == 1; }

/// The corners of the hole in the middle of 27 cubes, numbered as a hexahedron's.
std::array<Index, 8> corners_of_hole(const MeshData& data) {
  std::array<Index, 8> corners{};
  const auto reference = shape_of(ElementType::hexahedron).corners;
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 p = (Vec3(reference[k].data()) + Vec3::Ones()) / 3;
    for (Index i = 0; i < data.node_count(); ++i) {
      if (data.coordinates.xyz(i) == p) corners[k] = i;
    }
  }
  return corners;
}

}  // namespace

TEST_CASE("elements of two dimensions do not mix") {
  MeshData data = cube(1, Volumes::tetrahedra);
  add_cell(data, ElementType::triangle, {0, 1, 2});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 6);
  CHECK(says(error, "element 6 is a triangle, expected elements of dimension 3"));
}

TEST_CASE("volume elements between points of the plane are refused") {
  MeshData data;
  data.coordinates = Coordinates(2, 4);
  add_cell(data, ElementType::tetrahedron, {0, 1, 2, 3});
  CHECK(says(refusal(data), "between points of the plane"));
}

TEST_CASE("an element with another number of corners than its type has is refused") {
  MeshData data = cube(1, Volumes::hexahedra);
  data.types[0] = ElementType::prism;
  CHECK(says(refusal(data), "element 0 is a prism with 8 corners, expected 6"));
}

TEST_CASE("node ids out of range and repeated corners of volume elements are refused") {
  for (const Index bad : {-1, 8, 100000}) {
    MeshData data = cube(1, Volumes::tetrahedra);
    data.element_nodes[9] = bad;
    const MeshError error = refusal(data);
    CHECK(error.entity() == MeshEntity::element);
    CHECK(error.index() == 2);
    CHECK(says(error, "uses node " + std::to_string(bad) + ", expected 0 to 7"));
  }
  MeshData data = cube(1, Volumes::hexahedra);
  data.element_nodes[7] = data.element_nodes[0];
  CHECK(says(refusal(data), "twice"));
}

TEST_CASE("a face of three volume elements is refused with its nodes and the third element") {
  MeshData data = points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.2, 0.2, 2}});
  add_cell(data, ElementType::tetrahedron, {0, 1, 2, 3});
  add_cell(data, ElementType::tetrahedron, {0, 2, 1, 4});
  add_cell(data, ElementType::tetrahedron, {0, 1, 2, 5});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 2);
  CHECK(says(error, "the face with nodes 0, 2 and 1 is shared by 3 elements"));
}

TEST_CASE("volumes that meet in an edge only are refused") {
  MeshData data = points({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
  add_cell(data, ElementType::tetrahedron, {0, 2, 3, 1});
  add_cell(data, ElementType::tetrahedron, {0, 4, 5, 1});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(error.index() == 0);
  CHECK(says(error, "the edge between nodes 0 and 1 joins parts of the mesh"));
}

TEST_CASE("volumes that meet in a node only are refused") {
  MeshData data =
      points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  add_cell(data, ElementType::tetrahedron, {0, 1, 2, 3});
  add_cell(data, ElementType::tetrahedron, {0, 5, 4, 6});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(error.index() == 0);
  CHECK(says(error, "meet in this node only"));
}

TEST_CASE("of several nodes in which volumes meet the one with the lowest number is named") {
  // A row of tetrahedra along x, from far to near and each on the tip of the last.
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  constexpr Index count = 12;
  for (Index k = 0; k <= count; ++k) data.coordinates.push_xyz({double(count - k), 0, 0});
  for (Index k = 0; k < count; ++k) {
    const auto first = data.coordinates.size();
    data.coordinates.push_xyz({count - k - 0.5, 0.2, 0});
    data.coordinates.push_xyz({count - k - 0.5, 0, 0.2});
    add_cell(data, ElementType::tetrahedron, {k, first, first + 1, k + 1});
  }
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(error.index() == 1);
}

TEST_CASE("a boundary that touches itself in one node is refused") {
  // Two cavities in hexahedra that share one corner: the star hangs together, its link is a ring.
  const MeshData data = cubes_with_holes(4, Volumes::hexahedra, [](Index i, Index j, Index k) {
    return (i == 1 && j == 1 && k == 1) || (i == 2 && j == 2 && k == 2);
  });
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(data.coordinates.xyz(error.index()) == Vec3(0.5, 0.5, 0.5));
  CHECK(says(error, "meet in this node only"));
}

TEST_CASE("of faults in a mesh that several threads go through, the first is named") {
  // Pairs of cavities that share one corner: far from the origin, and near it.
  constexpr Index n = 18;
  const auto near_corner = [](Index low) {
    return [low](Index i, Index j, Index k) {
      return (i == low && j == low && k == low) || (i == low + 1 && j == low + 1 && k == low + 1);
    };
  };
  const MeshData data = cubes_with_holes(n, Volumes::hexahedra, [&](Index i, Index j, Index k) {
    return near_corner(2)(i, j, k) || near_corner(14)(i, j, k);
  });
  REQUIRE(data.node_count() > 4096);  // blocks of parallel loops
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(data.coordinates.xyz(error.index()) == Vec3(3, 3, 3) / n);

  // An element three times, at either end: the face of the lowest nodes is the first.
  MeshData thrice =
      cubes_with_holes(n, Volumes::hexahedra, [](Index, Index, Index) { return false; });
  for (const Index e : {thrice.element_count() - 1, Index{5}}) {
    const std::vector<Index> corners(thrice.element(e).begin(), thrice.element(e).end());
    for (int k = 0; k < 2; ++k) thrice.add_element(ElementType::hexahedron, corners);
  }
  const MeshError again = refusal(thrice);
  CHECK(again.entity() == MeshEntity::element);
  CHECK(again.index() >= thrice.element_count() - 2);  // the copies of element 5
  CHECK(says(again, "is shared by "));
}

TEST_CASE("neighbours that join the corners of a quadrilateral differently are refused") {
  MeshData data = cubes_with_holes(2, Volumes::hexahedra,
                                   [](Index, Index j, Index k) { return j > 0 || k > 0; });
  // Corners 1 and 2 of the second cube belong to no other; its side to the first is 0 3 7 4.
  std::swap(data.element_nodes[8 + 3], data.element_nodes[8 + 7]);
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(says(error, "in another order than element"));
}

TEST_CASE("volume elements given twice have no boundary") {
  MeshData data = cube(1, Volumes::hexahedra);
  const std::vector<Index> corners(data.element_nodes);
  data.add_element(ElementType::hexahedron, corners);
  data.markers.clear();
  CHECK(says(refusal(data), "belongs to a closed volume, which has no boundary"));
}

TEST_CASE("a marker face that is no face of an element is refused with marker and position") {
  MeshData data = cube(2, Volumes::hexahedra);
  REQUIRE(data.markers[1].faces.size() > 2);
  data.markers[1].faces.resize(2);
  SUBCASE("a triangle of a quadrilateral") {
    const Face face = data.markers[0].faces[0];
    data.markers[1].faces.emplace_back(face[0], face[1], face[2]);
  }
  SUBCASE("nodes far apart") { data.markers[1].faces.emplace_back(0, 5, 10, 20); }
  SUBCASE("an id out of range") { data.markers[1].faces.emplace_back(0, 1, 2, 9999); }
  SUBCASE("a negative id") { data.markers[1].faces.emplace_back(-4, 1, 2, 3); }
  SUBCASE("an edge") { data.markers[1].faces.emplace_back(0, 1); }
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::marker_face);
  CHECK(error.marker() == 1);
  CHECK(error.index() == 2);
  CHECK(says(error, "expected a face of an element"));
}

TEST_CASE("a coordinate of space that is not finite is refused") {
  for (const int component : {0, 1, 2}) {
    MeshData data = cube(1, Volumes::hexahedra);
    coordinate(data.coordinates, 5, component) = std::numeric_limits<double>::quiet_NaN();
    const MeshError error = refusal(data);
    CHECK(error.entity() == MeshEntity::node);
    CHECK(error.index() == 5);
  }
}

TEST_CASE("a flat volume element is refused, a thin one passes") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    MeshData thin = cube(4, volumes);
    for (Index i = 0; i < thin.node_count(); ++i) coordinate(thin.coordinates, i, 2) *= 1e-7;
    CHECK_NOTHROW(make_mesh(thin));
  }
  MeshData data = points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.3, 0}});
  add_cell(data, ElementType::tetrahedron, {0, 1, 2, 3});
  add_cell(data, ElementType::tetrahedron, {0, 2, 1, 4});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 1);
  CHECK(says(error, "no volume"));
}

TEST_CASE("two nodes of a volume mesh in one place are refused") {
  MeshData data = cube(3, Volumes::hexahedra);
  const auto topology = Topology::build(data);
  const auto free = topology->interior_nodes();
  data.coordinates.set_xyz(free[1], data.coordinates.xyz(free[0]));
  CHECK(says(refusal(data), "duplicate"));
}

TEST_CASE("an inverted volume element is no error") {
  MeshData data = cube(3, Volumes::hexahedra);
  const auto topology = Topology::build(data);
  data.coordinates.set_xyz(topology->interior_nodes()[0], {0.9, 0.95, 0.99});
  CHECK_NOTHROW(make_mesh(data));
}

TEST_CASE("a volume element that shares no face is refused, a single one is a mesh") {
  MeshData data = cube(2, Volumes::hexahedra);
  const Index o = data.node_count();
  for (const Vec3& p : {Vec3(5, 5, 5), Vec3(6, 5, 5), Vec3(5, 6, 5), Vec3(5, 5, 6)}) {
    data.coordinates.push_xyz(p);
  }
  add_cell(data, ElementType::tetrahedron, {o, o + 1, o + 2, o + 3});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 8);
  CHECK(says(error, "shares no face with any other (isolated)"));
  CHECK_NOTHROW(make_mesh(cube(1, Volumes::hexahedra)));
}

TEST_CASE("triangles on a quadrilateral of a neighbour are refused") {
  // The middle one of 27 cubes is cut into pyramids and, on its top, two tetrahedra.
  MeshData data = cubes_with_holes(3, Volumes::hexahedra, is_middle);
  CubeCutter(data, corners_of_hole(data)).pyramids(true);
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(data.types[at(error.index())] == ElementType::tetrahedron);
  CHECK(says(error, "covers half of a quadrilateral of element"));

  data = cubes_with_holes(3, Volumes::hexahedra, is_middle);
  CubeCutter(data, corners_of_hole(data)).pyramids(false);
  CHECK_NOTHROW(make_mesh(data));
}

TEST_CASE("a hanging node of a volume mesh is refused") {
  MeshData data = cubes_with_holes(3, Volumes::hexahedra, is_middle);
  CubeCutter(data, corners_of_hole(data)).pyramids(false);
  // The last pyramid in the middle becomes three tetrahedra and, on its base, a pyramid whose apex
  // lies in the middle of its neighbour's triangle.
  const Index pyramid = data.element_count() - 1;
  const auto given = data.element(pyramid);
  const std::vector<Index> c(given.begin(), given.end());
  const Index hanging = data.node_count();
  data.types.pop_back();
  data.element_offsets.pop_back();
  data.element_nodes.resize(data.element_nodes.size() - 5);
  const Coordinates& x = data.coordinates;
  data.coordinates.push_xyz((x.xyz(c[0]) + x.xyz(c[1]) + x.xyz(c[4])) / 3);
  add_cell(data, ElementType::pyramid, {c[0], c[1], c[2], c[3], hanging});
  add_cell(data, ElementType::tetrahedron, {c[1], c[2], hanging, c[4]});
  add_cell(data, ElementType::tetrahedron, {c[2], c[3], hanging, c[4]});
  add_cell(data, ElementType::tetrahedron, {c[3], c[0], hanging, c[4]});
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(error.index() == hanging);
  CHECK(says(error, "lies inside the face with nodes"));
  CHECK(says(error, "hanging node"));
  // Walls of meshes with polyhedra may touch: told, not refused.
  std::vector<std::string> warnings;
  make_mesh(as_polyhedra(data), &warnings);
  CHECK(std::ranges::any_of(warnings, [](const std::string& text) {
    return text.starts_with("1 boundary face has a node of another one inside");
  }));
}
