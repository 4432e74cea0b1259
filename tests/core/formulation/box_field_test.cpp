#include "core/formulation/box_field.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/mesh.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr double smooth = 0.025;

BoxField field_of(const Mesh& mesh, int threads = 1) {
  return box_field(*mesh.topology, mesh.coordinates, smooth, threads);
}

/// Graded, curved and skewed: layers over a wall that bends. Heights grow from 1e-4 by a factor a
/// row.
MeshData made_on_purpose(MeshData data, double rows) {
  for (Index i = 0; i < data.node_count(); ++i) {
    Vec3 p = place_of(data.coordinates, i);
    const double height = 1e-4 * (std::pow(1.4, rows * p.y()) - 1);
    const double turn = 1.5 * p.x() * p.x() + 0.5 * p.x();
    const Vec3 normal(std::sin(turn), std::cos(turn), 0);
    p = Vec3(std::sin(turn), std::cos(turn), p.z() + 0.3 * p.z() * p.z()) + height * normal +
        0.4 * height * Vec3(normal.y(), -normal.x(), 0);
    data.coordinates.set_place(i, p);
  }
  return data;
}

/// Interior nodes moved by up to `reach` in each direction.
Mesh jittered(MeshData data, double reach, std::uint64_t seed) {
  const Mesh regular = make_mesh(data);
  Random random(seed);
  for (const Index node : regular.topology->interior_nodes())
    data.coordinates.set_place(node,
                               place_of(data.coordinates, node) + reach * random_vector(random));
  return make_mesh(data);
}

/// The same mesh, each element numbered from another corner.
MeshData renumbered(const MeshData& data, std::uint64_t seed) {
  constexpr std::array<std::size_t, 8> about_z{1, 2, 3, 0, 5, 6, 7, 4},
      about_x{4, 5, 1, 0, 7, 6, 2, 3};
  Random random(seed);
  MeshData out;
  out.coordinates = data.coordinates;
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto given = data.element(e);
    std::vector<Index> corners(given.begin(), given.end());
    const auto turn = [&](const auto& order) {
      const std::vector<Index> before = corners;
      for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = before[order[k]];
    };
    const bool plane = corners.size() == 4;
    for (Index k = random.index(4); k > 0; --k) {
      turn(about_z);
      if (!plane && k % 2 == 0) turn(about_x);
    }
    out.add_element(plane ? ElementType::quadrilateral : ElementType::hexahedron, corners);
  }
  return out;
}

}  // namespace

TEST_CASE("a grid that was made on purpose is smooth, however graded, curved and skewed it is") {
  const std::vector<Mesh> meshes{make_mesh(made_on_purpose(square(12, Cells::quads), 12)),
                                 make_mesh(made_on_purpose(cube(6, Volumes::hexahedra), 12)),
                                 make_mesh(made_on_purpose(cube(6, Volumes::prisms), 12))};
  for (const Mesh& mesh : meshes) {
    const BoxField field = field_of(mesh);
    CHECK(std::ranges::max(field.roughness) < 0.5 * smooth);
    CHECK(field.sides.empty());
  }
}

TEST_CASE("a jittered grid is rough, and its boxes are those of the grid") {
  const double aspect = std::exp(1.0);
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    for (const bool space : {false, true}) {
      CAPTURE(space);
      MeshData data = space ? cube(7, Volumes::hexahedra) : square(12, Cells::quads);
      const double reach = 0.25 / (space ? 7 : 12);
      Mesh mesh = jittered(std::move(data), reach, seed);
      for (Index i = 0; i < mesh.coordinates.size(); ++i) {
        Vec3 p = place_of(mesh.coordinates, i);
        p.x() *= aspect;
        mesh.coordinates.set_place(i, p);
      }
      const BoxField field = field_of(mesh);
      const Vec3 expected = space ? Vec3(2.0 / 3, -1.0 / 3, -1.0 / 3) : Vec3(0.5, -0.5, 0);
      REQUIRE(field.sides.size() == field.roughness.size());
      for (std::size_t e = 0; e < field.sides.size(); ++e) {
        CHECK(field.roughness[e] > smooth);
        CHECK((field.sides[e] - expected).cwiseAbs().maxCoeff() < 0.15);
      }
    }
  }
}

TEST_CASE("roughness and boxes do not depend on the corner from which elements are numbered") {
  for (const bool space : {false, true}) {
    CAPTURE(space);
    const Mesh mesh = space ? jittered(cube(5, Volumes::hexahedra), 0.06, 4)
                            : jittered(square(9, Cells::quads), 0.03, 4);
    MeshData data = space ? cube(5, Volumes::hexahedra) : square(9, Cells::quads);
    data.coordinates = mesh.coordinates;
    const BoxField one = field_of(mesh), other = field_of(make_mesh(renumbered(data, 5)));
    REQUIRE(one.sides.size() == other.sides.size());
    REQUIRE(!one.sides.empty());
    for (std::size_t e = 0; e < one.sides.size(); ++e) {
      CHECK(one.roughness[e] == doctest::Approx(other.roughness[e]).epsilon(1e-9));
      Vec3 a = one.sides[e], b = other.sides[e];
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      CHECK((a - b).norm() < 1e-9);
    }
  }
}

TEST_CASE("jittered prisms are rough, in layers and in a single one; others have no boxes") {
  const Mesh layers = jittered(cube(6, Volumes::prisms), 0.04, 6);
  const BoxField field = field_of(layers);
  const auto rough = std::ranges::count_if(field.roughness, [](double r) { return r > smooth; });
  CHECK(rough > 0.9 * static_cast<double>(field.roughness.size()));
  for (const Vec3& sides : field.sides) {
    CHECK(sides[0] == doctest::Approx(sides[1]));
    CHECK(sides.sum() == doctest::Approx(0));
  }
  const BoxField none = field_of(jittered(square(8, Cells::triangles), 0.03, 7));
  CHECK(none.sides.empty());
  CHECK(std::ranges::max(none.roughness) == 0);
}

TEST_CASE("boxes do not depend on the number of threads") {
  const Mesh mesh = jittered(square(90, Cells::quads), 0.002, 8);
  const BoxField one = field_of(mesh), four = field_of(mesh, 4);
  CHECK(one.roughness == four.roughness);
  CHECK(std::ranges::equal(one.sides, four.sides));
}
