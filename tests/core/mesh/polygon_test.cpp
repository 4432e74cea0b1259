#include "core/mesh/polygon.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/command/command.h"
#include "support/polygon_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<Vec2> regular_polygon(int n) {
  std::vector<Vec2> places;
  for (int k = 0; k < n; ++k)
    places.emplace_back(std::cos(2 * pi * k / n), std::sin(2 * pi * k / n));
  return places;
}

double area_of(std::span<const Vec2> p) {
  double sum = 0;
  for (std::size_t k = 0; k < p.size(); ++k) sum += 0.5 * cross(p[k], p[(k + 1) % p.size()]);
  return sum;
}

/// Whether p lies inside a polygon: crossings of a ray to the right.
bool is_inside(std::span<const Vec2> polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

MoveCommand turn(const std::string& marker, double degrees) {
  MoveCommand move;
  move.bodies[0].markers = {marker};
  move.bodies[0].motion.rotate = degrees;
  return move;
}

/// The largest distance between a mesh and the one that comes back from a turn, over the way out.
double return_error(const Mesh& mesh, double degrees) {
  const CommandResult there = execute(turn("hole", degrees), make_state(mesh));
  CHECK(there.smooth.converged);
  CHECK(there.smooth.inverted == 0);
  CHECK(check_validity(*mesh.topology, there.state.mesh.coordinates).inverted == 0);
  const CommandResult back = execute(turn("hole", -degrees), there.state);
  CHECK(back.smooth.converged);
  CHECK(back.smooth.inverted == 0);
  const double way = largest_difference(there.state.mesh.coordinates, mesh.coordinates);
  CHECK(way > 0.01);
  return largest_difference(back.state.mesh.coordinates, mesh.coordinates) / way;
}

std::string message_of(const MeshData& data) { return refusal(data).what(); }

}  // namespace

TEST_CASE("a regular polygon has a triangle at each corner, whatever their number") {
  for (const int n : {3, 4, 5, 6, 12, 31, 40, 100}) {
    CAPTURE(n);
    const PolygonShape made(corners_of_polygon(regular_polygon(n)));
    const ElementShape& shape = made.shape();
    CHECK(shape.real_corners == n);
    CHECK(shape.corner_triangles.size() == at(n));
    CHECK(shape.edges.size() == at(n));
    CHECK(regular_angle(shape) == doctest::Approx(pi - 2 * pi / n));
    for (std::size_t k = 0; k < shape.side_edges.size(); ++k)
      CHECK(shape.side_edges[k] == std::array<Index, 2>{1, 1});
    // Area of the regular polygon with unit edges, by its corners on a circle.
    const double edge = 2 * std::sin(pi / n);
    CHECK(regular_area(shape) ==
          doctest::Approx(area_of(regular_polygon(n)) / (edge * edge) * 4 / std::sqrt(3.0)));
  }
}

TEST_CASE("flat corners have no triangle, but for those between flat ones") {
  //  5   4   3
  //  6       2     6 and 2 are corners of a square whose lower side is in four parts
  //  7 8 9 0 1
  const std::vector<Vec2> places{{3, 0}, {4, 0}, {4, 2}, {4, 4}, {2, 4},
                                 {0, 4}, {0, 2}, {0, 0}, {1, 0}, {2, 0}};
  const PolygonShape made(corners_of_polygon(places));
  const ElementShape& shape = made.shape();
  CHECK(shape.real_corners == 4);
  std::vector<Index> real;
  for (const auto& triangle : shape.corner_triangles.first(4)) real.push_back(triangle[0]);
  CHECK(real == std::vector<Index>{1, 3, 5, 7});
  CHECK(shape.side_edges[0] == std::array<Index, 2>{2, 4});
  CHECK(shape.side_edges[3] == std::array<Index, 2>{4, 2});
  // The node in the middle of the lower side would be bound by nothing.
  REQUIRE(shape.corner_triangles.size() == 5);
  CHECK(shape.corner_triangles[4][0] == 9);
  CHECK(shape.corner_triangles[4][1] == 0);
  for (std::size_t k = 0; k < places.size(); ++k)
    CHECK(is_flat_corner(shape, k) ==
          (std::ranges::find(real, static_cast<Index>(k)) == real.end()));
  for (const auto& [a, b, c] : shape.corner_triangles)
    CHECK(cross(places[at(b)] - places[at(a)], places[at(c)] - places[at(a)]) > 0);
}

