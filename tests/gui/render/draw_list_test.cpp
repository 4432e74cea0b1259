#include "gui/render/draw_list.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "support/meshes.h"

using namespace winslow;
using namespace winslow::gui;

namespace {

double drawn_area(const DrawList& list) {
  double area = 0;
  for (std::size_t k = 0; k < list.triangles.size(); k += 3) {
    const auto corner = [&](std::size_t i) {
      const std::size_t v = 2 * list.triangles[k + i];
      return Vec2(list.positions[v], list.positions[v + 1]);
    };
    area += 0.5 * std::abs(twice_area(corner(0), corner(1), corner(2)));
  }
  return area;
}

Mesh one_quad(const std::array<Vec2, 4>& corners) {
  MeshData data;
  for (const Vec2& p : corners) data.coordinates.push_xy(p);
  test::add_quad(data, 0, 1, 2, 3);
  return {Topology::build(data), data.coordinates};
}

}  // namespace

TEST_CASE("A whole list has every element, edge and marker edge once") {
  for (const auto cells : {test::Cells::triangles, test::Cells::quads, test::Cells::mixed}) {
    CAPTURE(test::name_of(cells));
    const Mesh mesh = make_mesh(test::square_with_hole(10, cells));
    const EdgeGroups groups = group_edges(*mesh.topology);
    const DrawList list = whole_draw_list(*mesh.topology, groups, mesh.coordinates, Vec2(0.5, 0.5));
    CHECK(drawn_area(list) == doctest::Approx(0.96).epsilon(1e-5));
    CHECK(list.triangle_element.size() == list.triangles.size() / 3);
    CHECK(list.markers.size() == 2);
    CHECK(list.boundary.count == 0);
    CHECK(list.interior.count + list.markers[0].count + list.markers[1].count ==
          mesh.topology->edges().size());
    CHECK(list.lines.size() == 2 * mesh.topology->edges().size());
    CHECK(list.line_spacing.size() == mesh.topology->edges().size());
    CHECK(list.inverted_triangles.empty());
  }
}

TEST_CASE("Boundary edges without a marker are a group of their own") {
  MeshData data = test::square(4, test::Cells::quads);
  data.markers.resize(1);
  const Mesh mesh = make_mesh(data);
  const EdgeGroups groups = group_edges(*mesh.topology);
  CHECK(groups.unmarked_boundary.size() == 12);
  CHECK(groups.interior.size() == 24);
}

TEST_CASE("The spacing of lines is the height of the cells, whatever their length") {
  // One row of ten cells, 1 long and 0.01 high each.
  MeshData data;
  for (Index j = 0; j <= 10; ++j) {
    data.coordinates.push_xy({0, 0.01 * j});
    data.coordinates.push_xy({1, 0.01 * j});
  }
  for (Index j = 0; j < 10; ++j) test::add_quad(data, 2 * j, 2 * j + 1, 2 * j + 3, 2 * j + 2);
  const Mesh mesh = make_mesh(data);
  const EdgeGroups groups = group_edges(*mesh.topology);
  const DrawList list = whole_draw_list(*mesh.topology, groups, mesh.coordinates, Vec2(0, 0));
  REQUIRE(list.interior.count == 9);
  for (std::size_t k = 0; k < 9; ++k) CHECK(list.line_spacing[k] == doctest::Approx(0.01));
}

TEST_CASE(
    "Interior lines come with the widest spaced first, and can be counted from a spacing on") {
  const Mesh mesh = make_mesh(test::annulus(32, 20, 1.3, test::Cells::triangles));
  const EdgeGroups groups = group_edges(*mesh.topology);
  const DrawList list = whole_draw_list(*mesh.topology, groups, mesh.coordinates, Vec2(0, 0));
  REQUIRE(list.interior.first == 0);
  const auto first = list.line_spacing.begin();
  const auto last = first + static_cast<std::ptrdiff_t>(list.interior.count);
  for (auto it = first; it + 1 < last; ++it) CHECK(*it > *(it + 1) / 1.126f);
  for (const float spacing : {0.0f, 0.1f, 1.0f, 10.0f, 1e9f}) {
    CAPTURE(spacing);
    const std::size_t counted = lines_spaced(list, spacing);
    const auto wanted = std::count_if(first, last, [&](float s) { return s >= spacing; });
    CHECK(counted >= static_cast<std::size_t>(wanted));
    for (std::size_t k = 0; k < list.interior.count; ++k) {
      if (list.line_spacing[k] >= spacing) CHECK(k < counted);
      if (k < counted) CHECK(list.line_spacing[k] > spacing / 1.126f);
    }
  }
  CHECK(lines_spaced(list, 0) == list.interior.count);
  CHECK(lines_spaced(list, 1e9f) == 0);
}

