#include "core/inspect/space/plane_section.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <vector>

#include "core/error.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// Sum of the polygons' areas, each as seen from the front of the plane.
double area_of(const PlaneSection& section, const Plane& plane) {
  double area = 0;
  for (Index k = 0; k < section.polygons.rows(); ++k) {
    const auto corners = section.polygons[k];
    const Vec3 first = section.points[at(corners[0])];
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      area += 0.5 * plane.normal().dot((section.points[at(corners[i])] - first)
                                           .cross(section.points[at(corners[i + 1])] - first));
    }
  }
  return area;
}

/// Area of the section of the unit cube, from its volume below the plane: the derivative of
/// sum over the corners of (-1)^k max(0, d - n.c)^3 / (6 n1 n2 n3).
double cube_section(const Plane& plane) {
  const Vec3 n = plane.normal();
  const double d = n.dot(plane.point());
  double sum = 0;
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double z : {0.0, 1.0}) {
        const double sign = std::lround(x + y + z) % 2 == 0 ? 1 : -1;
        const double reach = std::max(0.0, d - n.dot(Vec3(x, y, z)));
        sum += sign * reach * reach / 2;
      }
  return sum / (n.x() * n.y() * n.z());
}

/// Every side of a polygon is the side of another the other way round, or lies in the boundary of
/// the unit cube.
void check_tiling(const PlaneSection& section, bool outline_in_cube) {
  std::map<std::pair<Index, Index>, int> sides;
  for (Index k = 0; k < section.polygons.rows(); ++k) {
    const auto corners = section.polygons[k];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      a < b ? ++sides[{a, b}] : --sides[{b, a}];
    }
  }
  int open = 0;
  for (const auto& [side, count] : sides) {
    if (count == 0) continue;
    ++open;
    CHECK(std::abs(count) == 1);
    const Vec3 middle = 0.5 * (section.points[at(side.first)] + section.points[at(side.second)]);
    if (outline_in_cube) CHECK((middle - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9);
  }
  CHECK(open > 2);
}

/// Moves what is not on the boundary of the unit cube.
void shake(Mesh& mesh, Random& random, double by) {
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec3 shift(random.uniform(-by, by), random.uniform(-by, by), random.uniform(-by, by));
    mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + shift);
  }
}

}  // namespace

TEST_CASE("The section of a cube has the area that its volume's derivative says, without gaps") {
  Random random(11);
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Mesh mesh = make_mesh(cube(4, volumes));
    for (int k = 0; k < 20; ++k) {
      if (k == 10)
        shake(mesh, random, 0.1);  // faces of hexahedra are no longer plane, some cells inverted
      const Vec3 point(random.uniform(0.2, 0.8), random.uniform(0.2, 0.8),
                       random.uniform(0.2, 0.8));
      const Vec3 normal(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
      const Plane plane(point, normal);
      const PlaneSection section = plane_section(mesh, plane);
      CHECK(area_of(section, plane) == doctest::Approx(cube_section(plane)).epsilon(1e-9));
      for (const Vec3& p : section.points) CHECK(std::abs(plane.distance(p)) < 1e-12);
      check_tiling(section, true);
    }
  }
}

TEST_CASE("A plane along faces of elements shows each place once, at either end of the mesh, too") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    for (const double z : {0.0, 0.25, 0.5, 1.0}) {
      for (const double way : {1.0, -1.0}) {
        const Plane plane({0.3, 0.3, z + 1e-14}, {0, 0, way});
        const PlaneSection section = plane_section(mesh, plane);
        CHECK(area_of(section, plane) == doctest::Approx(1));
        check_tiling(section, true);
      }
    }
    CHECK(plane_section(mesh, Plane({0, 0, 1.1}, {0, 0, 1})).elements.empty());
  }
}

