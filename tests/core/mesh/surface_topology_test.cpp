#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Vec3 paraboloid(const Vec2& p) { return {p.x(), p.y(), p.squaredNorm()}; }

bool says(const MeshError& error, const std::string& text) {
  CAPTURE(error.what());
  return std::string(error.what()).find(text) != std::string::npos;
}

Vec3 normal(const MeshData& data, std::span<const Index> corners) {
  const Coordinates& x = data.coordinates;
  const Vec3 o = x.xyz(corners[0]);
  return (x.xyz(corners[1]) - o).cross(x.xyz(corners.back()) - o);
}

std::vector<MeshData> plane_meshes() {
  std::vector<MeshData> all;
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    all.push_back(square(5, cells));
    all.push_back(square_with_two_holes(10, cells));
  }
  return all;
}

}  // namespace

TEST_CASE("a plane mesh that is laid over a surface keeps all of its connectivity") {
  for (const MeshData& plane : plane_meshes()) {
    const MeshData data = lifted(plane, paraboloid);
    std::vector<std::string> warnings;
    const Mesh mesh = make_mesh(data, &warnings);
    CHECK(warnings.empty());
    const Topology& t = *mesh.topology;
    const auto flat = Topology::build(plane);
    CHECK(t.cell_dimension() == 2);
    CHECK(t.space_dimension() == 3);
    CHECK(mesh_kind(t) == "surface mesh");
    CHECK(mesh_kind(*flat) == "plane mesh");
    CHECK(mesh.coordinates == data.coordinates);
    CHECK(t.elements().values == flat->elements().values);
    CHECK(t.neighbour_rows().values == flat->neighbour_rows().values);
    CHECK(t.boundary_loops() == flat->boundary_loops());
    CHECK(std::ranges::equal(t.interior_nodes(), flat->interior_nodes()));
    for (Index i = 0; i < t.node_count(); ++i) {
      CHECK(std::ranges::equal(t.star(i), flat->star(i)));
    }
    for (std::size_t m = 0; m < t.markers().size(); ++m) {
      CHECK(t.markers()[m].faces == flat->markers()[m].faces);
    }
    CHECK(t.half_edges().n_edges() == t.edges().size());
  }
}

TEST_CASE("the elements of a surface are turned to face as the first one does") {
  for (const bool first_turned : {false, true}) {
    Random random(5);
    const MeshData plane = square(5, Cells::mixed);
    MeshData data = lifted(plane, paraboloid);
    Index turned = 0;
    for (Index e = 0; e < data.element_count(); ++e) {
      if (e == 0 ? !first_turned : random.index(2) == 0) continue;
      const auto begin = data.element_nodes.begin() + data.element_offsets[at(e)];
      std::reverse(begin + 1, data.element_nodes.begin() + data.element_offsets[at(e) + 1]);
      ++turned;
    }
    std::vector<std::string> warnings;
    const Mesh mesh = make_mesh(data, &warnings);
    for (Index e = 0; e < data.element_count(); ++e) {
      const double z = normal(data, mesh.topology->element(e)).z();
      CHECK((first_turned ? z < 0 : z > 0));
    }
    const Index expected = first_turned ? data.element_count() - turned : turned;
    CHECK(mesh.topology->reversed_elements() == expected);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0] ==
          std::to_string(expected) + " elements were turned to face as their neighbours do");
  }
}

TEST_CASE("a closed surface has no boundary and faces outwards if its first element does") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const MeshData data = skin(cube(4, volumes));
    const Mesh mesh = make_mesh(data);
    const Topology& t = *mesh.topology;
    CHECK(t.boundary_loops().empty());
    CHECK(t.markers().empty());
    CHECK_FALSE(t.markers().from_file());
    CHECK(t.reversed_elements() == 0);
    CHECK(t.interior_nodes().size() == at(t.node_count()));
    // Euler: V - E + F = 2 of a sphere.
    CHECK(t.node_count() - t.face_count() + t.element_count() == 2);
    for (Index e = 0; e < t.element_count(); ++e) {
      Vec3 middle(0, 0, 0);
      for (const Index i : t.element(e)) middle += data.coordinates.xyz(i) - Vec3::Constant(0.5);
      CHECK(normal(data, t.element(e)).dot(middle) > 0);
    }
    for (Index i = 0; i < t.node_count(); ++i) {
      CHECK(t.neighbours(i).size() == t.star(i).size());
      CHECK(t.neighbours(i).front() == std::ranges::min(t.neighbours(i)));
    }
  }
}

