#include "elasticity/linear_elasticity.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::bench;
using namespace winslow::test;

namespace {

std::vector<Vec2> irregular(std::size_t corners) {
  if (corners == 3) return {{0.1, 0.2}, {1.3, -0.1}, {0.4, 1.1}};
  return {{0.1, 0.2}, {1.3, -0.1}, {1.6, 0.9}, {-0.2, 1.2}};
}

double energy_at(std::span<const Vec2> corners, const std::vector<double>& u) {
  std::vector<Vec2> displacements;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    displacements.emplace_back(u[2 * k], u[2 * k + 1]);
  }
  return strain_energy(corners, displacements, 3.0, 0.3);
}

}  // namespace

TEST_CASE("the stiffness of an element is the second derivative of its strain energy") {
  for (const std::size_t n : {std::size_t{3}, std::size_t{4}}) {
    CAPTURE(n);
    const auto corners = irregular(n);
    const auto k = element_stiffness(corners, 3.0, 0.3);
    constexpr double h = 1e-3;  // the energy is quadratic: differences are exact but for round-off
    for (std::size_t i = 0; i < 2 * n; ++i) {
      for (std::size_t j = 0; j < 2 * n; ++j) {
        const auto at_offsets = [&](double a, double b) {
          std::vector<double> u(2 * n, 0.0);
          u[i] += a;
          u[j] += b;
          return energy_at(corners, u);
        };
        const double second =
            (at_offsets(h, h) - at_offsets(h, -h) - at_offsets(-h, h) + at_offsets(-h, -h)) /
            (4 * h * h);
        CHECK(k[i * 2 * n + j] == doctest::Approx(second).epsilon(1e-8));
      }
    }
  }
}

TEST_CASE("an element moved rigidly has no strain energy; one stretched has that of the formula") {
  for (const std::size_t n : {std::size_t{3}, std::size_t{4}}) {
    const auto corners = irregular(n);
    std::vector<Vec2> rigid, stretched;
    double area = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 p = corners[k], q = corners[(k + 1) % n];
      area += 0.5 * (p.x() * q.y() - p.y() * q.x());
      rigid.emplace_back(0.7 - 0.2 * p.y(), -0.4 + 0.2 * p.x());
      stretched.emplace_back(0.1 * p.x(), 0.0);
    }
    CHECK(std::abs(strain_energy(corners, rigid, 3.0, 0.3)) < 1e-15);
    // eps = (0.1, 0, 0): energy density (lambda + 2 mu) 0.1^2 / 2 with E = 3, nu = 0.3.
    const double lambda = 3.0 * 0.3 / (1.3 * 0.4), mu = 3.0 / 2.6;
    CHECK(strain_energy(corners, stretched, 3.0, 0.3) ==
          doctest::Approx(area * (lambda + 2 * mu) * 0.005));
  }
}

TEST_CASE("patch test: a linear displacement of the boundary is that of the interior") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Mesh mesh = make_mesh(square_with_hole(12, cells));
    Random random(3);
    perturb(mesh, random, 0.3);
    // The strain is then constant, and in equilibrium where the modulus is.
    ElasticityOptions options;
    options.modulus = Modulus::constant;
    ElasticSolid<2> solid(mesh.topology, {}, options);
    Coordinates expected = mesh.coordinates, x = mesh.coordinates;
    for (Index i = 0; i < x.size(); ++i) {
      const Vec2 p = x.xy(i);
      expected.set_xy(i, {1.02 * p.x() - 0.05 * p.y() + 0.3, 1.01 * p.y() + 0.04 * p.x()});
    }
    solid.deform(x, expected);
    CHECK(largest_difference(x, expected) < 1e-12);
  }
}

TEST_CASE("a translation is reproduced whatever the moduli are") {
  const Mesh mesh = make_mesh(square_with_hole(12, Cells::mixed));
  for (const Modulus modulus : {Modulus::wall_distance, Modulus::volume}) {
    ElasticityOptions options;
    options.modulus = modulus;
    ElasticSolid<2> solid(mesh.topology, mesh.topology->boundary_loops().front(), options);
    Coordinates expected = mesh.coordinates, x = mesh.coordinates;
    for (Index i = 0; i < x.size(); ++i) expected.set_xy(i, x.xy(i) + Vec2(0.4, -0.2));
    solid.deform(x, expected);
    CHECK(largest_difference(x, expected) < 1e-11);
  }
}