TEST_CASE("A quadrilateral with a corner turned in is cut from that corner") {
  const auto simple = one_quad({Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)});
  CHECK_FALSE(is_inverted(simple.coordinates, simple.topology->element(0)));
  for (int k = 0; k < 4; ++k) {
    CAPTURE(k);
    std::array<Vec2, 4> corners{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};
    corners[static_cast<std::size_t>(k)] =
        Vec2(0.5, 0.5) + 0.2 * (Vec2(0.5, 0.5) - corners[static_cast<std::size_t>(k)]);
    const Mesh mesh = one_quad(corners);
    CHECK(is_inverted(mesh.coordinates, mesh.topology->element(0)));
    const auto list =
        whole_draw_list(*mesh.topology, group_edges(*mesh.topology), mesh.coordinates, Vec2(0, 0));
    // The arrowhead: half of the square less the triangle that the corner cuts away.
    CHECK(drawn_area(list) == doctest::Approx(0.4).epsilon(1e-5));
    CHECK(list.inverted_triangles.size() == 6);
    CHECK(list.inverted_lines.size() == 8);
  }
}

TEST_CASE("Cutting to a box keeps exactly what lies in it") {
  for (const auto cells : {test::Cells::triangles, test::Cells::quads, test::Cells::mixed}) {
    CAPTURE(test::name_of(cells));
    const Mesh mesh = make_mesh(test::square(10, cells));
    const EdgeGroups groups = group_edges(*mesh.topology);
    const Bounds inside{{0.33, 0.41}, {0.77, 0.58}};
    const DrawList list = clipped_draw_list(*mesh.topology, groups, mesh.coordinates, inside);
    CHECK((list.origin.head<2>() - inside.centre()).norm() == 0);
    CHECK(drawn_area(list) == doctest::Approx(0.44 * 0.17).epsilon(1e-4));
    for (std::size_t v = 0; v < list.positions.size(); v += 2) {
      CHECK(std::abs(list.positions[v]) <= 0.2200001f);
      CHECK(std::abs(list.positions[v + 1]) <= 0.0850001f);
    }
    for (const auto& range : list.markers) CHECK(range.count == 0);
    const auto nodes = std::ranges::count_if(list.node_spacing, [](float s) { return s > 0; });
    CHECK(nodes == 4);  // x 0.4 to 0.7, y 0.5
    const Bounds around{{-1, -1}, {2, 2}};
    const DrawList all = clipped_draw_list(*mesh.topology, groups, mesh.coordinates, around);
    CHECK(drawn_area(all) == doctest::Approx(1).epsilon(1e-5));
    CHECK(all.lines.size() == 2 * mesh.topology->edges().size());
  }
}

TEST_CASE("A box of a billionth of the mesh is cut without round-off") {
  const Mesh mesh = make_mesh(test::square(1, test::Cells::triangles));
  const EdgeGroups groups = group_edges(*mesh.topology);
  const double half = 1e-9;
  const Vec2 on_diagonal(0.3, 0.3);
  const Vec2 corner(half, half);
  const DrawList list = clipped_draw_list(*mesh.topology, groups, mesh.coordinates,
                                          {on_diagonal - corner, on_diagonal + corner});
  REQUIRE(list.interior.count == 1);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t v = 2 * list.lines[k];
    CHECK(std::abs(list.positions[v] - list.positions[v + 1]) < 1e-6 * half);
    CHECK(std::abs(list.positions[v]) == doctest::Approx(half).epsilon(1e-5));
  }
}