TEST_CASE("a Moebius strip in space is refused") {
  constexpr Index n = 12;
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (Index k = 0; k < n; ++k) {
    const double phi = 2 * pi * k / n;
    for (const double side : {-0.3, 0.3}) {
      const double r = 1 + side * std::cos(phi / 2);
      data.coordinates.push_xyz({r * std::cos(phi), r * std::sin(phi), side * std::sin(phi / 2)});
    }
  }
  for (Index k = 0; k + 1 < n; ++k) add_quad(data, 2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2);
  add_quad(data, 2 * n - 2, 2 * n - 1, 0, 1);
  CHECK(says(refusal(data), "one-sided"));
}

TEST_CASE("surfaces are checked as plane meshes are") {
  SUBCASE("three sheets at one edge") {
    MeshData data;
    data.coordinates = Coordinates(3, 0);
    for (const Vec3& p :
         {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-1, -1, 0)}) {
      data.coordinates.push_xyz(p);
    }
    for (const Index k : {2, 3, 4}) add_triangle(data, 0, 1, k);
    CHECK(says(refusal(data), "the edge between nodes 0 and 1 is shared by 3 elements"));
  }
  SUBCASE("two closed surfaces that touch in one node") {
    MeshData data = skin(cube(2, Volumes::hexahedra));
    const MeshData other = data;
    const Index count = data.node_count();
    // The corner of the second with the least coordinates is that of the first with the greatest.
    const auto place = [&](Index i) -> Vec3 { return other.coordinates.xyz(i) + Vec3::Ones(); };
    std::vector<Index> moved;
    for (Index i = 0; i < count; ++i) {
      Index node = -1;
      for (Index k = 0; k < count; ++k)
        if (other.coordinates.xyz(k) == place(i)) node = k;
      if (node < 0) {
        node = data.node_count();
        data.coordinates.push_xyz(place(i));
      }
      moved.push_back(node);
    }
    for (Index e = 0; e < other.element_count(); ++e) {
      std::vector<Index> corners;
      for (const Index i : other.element(e)) corners.push_back(moved[at(i)]);
      data.add_element(other.types[at(e)], corners);
    }
    const MeshError error = refusal(data);
    CHECK(error.entity() == MeshEntity::node);
    CHECK(data.coordinates.xyz(error.index()) == Vec3::Ones());
    CHECK(says(error, "two separate stars"));
  }
  SUBCASE("an element on one line of space") {
    MeshData data = lifted(square(2, Cells::quads), paraboloid);
    const auto corners = data.element(0);
    for (std::size_t k = 0; k < 4; ++k) {
      data.coordinates.set_xyz(corners[k], (0.1 + static_cast<double>(k)) * Vec3(1, 2, -3));
    }
    const MeshError error = refusal(data);
    CHECK(error.index() == 0);
    CHECK(says(error, "no area"));
  }
  SUBCASE("two nodes that differ in nothing") {
    MeshData data = lifted(square(3, Cells::quads), paraboloid);
    data.coordinates.set_xyz(5, data.coordinates.xyz(6));
    CHECK(says(refusal(data), "duplicate"));
  }
  SUBCASE("two nodes one above the other pass") {
    MeshData data = lifted(square(3, Cells::quads), paraboloid);
    data.coordinates.set_xyz(5, data.coordinates.xyz(6) + Vec3(0, 0, 0.01));
    CHECK_NOTHROW(make_mesh(data));
  }
  SUBCASE("a hanging node, and one that only seems to hang from above") {
    // Two squares side by side, that on the right cut in two: its middle node hangs.
    const auto mesh = [](double z) {
      MeshData data;
      data.coordinates = Coordinates(3, 0);
      for (const Vec3& p :
           {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(1, 0.5, z),
            Vec3(2, 0, 0), Vec3(2, 0.5, 0), Vec3(2, 1, 0), Vec3(0, -1, 0), Vec3(1, -1, 0),
            Vec3(2, -1, 0), Vec3(0, 2, 0), Vec3(1, 2, 0), Vec3(2, 2, 0)}) {
        data.coordinates.push_xyz(p);
      }
      add_quad(data, 0, 1, 2, 3);
      add_quad(data, 1, 5, 6, 4);
      add_quad(data, 4, 6, 7, 2);
      add_quad(data, 8, 9, 1, 0);
      add_quad(data, 9, 10, 5, 1);
      add_quad(data, 3, 2, 12, 11);
      add_quad(data, 2, 7, 13, 12);
      return data;
    };
    const MeshError error = refusal(mesh(0));
    CHECK(error.index() == 4);
    CHECK(says(error, "hanging"));
    CHECK_NOTHROW(make_mesh(mesh(0.1)));
  }
}

TEST_CASE("what is made for plane meshes refuses a surface mesh") {
  const Mesh mesh = make_mesh(lifted(square(3, Cells::quads), paraboloid));
  CHECK_THROWS_WITH_AS(require_plane(*mesh.topology, "layers"),
                       "layers: only for a plane mesh, and this is a surface mesh", UsageError);
  CHECK_THROWS_AS(bounds(mesh), UsageError);
}