TEST_CASE("a reflex corner of a simple polygon has no triangle; in a tangled one it has") {
  const std::vector<Vec2> bent{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
  const PolygonCorners of_bent = corners_of_polygon(bent);
  CHECK(is_simple(bent));
  CHECK(of_bent.real == 4);
  const std::vector<Vec2> crossed{{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}};
  CHECK(!is_simple(crossed));
  CHECK(corners_of_polygon(crossed).real == 5);
  // A pentagram has five sharp corners and no inverted one, and is not simple.
  std::vector<Vec2> star;
  for (int k = 0; k < 5; ++k) star.push_back(regular_polygon(5)[at(2 * k % 5)]);
  CHECK(!is_simple(star));
  CHECK(is_simple(regular_polygon(9)));
}

TEST_CASE("a polygon is cut into triangles that cover it once") {
  Random random(4711);
  for (int trial = 0; trial < 200; ++trial) {
    // Star-shaped about the origin; every third one has nodes inside its sides.
    const int n = 4 + trial % 9;
    std::vector<Vec2> places;
    for (int k = 0; k < n; ++k)
      places.push_back(random.uniform(0.3, 1) *
                       Vec2(std::cos(2 * pi * k / n), std::sin(2 * pi * k / n)));
    if (trial % 3 == 0)
      for (std::size_t k = places.size(); k-- > 0;)
        places.insert(places.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                      0.5 * (places[k] + places[(k + 1) % places.size()]));
    REQUIRE(is_simple(places));
    const auto triangles = cut_polygon(places);
    CHECK(triangles.size() == places.size() - 2);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
      const std::array<Vec2, 3> p{places[at(a)], places[at(b)], places[at(c)]};
      CHECK(area_of(p) >= -1e-12);
      sum += std::abs(area_of(p));
      if (area_of(p) > 1e-6) CHECK(is_inside(places, (p[0] + p[1] + p[2]) / 3));
    }
    CHECK(sum == doctest::Approx(area_of(places)));
  }
}

TEST_CASE("a face in space is cut into triangles that all have an area, flat corners or not") {
  // A square, a triangle and a regular hexagon, with nodes in the middle of some sides, turned.
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  const std::vector<std::vector<Vec2>> corners{
      {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{0, 0}, {2, 0}, {1, 9}}, regular_polygon(6)};
  for (const std::vector<Vec2>& polygon : corners)
    for (unsigned split = 0; split < 1U << polygon.size(); ++split) {
      std::vector<Vec3> places;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &p = polygon[k], &next = polygon[(k + 1) % polygon.size()];
        places.emplace_back(turn * Vec3(p.x(), p.y(), 5));
        const Vec2 middle = 0.5 * (p + next);
        if ((split >> k & 1U) != 0) places.emplace_back(turn * Vec3(middle.x(), middle.y(), 5));
      }
      const auto triangles = cut_face(places);
      CHECK(triangles.size() == places.size() - 2);
      const Vec3 normal = turn * Vec3(0, 0, 1);
      double sum = 0;
      for (const auto& [a, b, c] : triangles) {
        const Vec3 p = places[at(a)];
        const double area = 0.5 * normal.dot((places[at(b)] - p).cross(places[at(c)] - p));
        CHECK(area > 0.05);
        sum += area;
      }
      CHECK(sum == doctest::Approx(area_of(polygon)));
    }
  // Concave, and without area.
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}, {1, 0.8, 0}};
  for (const auto& [a, b, c] : cut_face(arrow)) {
    const Vec3 p = arrow[at(a)];
    CHECK((arrow[at(b)] - p).cross(arrow[at(c)] - p).z() > 0);
  }
  CHECK(cut_face(std::vector<Vec3>(6, Vec3(1, 1, 1))).size() == 4);
}

