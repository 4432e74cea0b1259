#include "core/quality/space_walls.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/quality/mesh_change.h"
#include "core/quality/quality.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A plane mesh extruded to these levels: its markers, and the marker ends. Node i of the plane is
/// node i + k n on level k, element e is element e + k m.
MeshData extruded(const MeshData& plane, const std::vector<double>& levels) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  const Index n = plane.node_count();
  for (const double z : levels)
    for (Index i = 0; i < n; ++i) {
      const Vec2 p = plane.coordinates.xy(i);
      data.coordinates.push_xyz(Vec3(p.x(), p.y(), z));
    }
  const auto layers = static_cast<Index>(levels.size()) - 1;
  for (Index k = 0; k < layers; ++k) {
    for (Index e = 0; e < plane.element_count(); ++e) {
      std::vector<Index> corners;
      for (const Index level : {k, k + 1})
        for (const Index node : plane.element(e)) corners.push_back(node + level * n);
      data.add_element(corners.size() == 6 ? ElementType::prism : ElementType::hexahedron, corners);
    }
  }
  for (const Marker& marker : plane.markers) {
    data.markers.push_back({marker.name, marker.tag, {}});
    for (Index k = 0; k < layers; ++k)
      for (const Face& edge : marker.faces)
        data.markers.back().faces.emplace_back(edge[0] + k * n, edge[1] + k * n,
                                               edge[1] + (k + 1) * n, edge[0] + (k + 1) * n);
  }
  data.markers.push_back({"ends", 99, {}});
  for (const Index level : {Index{0}, layers})
    for (Index e = 0; e < plane.element_count(); ++e) {
      std::vector<Index> corners;
      for (const Index node : plane.element(e)) corners.push_back(node + level * n);
      data.markers.back().faces.emplace_back(std::span<const Index>(corners));
    }
  return data;
}

/// Plane meshes around bodies: lines off the wall that lean, triangles, both kinds of cells, and a
/// body with a concave corner.
std::vector<MeshData> plane_meshes() {
  MeshData corner = grid_with_holes(6, Cells::quads, [](Index i, Index j) {
    return (i == 2 && j == 2) || (i == 3 && j == 2) || (i == 2 && j == 3);
  });
  corner.markers.clear();
  mark_boundary(corner, [](const Vec2& p) {
    return (p - Vec2(0.5, 0.5)).cwiseAbs().maxCoeff() < 0.5 - 1e-9 ? "body" : "far";
  });
  return {ring_grid(60, 6, 0.02, 1.1, 4), annulus(48, 6, 1.05, Cells::triangles),
          annulus(48, 6, 1.05, Cells::mixed), square_with_two_holes(10, Cells::mixed), corner};
}

/// A regular solid: places of its vertices on the unit sphere, and its faces seen from outside
/// counter-clockwise.
struct Solid {
  std::vector<Vec3> vertices;
  std::vector<std::vector<Index>> faces;
};

/// normals: of the faces, the directions in which the outermost vertices are those of a face.
Solid solid_of(std::vector<Vec3> vertices, const std::vector<Vec3>& normals) {
  Solid solid;
  for (Vec3& vertex : vertices) vertex.normalize();
  for (const Vec3& normal : normals) {
    double most = 0;
    for (const Vec3& vertex : vertices) most = std::max(most, vertex.dot(normal));
    std::vector<Index> face;
    for (std::size_t v = 0; v < vertices.size(); ++v)
      if (vertices[v].dot(normal) > most - 1e-9) face.push_back(static_cast<Index>(v));
    const Vec3 u = vertices[at(face[0])].cross(normal).normalized();
    const Vec3 w = normal.normalized().cross(u);
    std::ranges::sort(face, {}, [&](Index v) {
      return std::atan2(vertices[at(v)].dot(w), vertices[at(v)].dot(u));
    });
    solid.faces.push_back(face);
  }
  solid.vertices = vertices;
  return solid;
}

std::vector<Vec3> icosahedron_vertices() {
  std::vector<Vec3> all;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-std::numbers::phi, std::numbers::phi})
      all.insert(all.end(), {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)});
  return all;
}

