#include "core/formulation/pointwise_winslow.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/linear/linear_solver.h"
#include "core/mesh/mesh.h"
#include "core/outer/picard_solver.h"
#include "core/parallel/parallel_for.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

VolumePointwise pointwise_of(const VolumeVcvs& vcvs, int threads = 1) {
  return {vcvs, std::make_shared<NodeClasses>(vcvs.shared_topology()), threads};
}

Index inverted_tetrahedra(const Mesh& mesh, const Coordinates& x) {
  Index inverted = 0;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto c = mesh.topology->element(e);
    const Vec3 p = x.xyz(c[0]);
    const Vec3 a = x.xyz(c[1]) - p, b = x.xyz(c[2]) - p, d = x.xyz(c[3]) - p;
    inverted += !(a.dot(b.cross(d)) > 0);
  }
  return inverted;
}

/// The damped fixed point from a mesh on, until it has converged or for so many steps. Returns the
/// last record; x: the mesh, on return where it led.
IterationRecord iterate(const VolumePointwise& problem, Coordinates& x, int steps) {
  const auto linear = make_linear_solver(LinearOptions{}, 1);
  EquationOptions options;
  options.damping = 0.5;
  const auto [plain, clipped] = clip_variants(problem);
  PicardSolver solver({plain, clipped}, *linear, options);
  solver.start(x);
  IterationRecord record;
  for (int i = 0; i < steps && !solver.converged(); ++i) record = solver.step(x);
  return record;
}

/// A smooth map that is neither affine nor harmonic, with its derivatives.
struct SmoothMap {
  Vec3 operator()(const Vec3& p) const {
    return {std::sin(1.1 * p.x() + 0.4 * p.y()) + 0.3 * p.z() * p.x(),
            std::exp(0.5 * p.y()) + 0.2 * p.x() * p.z(),
            p.z() + 0.2 * std::cos(p.x() - p.y()) + 0.1 * p.y() * p.z()};
  }
  /// sum over i, j of k_ij r_ij and the Jacobian, both by central differences of high accuracy.
  Eigen::Matrix3d jacobian(const Vec3& p) const {
    constexpr double h = 1e-3;
    Eigen::Matrix3d d;
    for (int i = 0; i < 3; ++i) {
      const Vec3 e = h * Vec3::Unit(i);
      d.col(i) =
          (8 * ((*this)(p + e) - (*this)(p - e)) - ((*this)(p + 2 * e) - (*this)(p - 2 * e))) /
          (12 * h);
    }
    return d;
  }
  Vec3 operator_of(const Eigen::Matrix3d& k, const Vec3& p) const {
    constexpr double h = 1e-3;
    Vec3 sum(0, 0, 0);
    for (int j = 0; j < 3; ++j) {
      const Vec3 e = h * Vec3::Unit(j);
      sum +=
          ((8 * (jacobian(p + e) - jacobian(p - e)) - (jacobian(p + 2 * e) - jacobian(p - 2 * e))) /
           (12 * h)) *
          k.col(j);
    }
    return sum;
  }
};

/// Error of the operator at the middle node of 2 by 2 by 2 cubes of size h around p, mapped, over
/// VCVs that are the unmapped cubes' stars (own) or have equal angles.
double operator_error(const SmoothMap& map, const Vec3& p, double h, bool own) {
  Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  const VolumeVcvs vcvs = own ? own_stars(mesh) : VolumeVcvs(mesh.topology);
  for (Index i = 0; i < mesh.topology->node_count(); ++i) {
    const Vec3 q = 2 * h * (mesh.coordinates.xyz(i) - Vec3::Constant(0.5));
    mesh.coordinates.set_xyz(i, map(p + q));
  }
  const VolumePointwise problem = pointwise_of(vcvs);
  std::array<double, 3> residual{};
  problem.residual(mesh.coordinates, residual);
  // 24 tetrahedra of a sixth of a cube of edge 1/2; the gradient of a linear one is that in its
  // middle, three quarters of the way to the outer triangle through which the flux is taken.
  const double volume = 24.0 / 48 * 0.75;
  const double unit = 4 * h * h;  // (h / (1/2))^2
  const Vec3 found = Vec3(residual.data()) / volume / unit;
  const Vec3 exact = map.operator_of(winslow_tensor(map.jacobian(p)), p);
  return (found - exact).norm() / exact.norm();
}

}  // namespace

TEST_CASE("in space an affine map of the VCVs has zero residual") {
  for (const bool own : {false, true}) {
    CAPTURE(own);
    Random random(31);
    Mesh mesh = shaken_box(2, own ? 0.3 : 0, 3);
    const Index node = mesh.topology->interior_nodes().front();
    const VolumeVcvs vcvs = own ? own_stars(mesh) : VolumeVcvs(mesh.topology);
    Eigen::Matrix3d a;
    for (int i = 0; i < 9; ++i) a(i / 3, i % 3) = random.uniform(-1, 1);
    const Vec3 b = random_vector(random);
    std::vector<Vec3> points;
    vcvs.points(node, points);
    mesh.coordinates.set_xyz(node, b);
    const auto neighbours = mesh.topology->neighbours(node);
    for (std::size_t k = 0; k < points.size(); ++k) {
      mesh.coordinates.set_xyz(neighbours[k], a * points[k] + b);
    }
    CHECK(pointwise_of(vcvs).residual(mesh.coordinates, {}).max < 1e-13);
  }
}