TEST_CASE("the topology of polygons is that of the same elements by their types") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const MeshData data = square_with_hole(10, cells);
    const auto expected = Topology::build(data);
    for (const bool turned : {false, true}) {
      MeshData polygons = as_polygons(data);
      if (turned)
        for (Index e = 0; e < data.element_count(); ++e)
          std::reverse(polygons.element_nodes.begin() + polygons.element_offsets[at(e)],
                       polygons.element_nodes.begin() + polygons.element_offsets[at(e) + 1]);
      const auto topology = Topology::build(polygons);
      CHECK(topology->has_polygons());
      CHECK(topology->reversed_elements() == (turned ? data.element_count() : 0));
      REQUIRE(topology->face_count() == expected->face_count());
      for (Index f = 0; f < expected->face_count(); ++f)
        CHECK(topology->face(f).elements == expected->face(f).elements);
      for (Index node = 0; node < expected->node_count(); ++node) {
        CHECK(std::ranges::equal(topology->neighbours(node), expected->neighbours(node)));
        CHECK(std::ranges::equal(topology->star(node), expected->star(node)));
      }
      const Mesh one{topology, data.coordinates}, other{expected, data.coordinates};
      CHECK(check_validity(*topology, data.coordinates).inverted == 0);
      for (const Metric metric : all_metrics()) {
        const auto values = element_values(one, metric), of_types = element_values(other, metric);
        for (std::size_t e = 0; e < values.size(); ++e)
          CHECK(values[e] == doctest::Approx(of_types[e]));
      }
    }
  }
}

TEST_CASE("elements given as polygons move like the same elements by their types") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const MeshData data = square_with_hole(10, cells);
    const CommandResult by_types = execute(turn("hole", 20), make_state(make_mesh(data)));
    const CommandResult by_corners =
        execute(turn("hole", 20), make_state(make_mesh(as_polygons(data))));
    CHECK(by_corners.smooth.converged);
    CHECK(by_corners.smooth.inverted == 0);
    const Coordinates& a = by_types.state.mesh.coordinates;
    CHECK(largest_difference(a, data.coordinates) > 0.01);
    // A triangle has one term, and three of them as a polygon: the same only where all are equal.
    const double apart = largest_difference(a, by_corners.state.mesh.coordinates);
    CHECK(apart < (cells == Cells::quads ? 1e-9 : 0.02));
  }
}

TEST_CASE("a quadrilateral has the same values with flat corners in its sides") {
  MeshData plain, with_flat;
  for (const Vec2& p : {Vec2(0, 0), Vec2(3, 0.2), Vec2(2.8, 2), Vec2(-0.3, 1.5)}) {
    plain.coordinates.push_xy(p);
    with_flat.coordinates.push_xy(p);
  }
  add_quad(plain, 0, 1, 2, 3);
  for (const auto& [a, b] : {std::pair<Index, Index>{0, 1}, {2, 3}})
    with_flat.coordinates.push_xy(0.5 * (plain.coordinates.xy(a) + plain.coordinates.xy(b)));
  with_flat.add_element(ElementType::polygon, std::array<Index, 6>{0, 4, 1, 2, 5, 3});
  const Mesh one = make_mesh(plain), other = make_mesh(with_flat);
  for (const Metric metric : all_metrics()) {
    CAPTURE(metric_name(metric));
    CHECK(element_value(other, 0, metric) == doctest::Approx(element_value(one, 0, metric)));
  }
  const QualityReport report = measure_quality(other);
  CHECK(report.of(Metric::normalized_jacobian).statistics.avg ==
        doctest::Approx(measure_quality(one).of(Metric::normalized_jacobian).statistics.avg));
}