std::vector<Vec3> dodecahedron_vertices() {
  constexpr double phi = std::numbers::phi;
  std::vector<Vec3> all;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0}) {
      all.insert(all.end(),
                 {Vec3(a / phi, 0, b * phi), Vec3(0, b * phi, a / phi), Vec3(b * phi, a / phi, 0)});
      for (const double c : {-1.0, 1.0}) all.emplace_back(a, b, c);
    }
  return all;
}

std::vector<Vec3> cube_vertices() {
  std::vector<Vec3> all;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      for (const double c : {-1.0, 1.0}) all.emplace_back(a, b, c);
  return all;
}

std::vector<Vec3> axes() {
  std::vector<Vec3> all;
  for (const double a : {-1.0, 1.0})
    all.insert(all.end(), {a * Vec3::UnitX(), a * Vec3::UnitY(), a * Vec3::UnitZ()});
  return all;
}

/// Rows of prisms, hexahedra or polyhedra around a solid of the radius 1: the first row `first`
/// high along the lines from the centre, each next one `growth` times as high.
MeshData layers_around(const Solid& solid, Index rows, double first, double growth) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  const auto n = static_cast<Index>(solid.vertices.size());
  double radius = 1;
  for (Index k = 0; k <= rows; ++k) {
    for (const Vec3& vertex : solid.vertices) data.coordinates.push_xyz(radius * vertex);
    radius += first * std::pow(growth, k);
  }
  for (Index k = 0; k < rows; ++k)
    for (const std::vector<Index>& face : solid.faces) {
      std::vector<Index> below, above;
      for (const Index v : face) {
        below.push_back(v + k * n);
        above.push_back(v + (k + 1) * n);
      }
      std::vector<Index> corners = below;
      corners.insert(corners.end(), above.begin(), above.end());
      if (face.size() <= 4) {
        data.add_element(face.size() == 3 ? ElementType::prism : ElementType::hexahedron, corners);
        continue;
      }
      std::vector<Face> faces{Face(std::span<const Index>(below)).reversed(),
                              Face(std::span<const Index>(above))};
      for (std::size_t i = 0; i < face.size(); ++i) {
        const std::size_t j = (i + 1) % face.size();
        faces.emplace_back(below[i], below[j], above[j], above[i]);
      }
      data.add_polyhedron(corners, faces);
    }
  mark_volume(data, [&](const Vec3& p) { return p.norm() < 1 ? "body" : "far"; });
  return data;
}

std::vector<Solid> solids() {
  return {solid_of(icosahedron_vertices(), dodecahedron_vertices()),
          solid_of(cube_vertices(), axes()),
          solid_of(dodecahedron_vertices(), icosahedron_vertices())};
}

std::vector<double> sorted(std::vector<double> values) {
  std::ranges::sort(values);
  return values;
}

/// Also where both are NaN.
void check_equal(double a, double b, double tolerance) {
  REQUIRE(std::isnan(a) == std::isnan(b));
  if (!std::isnan(a)) CHECK(a == doctest::Approx(b).epsilon(tolerance).scale(1e-6));
}

/// Distance from an axis-parallel box.
double box_distance(const Vec3& p, const Vec3& low, const Vec3& high) {
  return (p - p.cwiseMax(low).cwiseMin(high)).norm();
}

}  // namespace

TEST_CASE("an extruded mesh has the heights, tilts and growth of the plane mesh") {
  for (const MeshData& data : plane_meshes()) {
    const Mesh plane = make_mesh(data);
    const auto walls = find_walls(plane);
    for (const std::vector<double>& levels : {std::vector{0.0, 0.7}, std::vector{0.0, 0.3, 1.2}}) {
      const Mesh mesh = make_mesh(extruded(data, levels));
      const Index n = plane.topology->node_count();
      const auto in_space = find_walls(mesh);
      REQUIRE(in_space.size() == walls.size());
      for (const Wall& wall : walls) {
        const auto same = std::ranges::find(in_space, wall.markers, &Wall::markers);
        REQUIRE(same != in_space.end());
        REQUIRE(same->nodes.size() == levels.size() * wall.nodes.size());
        const auto heights = first_heights(plane, wall), tilts = first_edge_tilts(plane, wall);
        const auto all_heights = first_heights(mesh, *same);
        const auto all_tilts = first_edge_tilts(mesh, *same);
        for (std::size_t i = 0; i < wall.nodes.size(); ++i)
          for (std::size_t k = 0; k < levels.size(); ++k) {
            const Index number = number_on_wall(*same, wall.nodes[i] + static_cast<Index>(k) * n);
            REQUIRE(number >= 0);
            check_equal(all_heights[at(number)], heights[i], 1e-9);
            REQUIRE(std::isnan(all_tilts[at(number)]) == std::isnan(tilts[i]));
            if (!std::isnan(tilts[i])) CHECK(std::abs(all_tilts[at(number)] - tilts[i]) < 1e-5);
          }
        std::vector<double> growth;
        for (std::size_t k = 0; k + 1 < levels.size(); ++k)
          for (const double ratio : values_of(column_growth(plane, wall))) growth.push_back(ratio);
        growth = sorted(growth);
        const auto of_space = sorted(values_of(column_growth(mesh, *same)));
        REQUIRE(of_space.size() == growth.size());
        for (std::size_t i = 0; i < growth.size(); ++i) check_equal(of_space[i], growth[i], 1e-9);
      }
    }
  }
}