TEST_CASE("nodes a little off the plane change neither the polygons of a section nor its area") {
  // The plane bounds the body, a cube of 1/6, which lies behind it.
  std::vector<std::pair<MeshData, double>> meshes{{split_box_with_body(6), 1 - 1.0 / 36}};
  for (const Volumes volumes : all_volumes) meshes.emplace_back(cube(6, volumes), 1.0);
  meshes.emplace_back(as_polyhedra(cube(6, Volumes::hexahedra)), 1.0);
  const Plane plane({0.5, 0.5, 0.5}, {0, 0, -1});
  for (const auto& [data, area] : meshes) {
    const Mesh exact = make_mesh(data);
    const PlaneSection expected = plane_section(exact, plane);
    CHECK(area_of(expected, plane) == doctest::Approx(area).epsilon(1e-12));
    for (const double off : {1e-12, 1e-9, 1e-7, 5e-5}) {
      CAPTURE(off);
      Mesh mesh = exact;
      Random random(3);
      for (Index node = 0; node < mesh.coordinates.size(); ++node) {
        Vec3 p = mesh.coordinates.xyz(node);
        if (std::abs(p.z() - 0.5) > 1e-9) continue;
        p.z() += random.index(2) == 0 ? off : -off;
        mesh.coordinates.set_xyz(node, p);
      }
      const SectionIndex index(mesh);
      for (const SectionIndex* used : {static_cast<const SectionIndex*>(nullptr), &index}) {
        const PlaneSection section = plane_section(mesh, plane, used);
        CHECK(area_of(section, plane) == doctest::Approx(area).epsilon(1e-6));
        CHECK(section.points.size() == expected.points.size());
        CHECK(section.polygons.values.size() == expected.polygons.values.size());
        std::vector<Index> met = section.elements, of_exact = expected.elements;
        std::ranges::sort(met);
        std::ranges::sort(of_exact);
        CHECK(met == of_exact);
        check_tiling(section, false);
        for (const Vec3& p : section.points) CHECK(std::abs(plane.distance(p)) < 1e-14);
      }
      // The crinkled cut has no second sheet of elements.
      CHECK(elements_behind(mesh, std::array{plane}) == elements_behind(exact, std::array{plane}));
    }
  }
}

TEST_CASE("A section leaves cavities out") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::mixed));
  const Plane plane({0.5, 0.45, 0.5}, {0, 1, 0});
  CHECK(area_of(plane_section(mesh, plane), plane) == doctest::Approx(1 - 1.0 / 9));
}

TEST_CASE("In a face with corners in front and behind by turns the saddle decides for both cells") {
  // Two hexahedra side by side; the corners of the face between them at heights by turns.
  for (const double height : {0.3, 0.7}) {
    MeshData data = cubes_with_holes(2, Volumes::hexahedra,
                                     [](Index, Index j, Index k) { return j > 0 || k > 0; });
    for (Index i = 0; i < data.node_count(); ++i) {
      const Vec3 p = data.coordinates.xyz(i);
      if (p.x() != 0.5) continue;
      const bool raised = (p.y() > 0) == (p.z() > 0);
      data.coordinates.set_xyz(
          i, {p.x() + (raised ? 0.1 : -0.1) * (raised ? height : 1 - height), p.y(), p.z()});
    }
    const Mesh mesh = make_mesh(data);
    const Plane plane({0.5, 0, 0}, {1, 0, 0});
    const PlaneSection section = plane_section(mesh, plane);
    CHECK(section.polygons.rows() > 2);
    CHECK(area_of(section, plane) == doctest::Approx(0.25));
    check_tiling(section, false);
  }
}

TEST_CASE("A crinkled cut leaves the elements of which some part lies behind") {
  const Mesh mesh = make_mesh(cube(4, Volumes::hexahedra));
  const auto count = [&](std::initializer_list<Plane> planes) {
    int sum = 0;
    for (const unsigned char left : elements_behind(mesh, std::vector<Plane>(planes))) sum += left;
    return sum;
  };
  CHECK(count({}) == 64);
  CHECK(count({Plane({0, 0, 0.5}, {0, 0, 1})}) == 32);
  CHECK(count({Plane({0, 0, 0.6}, {0, 0, 1})}) == 48);
  CHECK(count({Plane({0, 0, 0.6}, {0, 0, 1}), Plane({0.5, 0, 0}, {-1, 0, 0})}) == 24);
  CHECK(count({Plane({0, 0, -1}, {0, 0, 1})}) == 0);
}

TEST_CASE("Polygons are cut into triangles of the same area, concave ones too") {
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};
  const std::vector<Vec3> zigzag{{0, 0, 0}, {1, 0.8, 0}, {2, 0, 0},
                                 {2, 2, 0}, {1, 1, 0},   {0, 2, 0}};
  for (const auto& [corners, area] : {std::pair(arrow, 1.0), std::pair(zigzag, 2.2)}) {
    const std::vector<Index> triangles = cut_polygon(corners, {0, 0, 1});
    CHECK(triangles.size() == 3 * (corners.size() - 2));
    double sum = 0;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      const Vec3 a = corners[at(triangles[t])];
      const double z =
          0.5 * (corners[at(triangles[t + 1])] - a).cross(corners[at(triangles[t + 2])] - a).z();
      CHECK(z >= 0);
      sum += z;
    }
    CHECK(sum == doctest::Approx(area));
  }
}