TEST_CASE("regular polygons have the best values of all metrics") {
  for (const int n : {5, 6, 8}) {
    MeshData data;
    std::vector<Index> corners;
    for (const Vec2& p : regular_polygon(n)) {
      corners.push_back(data.node_count());
      data.coordinates.push_xy(p);
    }
    data.add_element(ElementType::polygon, corners);
    const Mesh mesh = make_mesh(data);
    CAPTURE(n);
    CHECK(element_value(mesh, 0, Metric::aspect_ratio) == doctest::Approx(1));
    CHECK(element_value(mesh, 0, Metric::condition_number) == doctest::Approx(1));
    CHECK(std::abs(element_value(mesh, 0, Metric::skewness)) < 1e-12);
    CHECK(element_value(mesh, 0, Metric::smallest_angle) == doctest::Approx(180 - 360.0 / n));
    CHECK(element_value(mesh, 0, Metric::normalized_jacobian) ==
          doctest::Approx(std::sin(2 * pi / n)));
    CHECK(element_value(mesh, 0, Metric::area) == doctest::Approx(area_of(regular_polygon(n))));
  }
}

TEST_CASE("a polygon is inverted if a corner is, its area is negative, or edges of it cross") {
  const Mesh mesh = make_mesh(quadtree_with_hole(10));
  CHECK(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
  const auto polygon =
      static_cast<Index>(std::ranges::find(mesh.topology->element_types(), ElementType::polygon) -
                         mesh.topology->element_types().begin());
  const ElementShape& shape = mesh.topology->shape(polygon);
  REQUIRE(shape.real_corners == 4);
  REQUIRE(shape.edges.size() == 5);
  const auto corners = mesh.topology->element(polygon);
  // A flat corner may bend either way, and must not cross the other sides.
  std::size_t flat = 0;
  while (!is_flat_corner(shape, flat)) ++flat;
  const Index node = corners[flat];
  const Vec2 place = mesh.coordinates.xy(node);
  const Vec2 inwards = element_centre(mesh, polygon).head<2>() - place;
  for (const double way : {-0.3, 0.3, 1.2}) {
    Coordinates x = mesh.coordinates;
    x.set_xy(node, place + way * inwards);
    CHECK(!is_inverted(*mesh.topology, x, polygon));
  }
  Coordinates x = mesh.coordinates;
  x.set_xy(node, place + 4 * inwards);
  CHECK(is_inverted(*mesh.topology, x, polygon));
}

TEST_CASE("a mesh with hanging nodes, and dual meshes, move there and back") {
  CHECK(return_error(make_mesh(quadtree_with_hole(20)), 20) < 1e-5);
  CHECK(return_error(make_mesh(dual_of(make_mesh(square_with_hole(20, Cells::triangles)))), 20) <
        1e-5);
  Mesh shaken = make_mesh(square_with_hole(20, Cells::triangles));
  Random random(8);
  perturb(shaken, random, 0.2);
  CHECK(return_error(make_mesh(dual_of(shaken)), 15) < 1e-5);
}

TEST_CASE("a chain of flat corners between two polygons stays bound") {
  // Two cells beside a wall and two at the other side; their common side is in five parts.
  MeshData data;
  for (const Vec2& p : {Vec2(0, 0), Vec2(5, 0), Vec2(5, 2), Vec2(0, 2), Vec2(0, 4), Vec2(5, 4)})
    data.coordinates.push_xy(p);
  std::vector<Index> chain;
  for (Index k = 1; k < 5; ++k) {
    chain.push_back(data.node_count());
    data.coordinates.push_xy(Vec2(k, 2));
  }
  std::vector<Index> lower{0, 1, 2}, upper{3};
  lower.insert(lower.end(), chain.rbegin(), chain.rend());
  lower.push_back(3);
  upper.insert(upper.end(), chain.begin(), chain.end());
  upper.insert(upper.end(), {2, 5, 4});
  data.add_element(ElementType::polygon, lower);
  data.add_element(ElementType::polygon, upper);
  const Mesh mesh = make_mesh(data);
  MeshState state = make_state(mesh);
  for (const Index node : chain)
    state.mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + Vec2(0.1, 0.3 - 0.1 * node));
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  const CommandResult result = execute(smooth, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  for (const Index node : chain) {
    const Vec2 place = result.state.mesh.coordinates.xy(node);
    CHECK(std::abs(place.x() - 2.5) < 2.3);
    CHECK(std::abs(place.y() - 2) < 1.5);
  }
}

TEST_CASE("regular targets make a shaken mesh with hanging nodes regular again") {
  const Mesh mesh = make_mesh(quadtree_with_hole(10));
  for (const TargetBlend& blend : {TargetBlend{.element = 1}, TargetBlend{.vcv = 1}}) {
    MeshState state = make_state(mesh);
    Random random(12);
    perturb(state.mesh, random, 0.2);
    SmoothCommand smooth;
    smooth.smooth.targets = blend;
    const CommandResult result = execute(smooth, state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    const double left = largest_difference(result.state.mesh.coordinates, mesh.coordinates);
    CAPTURE(left);
    // VCVs do not know lengths.
    CHECK(left < (blend.element > 0 ? 1e-5 : 0.03));
  }
}

TEST_CASE("automatic targets keep the shape of polygons, rest and keep leave the mesh as it is") {
  Mesh shaken = make_mesh(square_with_hole(10, Cells::triangles));
  Random random(3);
  perturb(shaken, random, 0.2);
  const Mesh mesh = make_mesh(dual_of(shaken));
  for (const TargetBlend& blend :
       {TargetBlend{.automatic = 1}, TargetBlend{.rest = 1}, TargetBlend{.keep = 1}}) {
    SmoothCommand smooth;
    smooth.smooth.targets = blend;
    const CommandResult result = execute(smooth, make_state(mesh));
    CHECK(result.smooth.converged);
    CHECK(largest_difference(result.state.mesh.coordinates, mesh.coordinates) < 1e-9);
  }
}

TEST_CASE("a tangled mesh of polygons is untangled") {
  Mesh mesh = make_mesh(dual_of(make_mesh(square_with_hole(10, Cells::triangles))));
  Random random(21);
  MeshState state = make_state(mesh);
  for (const Index node : mesh.topology->interior_nodes())
    state.mesh.coordinates.set_xy(node, state.mesh.coordinates.xy(node) + 0.12 * random.vector());
  REQUIRE(check_validity(*mesh.topology, state.mesh.coordinates).inverted > 10);
  SmoothCommand smooth;
  const CommandResult result = execute(smooth, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
}

TEST_CASE("polygons with too few or too many corners, and in space, are refused") {
  MeshData data = as_polygons(square(3, Cells::quads));
  data.element_nodes.erase(data.element_nodes.begin(), data.element_nodes.begin() + 2);
  for (std::size_t e = 1; e < data.element_offsets.size(); ++e) data.element_offsets[e] -= 2;
  CHECK(message_of(data) == "element 0, a polygon, has 2 corners, expected 3 to 1000");
  MeshData many;
  std::vector<Index> corners;
  for (const Vec2& p : regular_polygon(1001)) {
    corners.push_back(many.node_count());
    many.coordinates.push_xy(p);
  }
  many.add_element(ElementType::polygon, corners);
  CHECK(message_of(many).find("has 1001 corners, expected 3 to 1000") != std::string::npos);
  MeshData space = dual_of(make_mesh(square(3, Cells::triangles)));
  Coordinates x(3, space.node_count());
  for (Index i = 0; i < space.node_count(); ++i) {
    const Vec2 p = space.coordinates.xy(i);
    x.set_xyz(i, Vec3(p.x(), p.y(), p.x() * p.y()));
  }
  space.coordinates = x;
  CHECK(message_of(space).find("16 of 16 elements are polygons") != std::string::npos);
  CHECK(message_of(space).find("cut its polygons into triangles") != std::string::npos);
}