TEST_CASE("elements of an extruded mesh have the values of those of the plane mesh") {
  for (const MeshData& data : plane_meshes()) {
    const Mesh plane = make_mesh(data);
    const Mesh mesh = make_mesh(extruded(data, {0, 0.4, 0.8}));
    Mesh plane_after = plane, after = mesh;
    Random random(3);
    const Index n = plane.topology->node_count();
    for (const Index node : plane.topology->interior_nodes()) {
      const Vec2 shift = 0.002 * random.vector();
      plane_after.coordinates.set_xy(node, plane.coordinates.xy(node) + shift);
      for (Index k = 0; k < 3; ++k)
        after.coordinates.set_xyz(
            node + k * n, mesh.coordinates.xyz(node + k * n) + Vec3(shift.x(), shift.y(), 0));
    }
    for (const WallField field : all_wall_fields()) {
      CAPTURE(wall_field_info(field).name);
      const auto wanted = element_values(plane_after, field, &plane.coordinates);
      const auto values = element_values(after, field, &mesh.coordinates);
      REQUIRE(values.size() == 2 * wanted.size());
      for (std::size_t e = 0; e < values.size(); ++e) {
        const double value = wanted[e % wanted.size()];
        const double power = field == WallField::size_ratio ? 2.0 / 3 : 1;
        check_equal(values[e], std::pow(value, power), 1e-6);
      }
    }
  }
}

TEST_CASE("layers of prisms, hexahedra and polyhedra have the heights that they were made with") {
  for (const Solid& solid : solids()) {
    const double first = 0.03, growth = 1.25;
    const MeshData data = layers_around(solid, 6, first, growth);
    const Mesh mesh = make_mesh(data);
    const WallReport report = measure_walls(mesh);
    REQUIRE(report.walls.size() == 1);
    const WallMeasures& wall = report.walls[0];
    CHECK(wall.wall.markers == std::vector<std::string>{"body"});
    CHECK(report.node_count() == static_cast<Index>(solid.vertices.size()));
    CHECK(wall.wall.faces.size() == solid.faces.size());
    for (const double height : wall.first_height) CHECK(height == doctest::Approx(first));
    for (const double tilt : wall.tilt) CHECK(std::abs(tilt) < 1e-5);
    const double edge =
        (solid.vertices[at(solid.faces[0][1])] - solid.vertices[at(solid.faces[0][0])]).norm();
    for (const double spacing : wall.spacing) CHECK(spacing == doctest::Approx(edge));
    CHECK(report.growth.count == 5 * solid.faces.size());
    CHECK(report.growth.min == doctest::Approx(growth));
    CHECK(report.growth.max == doctest::Approx(growth));
    const auto heights = element_values(mesh, WallField::first_height);
    for (std::size_t e = 0; e < heights.size(); ++e) {
      REQUIRE(std::isnan(heights[e]) == (e >= solid.faces.size()));
      if (e < solid.faces.size()) CHECK(heights[e] == doctest::Approx(first));
    }
  }
}