TEST_CASE("A plane needs a normal, and a volume mesh to cut") {
  CHECK_THROWS_AS(Plane({0, 0, 0}, {0, 0, 0}), UsageError);
  CHECK_THROWS_AS(Plane({0, 0, 0}, {0, std::nan(""), 1}), UsageError);
  CHECK(Plane({0, 0, 0}, {0, 0, 1e300}).normal() == Vec3(0, 0, 1));
  const Mesh flat = make_mesh(square(2, Cells::quads));
  CHECK_THROWS_AS(plane_section(flat, Plane({0, 0, 0}, {0, 0, 1})), UsageError);
}

namespace {

using Polygon = std::pair<Index, std::vector<std::array<double, 3>>>;

/// The polygons with their places, in an order of their own.
std::vector<Polygon> polygons_of(const PlaneSection& section) {
  std::vector<Polygon> all;
  for (Index k = 0; k < section.polygons.rows(); ++k) {
    Polygon polygon{section.elements[at(k)], {}};
    for (const Index point : section.polygons[k]) {
      const Vec3& p = section.points[at(point)];
      polygon.second.push_back({p.x(), p.y(), p.z()});
    }
    std::rotate(polygon.second.begin(), std::ranges::min_element(polygon.second),
                polygon.second.end());
    all.push_back(std::move(polygon));
  }
  std::ranges::sort(all);
  return all;
}

}  // namespace

TEST_CASE("an index gives the same polygons, for every kind of element and place of the plane") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Random random(11);
    Mesh mesh = make_mesh(shuffled_volume(cube(6, volumes), random, false));
    const SectionIndex given(mesh);
    for (const Index node : mesh.topology->interior_nodes())
      mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 0.02 * random_vector(random));
    const SectionIndex moved(mesh, given);
    std::vector<Plane> planes{Plane({0.5, 0.5, 0.5}, {0, 0, 1}), Plane({0, 0, 0}, {0, 0, 1}),
                              Plane({0, 0, 1}, {0, 0, 1}), Plane({3, 0, 0}, {1, 0, 0}),
                              Plane({1, 0.2, 0.3}, {1, 0, 0})};
    for (int k = 0; k < 20; ++k)
      planes.emplace_back(Vec3::Constant(0.5) + 0.5 * random_vector(random), random_vector(random));
    for (const Plane& plane : planes) {
      const PlaneSection plain = plane_section(mesh, plane);
      const PlaneSection indexed = plane_section(mesh, plane, &moved);
      CHECK(plain.points.size() == indexed.points.size());
      CHECK(polygons_of(plain) == polygons_of(indexed));
    }
  }
}

TEST_CASE("what a plane meets is near it in the index, and what is far is left out") {
  const Mesh mesh = shaken_box(12, 0.2, 5);
  const SectionIndex index(mesh);
  CHECK(index.extent() == space_bounds(mesh));
  const Plane plane({0.5, 0.5, 0.31}, {0.1, 0.2, 1});
  const std::vector<Index> near = index.near(plane);
  std::vector<unsigned char> is_near(at(mesh.topology->element_count()), 0);
  for (const Index e : near) is_near[at(index.order().elements[at(e)])] = 1;
  for (const Index e : plane_section(mesh, plane).elements) CHECK(is_near[at(e)] == 1);
  CHECK(near.size() < 0.7 * static_cast<double>(is_near.size()));
  CHECK(index.near(Plane({0, 0, 5}, {0, 0, 1})).empty());
  // A node or an element that was forgotten would leave a hole.
  std::vector<Index> all = index.order().elements;
  std::ranges::sort(all);
  for (std::size_t k = 0; k < all.size(); ++k) CHECK(all[k] == static_cast<Index>(k));
}

TEST_CASE("an index of a plane mesh, or for another mesh, is refused") {
  CHECK_THROWS_AS(SectionIndex(make_mesh(square(4, Cells::triangles))), UsageError);
  const SectionIndex index(shaken_box(3, 0, 1));
  CHECK_THROWS_AS(SectionIndex(shaken_box(4, 0, 1), index), UsageError);
}
