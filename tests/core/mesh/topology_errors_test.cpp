#include <doctest/doctest.h>

#include <array>
#include <functional>

#include "core/error.h"
#include "core/mesh/topology.h"
#include "support/meshes.h"

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