TEST_CASE("cells given by their faces are measured like those of a type") {
  for (const MeshData& data :
       {layers_around(solids()[0], 5, 0.04, 1.2), layers_around(solids()[1], 5, 0.04, 1.2),
        cube_with_cavity(6, Volumes::mixed)}) {
    Mesh mesh = make_mesh(data), polyhedra = make_mesh(as_polyhedra(data));
    Random random(5);
    for (const Index node : mesh.topology->interior_nodes()) {
      const Vec3 place = mesh.coordinates.xyz(node) + 0.01 * random_vector(random);
      mesh.coordinates.set_xyz(node, place);
      polyhedra.coordinates.set_xyz(node, place);
    }
    const WallReport a = measure_walls(mesh), b = measure_walls(polyhedra);
    REQUIRE(a.walls.size() == 1);
    REQUIRE(b.walls.size() == 1);
    CHECK(a.walls[0].wall.nodes == b.walls[0].wall.nodes);
    for (std::size_t i = 0; i < a.walls[0].first_height.size(); ++i) {
      CHECK(a.walls[0].first_height[i] == doctest::Approx(b.walls[0].first_height[i]));
      CHECK(a.walls[0].tilt[i] == doctest::Approx(b.walls[0].tilt[i]));
    }
    CHECK(a.growth.count == b.growth.count);
    for (const auto place : {&Quantiles::min, &Quantiles::median, &Quantiles::max}) {
      CHECK(a.growth.*place == doctest::Approx(b.growth.*place));
      CHECK(a.size_ratio.*place == doctest::Approx(b.size_ratio.*place));
    }
  }
}

TEST_CASE("heights of tetrahedra and pyramids are those of the apexes over their wall faces") {
  const double low = 1.0 / 3, high = 2.0 / 3;
  Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  Random random(11);
  for (const Index node : mesh.topology->interior_nodes())
    mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 0.02 * random_vector(random));
  const Wall wall = find_walls(mesh).front();
  const auto heights = first_heights(mesh, wall);
  const Coordinates& x = mesh.coordinates;
  std::map<Index, Vec2> sums;  // by node: of heights and of weights
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto nodes = mesh.topology->element(e);
    for (std::size_t apex = 0; apex < 4; ++apex) {
      std::vector<Index> face(nodes.begin(), nodes.end());
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(apex));
      const auto f = mesh.topology->find_face(Face(face[0], face[1], face[2]));
      if (mesh.topology->face(*f).elements[1] >= 0 || number_on_wall(wall, face[0]) < 0) continue;
      const double height =
          box_distance(x.xyz(nodes[apex]), Vec3::Constant(low), Vec3::Constant(high));
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = x.xyz(face[(k + 1) % 3]) - x.xyz(face[k]);
        const Vec3 b = x.xyz(face[(k + 2) % 3]) - x.xyz(face[k]);
        const double angle = std::acos(a.dot(b) / a.norm() / b.norm());
        const auto place = sums.try_emplace(face[k], Vec2::Zero()).first;
        place->second += angle * Vec2(height, 1);
      }
    }
  }
  REQUIRE(sums.size() == wall.nodes.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const Vec2& sum = sums.at(wall.nodes[i]);
    CHECK(heights[i] == doctest::Approx(sum[0] / sum[1]));
  }
  const Mesh pyramids = make_mesh(cube_with_cavity(6, Volumes::pyramids));
  for (const double height : first_heights(pyramids, find_walls(pyramids).front()))
    CHECK(height == doctest::Approx(1.0 / 12));
  CHECK(measure_walls(pyramids).growth.count == 0);
}

TEST_CASE("walls in space are bodies, also on planes of symmetry, each with its markers") {
  const Mesh half = make_mesh(box_with_body_on_two_planes(6, Volumes::hexahedra));
  const auto walls = find_walls(half);
  REQUIRE(walls.size() == 1);
  CHECK(walls[0].markers == std::vector<std::string>{"body"});
  for (const double height : first_heights(half, walls[0]))
    CHECK(height == doctest::Approx(1.0 / 6));

  MeshData data = cubes_with_holes(7, Volumes::mixed, [](Index i, Index j, Index k) {
    return j == 3 && k == 3 && (i == 1 || i == 5);
  });
  mark_volume(data, [](const Vec3& p) -> std::string {
    const bool far = (p.array() < 1e-9).any() || (p.array() > 1 - 1e-9).any();
    return far ? "far" : p.x() < 0.5 ? "left" : p.z() > 0.5 ? "right_top" : "right_bottom";
  });
  const Mesh two = make_mesh(data);
  const auto bodies = find_walls(two);
  REQUIRE(bodies.size() == 2);
  std::vector<std::vector<std::string>> markers{bodies[0].markers, bodies[1].markers};
  std::ranges::sort(markers, {}, &std::vector<std::string>::size);
  CHECK(markers[0] == std::vector<std::string>{"left"});
  CHECK(markers[1].size() == 2);
  for (const Wall& wall : bodies) CHECK(wall.nodes.size() == 8);
}