namespace {

const std::vector<Vec3> tetrahedron{
    {0.1, 0.2, 0}, {1.3, -0.1, 0.2}, {0.4, 1.1, -0.1}, {0.3, 0.2, 0.9}};

double largest_component(const Coordinates& a, const Coordinates& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.values().size(); ++k)
    largest = std::max(largest, std::abs(a.values()[k] - b.values()[k]));
  return largest;
}

/// All nodes displaced by a linear map.
Coordinates mapped(const Coordinates& x, const Eigen::Matrix3d& map, const Vec3& shift) {
  Coordinates out = x;
  for (Index i = 0; i < x.size(); ++i) out.set_xyz(i, map * x.xyz(i) + shift);
  return out;
}

}  // namespace

TEST_CASE("the stiffness of a tetrahedron is the second derivative of its strain energy") {
  const auto k = element_stiffness(tetrahedron, 3.0, 0.3);
  constexpr double h = 1e-3;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) {
      const auto energy = [&](double a, double b) {
        std::vector<Vec3> u(4, Vec3(0, 0, 0));
        u[i / 3][static_cast<int>(i % 3)] += a;
        u[j / 3][static_cast<int>(j % 3)] += b;
        return strain_energy(tetrahedron, u, 3.0, 0.3);
      };
      const double second =
          (energy(h, h) - energy(h, -h) - energy(-h, h) + energy(-h, -h)) / (4 * h * h);
      CHECK(k[i * 12 + j] == doctest::Approx(second).epsilon(1e-8));
    }
  }
}

TEST_CASE("a tetrahedron moved rigidly has no strain energy; one sheared has that of the formula") {
  std::vector<Vec3> rigid, sheared;
  for (const Vec3& p : tetrahedron) {
    rigid.push_back(Vec3(0.1, -0.2, 0.3) + Vec3(0.3, -0.1, 0.2).cross(p));
    sheared.emplace_back(0.1 * p.z(), 0, 0);
  }
  CHECK(std::abs(strain_energy(tetrahedron, rigid, 3.0, 0.3)) < 1e-15);
  const Vec3 a = tetrahedron[1] - tetrahedron[0], b = tetrahedron[2] - tetrahedron[0],
             c = tetrahedron[3] - tetrahedron[0];
  // eps_xz = 0.05: energy density 2 mu eps_xz^2, mu = E / (2 (1 + nu)) with E = 3, nu = 0.3.
  CHECK(strain_energy(tetrahedron, sheared, 3.0, 0.3) ==
        doctest::Approx(a.dot(b.cross(c)) / 6 * 2 * (3.0 / 2.6) * 0.05 * 0.05));
}

TEST_CASE("patch test and translation in space") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  ElasticityOptions options;
  options.tolerance = 1e-12;
  options.modulus = Modulus::constant;
  Eigen::Matrix3d map;
  map << 1.02, -0.05, 0.01, 0.04, 1.01, 0.02, -0.03, 0, 0.98;
  Coordinates x = mesh.coordinates;
  const Coordinates expected = mapped(x, map, Vec3(0.3, 0, -0.1));
  ElasticSolid<3>(mesh.topology, {}, options).deform(x, expected);
  CHECK(largest_component(x, expected) < 1e-10);
  const std::vector<std::string> cavity{"cavity"};
  for (const Modulus modulus : {Modulus::wall_distance, Modulus::volume}) {
    options.modulus = modulus;
    Coordinates y = mesh.coordinates;
    const Coordinates there = mapped(y, Eigen::Matrix3d::Identity(), Vec3(0.4, -0.2, 0.1));
    ElasticSolid<3>(mesh.topology, mesh.topology->markers().nodes_of(cavity), options)
        .deform(y, there);
    CHECK(largest_component(y, there) < 1e-10);
  }
  const Mesh hexahedra = make_mesh(cube(2, Volumes::hexahedra));
  CHECK_THROWS_AS(ElasticSolid<3>(hexahedra.topology, {}, options), UsageError);
}