TEST_CASE("a mesh over the VCVs that are its own stars has zero residual") {
  const Mesh mesh = shaken_box(5, 0.2, 8);
  REQUIRE(inverted_tetrahedra(mesh, mesh.coordinates) == 0);
  const VolumePointwise problem = pointwise_of(own_stars(mesh));
  CHECK(problem.residual(mesh.coordinates, {}).max < 1e-12);
  CHECK(pointwise_of(VolumeVcvs(mesh.topology)).residual(mesh.coordinates, {}).max > 1e-3);
}

TEST_CASE("over a symmetric star the operator converges with the second order") {
  const SmoothMap map;
  const Vec3 p(0.3, -0.2, 0.4);
  const double coarse = operator_error(map, p, 0.1, true);
  const double fine = operator_error(map, p, 0.05, true);
  const double finest = operator_error(map, p, 0.025, true);
  CHECK(coarse < 0.1);
  CHECK(coarse / fine == doctest::Approx(4).epsilon(0.15));
  CHECK(fine / finest == doctest::Approx(4).epsilon(0.1));
  // With equal angles and unit edges the map of the star is not smooth: an error that stays.
  CHECK(operator_error(map, p, 0.025, false) > 0.05);
}

TEST_CASE("the frozen system of volume meshes is the residual, row by row") {
  const Mesh mesh = shaken_box(4, 0.3, 9);
  const VolumeVcvs vcvs(mesh.topology);
  for (const bool clip : {false, true}) {
    CAPTURE(clip);
    const VolumePointwise problem = pointwise_of(vcvs).clipped(clip);
    SparseSystem system;
    const Index negative = problem.freeze(mesh.coordinates, system);
    CHECK(negative > 0);
    std::vector<double> residual(problem.unknowns());
    problem.residual(mesh.coordinates, residual);
    const auto interior = mesh.topology->interior_nodes();
    Index counted = 0;
    std::vector<double> w;
    for (std::size_t i = 0; i < interior.size(); ++i) {
      w.resize(mesh.topology->neighbours(interior[i]).size());
      counted += problem.weights(mesh.coordinates, interior[i], w);
      double sum = 0;
      for (const double weight : w) {
        sum += std::abs(weight);
        if (clip) CHECK(weight >= 0);
      }
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(system.rhs[3 * i + c] * sum == doctest::Approx(residual[3 * i + c]).epsilon(1e-9));
      }
    }
    CHECK(counted == negative);
  }
}

TEST_CASE("in space the residual has the same bits at any number of threads") {
  const Mesh mesh = shaken_box(20, 0.3, 10);
  REQUIRE(mesh.topology->interior_nodes().size() > at(parallel_block));
  const VolumeVcvs vcvs(mesh.topology);
  std::vector<double> one(3 * mesh.topology->interior_nodes().size()), four = one;
  const ResidualNorms a = pointwise_of(vcvs, 1).residual(mesh.coordinates, one);
  const ResidualNorms b = pointwise_of(vcvs, 4).residual(mesh.coordinates, four);
  CHECK(one == four);
  CHECK(a.rms == b.rms);
  CHECK(a.max == b.max);
}

TEST_CASE("the fixed-point iteration untangles a box of tetrahedra") {
  const Mesh rest = make_mesh(cube(6, Volumes::tetrahedra));
  const Mesh mesh = shaken_box(6, 1.0, 11);
  REQUIRE(inverted_tetrahedra(mesh, mesh.coordinates) > 100);
  Coordinates x = mesh.coordinates;
  const IterationRecord record = iterate(pointwise_of(own_stars(rest)), x, 200);
  CHECK(record.inverted == 0);
  CHECK(record.residual < EquationOptions{}.tolerance);
  // The cubes are the one solution near.
  double off = 0;
  for (Index i = 0; i < x.size(); ++i) {
    off = std::max(off, (x.xyz(i) - rest.coordinates.xyz(i)).norm());
  }
  CHECK(off < 1e-8);
}

TEST_CASE("over equal angles a box of tetrahedra becomes valid, too") {
  const Mesh mesh = shaken_box(6, 0.6, 12);
  REQUIRE(inverted_tetrahedra(mesh, mesh.coordinates) > 10);
  Coordinates x = mesh.coordinates;
  CHECK(iterate(pointwise_of(VolumeVcvs(mesh.topology)), x, 100).inverted == 0);
  CHECK(inverted_tetrahedra(mesh, x) == 0);
}

TEST_CASE("the pointwise form in space refuses nodes that slide") {
  const Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  auto classes = std::make_shared<NodeClasses>(mesh.topology);
  classes->set_on_surface(0, Vec3(0, 0, 1));
  CHECK_THROWS_AS(VolumePointwise(VolumeVcvs(mesh.topology), classes, 1), UsageError);
}