TEST_CASE("a volume without bodies has no walls, a surface mesh is refused") {
  const Mesh solid = make_mesh(cube(4, Volumes::mixed));
  const WallReport report = measure_walls(solid);
  CHECK(report.walls.empty());
  CHECK(report.first_height.count == 0);
  CHECK(report.size_ratio.count > 0);
  for (const double v : element_values(solid, WallField::first_height)) CHECK(std::isnan(v));
  CHECK(find_damage(solid, solid).text.empty());
  const Mesh surface = make_mesh(skin(cube(2, Volumes::hexahedra)));
  CHECK_THROWS_AS(find_walls(surface), UsageError);
}

TEST_CASE("damage in space names the wall node whose height has changed, and its place") {
  for (const Solid& solid : solids()) {
    const Mesh before = make_mesh(layers_around(solid, 6, 0.03, 1.25));
    const auto n = static_cast<Index>(solid.vertices.size());
    const Index node = 5;
    Mesh after = before;
    CHECK(find_damage(before, after).text.empty());
    after.coordinates.set_xyz(node + n, 1.021 * before.coordinates.xyz(node));
    const Damage damage = find_damage(before, after);
    CHECK(damage.node == node);
    CHECK(damage.stretched);
    CAPTURE(damage.text);
    CHECK(damage.text.starts_with("first heights changed by more than 5 %"));
    CHECK(damage.text.find("at worst to 0.7 times what they were at " +
                           place_text(before.coordinates.xyz(node))) != std::string::npos);
    const auto change =
        compare_first_heights(measure_walls(before).walls, measure_walls(after).walls);
    REQUIRE(change);
    CHECK(change->worst_node == node);
    CHECK(change->worst_ratio == doctest::Approx(0.7));
    CHECK(change->off == doctest::Approx(1.0 / n));
    CHECK(spoils_walls(*change));
    // By less than a fifth at one node of few: not more than a twentieth of them.
    after.coordinates.set_xyz(node + n, 1.0275 * before.coordinates.xyz(node));
    CHECK(find_damage(before, after).text.empty() == (n >= 20));
    const auto ratios = element_values(after, WallField::first_height_ratio, &before.coordinates);
    Index with_node = 0;
    for (std::size_t e = 0; e < ratios.size(); ++e) {
      if (std::isnan(ratios[e])) continue;
      const auto corners = before.topology->element(static_cast<Index>(e));
      const bool has = std::ranges::find(corners, node) != corners.end();
      CHECK(ratios[e] == doctest::Approx(has ? 0.0275 / 0.03 : 1).epsilon(1e-6));
      with_node += has ? 1 : 0;
    }
    CHECK(with_node >= 3);
  }
}

TEST_CASE("a report of a volume mesh lists the worst elements by the fields of walls") {
  const Mesh before = make_mesh(layers_around(solids()[0], 6, 0.03, 1.25));
  Mesh after = before;
  after.coordinates.set_xyz(12 + 3, 1.02 * before.coordinates.xyz(3));
  QualityOptions options;
  options.before = &before.coordinates;
  const QualityReport report = measure_quality(after, options);
  REQUIRE(report.has_walls());
  CHECK(report.walls.node_count() == 12);
  for (const WallField field : {WallField::first_height, WallField::first_height_ratio}) {
    const auto& worst = report.worst_by(field);
    REQUIRE(worst.size() == 10);
    const auto corners = after.topology->element(worst[0].element);
    CHECK(std::ranges::find(corners, 3) != corners.end());
    CHECK(worst[0].centre == element_centre(after, worst[0].element));
  }
  options.before = nullptr;
  CHECK(measure_quality(after, options).worst_by(WallField::first_height_ratio).empty());
}
