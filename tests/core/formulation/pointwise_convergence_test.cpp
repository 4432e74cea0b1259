#include <doctest/doctest.h>

#include <cmath>
#include <complex>

#include "core/formulation/pointwise_winslow.h"
#include "core/linear/linear_solver.h"
#include "core/outer/picard_solver.h"
#include "core/strategy/workspace.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/vcv.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A smooth map that is neither affine nor conformal nor harmonic, with its derivatives.
struct SmoothMap {
  Vec2 operator()(const Vec2& p) const {
    return {std::sin(1.1 * p.x() + 0.4 * p.y()) + 0.3 * p.x() * p.y(),
            std::exp(0.5 * p.y()) + 0.2 * p.x() * p.x() + 0.1 * std::cos(p.x() - p.y())};
  }
  Vec2 x(const Vec2& p) const {
    return {1.1 * std::cos(1.1 * p.x() + 0.4 * p.y()) + 0.3 * p.y(),
            0.4 * p.x() - 0.1 * std::sin(p.x() - p.y())};
  }
  Vec2 y(const Vec2& p) const {
    return {0.4 * std::cos(1.1 * p.x() + 0.4 * p.y()) + 0.3 * p.x(),
            0.5 * std::exp(0.5 * p.y()) + 0.1 * std::sin(p.x() - p.y())};
  }
  Vec2 xx(const Vec2& p) const {
    return {-1.21 * std::sin(1.1 * p.x() + 0.4 * p.y()), 0.4 - 0.1 * std::cos(p.x() - p.y())};
  }
  Vec2 xy(const Vec2& p) const {
    return {-0.44 * std::sin(1.1 * p.x() + 0.4 * p.y()) + 0.3, 0.1 * std::cos(p.x() - p.y())};
  }
  Vec2 yy(const Vec2& p) const {
    return {-0.16 * std::sin(1.1 * p.x() + 0.4 * p.y()),
            0.25 * std::exp(0.5 * p.y()) - 0.1 * std::cos(p.x() - p.y())};
  }
};

struct ExactOperator {
  double alpha, beta, gamma;  // divided by (alpha + gamma) / 2
  Vec2 value;
};

ExactOperator exact_operator(const SmoothMap& map, const Vec2& p) {
  const Vec2 rx = map.x(p), ry = map.y(p);
  const double m = 0.5 * (rx.squaredNorm() + ry.squaredNorm());
  ExactOperator exact{ry.squaredNorm() / m, rx.dot(ry) / m, rx.squaredNorm() / m, {}};
  exact.value = exact.alpha * map.xx(p) - 2 * exact.beta * map.xy(p) + exact.gamma * map.yy(p);
  return exact;
}

/// A regular star of size h at p, turned by `angle`, carried over by the map.
Mesh mapped_star(const SmoothMap& map, const Vec2& p, double h, double angle) {
  Mesh mesh = make_mesh(regular_star(6));
  mesh.coordinates.set_xy(0, map(p));
  for (Index k = 0; k < 6; ++k) {
    mesh.coordinates.set_xy(k + 1, map(p + polar(h, angle + pi / 3 * k)));
  }
  return mesh;
}

/// Area of the hexagonal VCV is 3 sqrt(3) / 2 and that of its median dual a third of it; the outer
/// edges of linear triangles carry twice the flux of the dual.
const double star_constant = std::sqrt(3.0);

double residual_error(const SmoothMap& map, const Vec2& p, double h) {
  const Mesh mesh = mapped_star(map, p, h, 0);
  const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
  std::vector<double> r(2);
  winslow.residual(mesh.coordinates, r);
  return (Vec2(r[0], r[1]) / (star_constant * h * h) - exact_operator(map, p).value).norm();
}

/// Largest distance between the smoothed annulus and exp of its lattice, over the outer radius.
double conformal_error(Index sectors, Index rings) {
  Mesh mesh = make_mesh(conformal_annulus(sectors, rings));
  const Coordinates exact = mesh.coordinates;
  Random random(5);
  perturb(mesh, random, 0.2);
  const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
  const auto linear = make_linear_solver({});
  SmoothOptions options;
  options.tolerance = 1e-13;
  options.clip = Clip::off;
  options.threads = 1;
  const auto [plain, clipped] = clip_variants(winslow);
  PicardSolver solver({plain, clipped}, *linear, equation_options(options, 2));
  solver.start(mesh.coordinates);
  for (int k = 0; k < 500 && !solver.converged(); ++k) solver.step(mesh.coordinates);
  REQUIRE(solver.converged());
  return largest_difference(mesh.coordinates, exact) / bounds(mesh).max.x();
}

}  // namespace

TEST_CASE("the manufactured map's derivatives are those of finite differences") {
  const SmoothMap map;
  constexpr double h = 1e-4;
  const Vec2 ex(h, 0), ey(0, h);
  for (const Vec2& p : {Vec2(0.1, 0.2), Vec2(-0.5, 0.7), Vec2(0.9, -0.3)}) {
    CHECK(((map(p + ex) - map(p - ex)) / (2 * h) - map.x(p)).norm() < 1e-7);
    CHECK(((map(p + ey) - map(p - ey)) / (2 * h) - map.y(p)).norm() < 1e-7);
    CHECK(((map(p + ex) - 2 * map(p) + map(p - ex)) / (h * h) - map.xx(p)).norm() < 1e-6);
    CHECK(((map(p + ey) - 2 * map(p) + map(p - ey)) / (h * h) - map.yy(p)).norm() < 1e-6);
    const Vec2 mixed =
        (map(p + ex + ey) - map(p + ex - ey) - map(p - ex + ey) + map(p - ex - ey)) / (4 * h * h);
    CHECK((mixed - map.xy(p)).norm() < 1e-6);
  }
}

TEST_CASE("on a hexagonal lattice the operator is consistent to second order") {
  const SmoothMap map;
  for (const Vec2& p : {Vec2(0.1, 0.2), Vec2(-0.5, 0.7), Vec2(0.9, -0.3)}) {
    CAPTURE(p.x());
    REQUIRE(exact_operator(map, p).value.norm() > 0.05);
    double before = residual_error(map, p, 0.1);
    for (const double h : {0.05, 0.025, 0.0125}) {
      const double error = residual_error(map, p, h);
      CHECK(before / error == doctest::Approx(4).epsilon(0.08));
      before = error;
    }
    CHECK(before < 1e-3);
  }
}

TEST_CASE("nodal coefficients converge to those of the map to second order") {
  const SmoothMap map;
  const Vec2 p(0.3, -0.2);
  const ExactOperator exact = exact_operator(map, p);
  double before = 0;
  for (const double h : {0.1, 0.05, 0.025}) {
    const Mesh mesh = mapped_star(map, p, h, 0);
    const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
    const WinslowCoefficients c = winslow.coefficients(mesh.coordinates, 0);
    const double error = std::abs(c.alpha - exact.alpha) + std::abs(c.beta - exact.beta) +
                         std::abs(c.gamma - exact.gamma);
    if (before > 0) CHECK(before / error == doctest::Approx(4).epsilon(0.08));
    before = error;
  }
}

TEST_CASE("how the VCV is turned in computational space changes nothing") {
  const SmoothMap map;
  const Vec2 p(0.3, -0.2);
  // A star turned by one edge is the same set of points: the start edge must not matter.
  const Mesh mesh = mapped_star(map, p, 0.1, 0);
  const Mesh turned = mapped_star(map, p, 0.1, pi / 3);
  const VirtualControlVolumes vcv(mesh.topology);
  std::vector<double> a(2), b(2);
  pointwise(vcv).residual(mesh.coordinates, a);
  pointwise(vcv).residual(turned.coordinates, b);
  CHECK((Vec2(a[0], a[1]) - Vec2(b[0], b[1])).norm() < 1e-14);
}

TEST_CASE("smoothing a log-polar annulus converges to the conformal map exp") {
  // exp is conformal, hence an exact solution. On the lattice of equilateral triangles the leading
  // errors of gradient and Laplacian vanish for harmonic maps by symmetry, so that the order seen
  // is higher than the operator's two.
  const double coarse = conformal_error(12, 4);
  const double medium = conformal_error(24, 8);
  const double fine = conformal_error(48, 16);
  CAPTURE(coarse);
  CAPTURE(medium);
  CAPTURE(fine);
  CHECK(coarse < 1e-3);
  CHECK(coarse / medium > 4);
  CHECK(medium / fine > 4);
}

TEST_CASE("an annulus of quadrilaterals converges to its exact map to second order") {
  // Log-polar coordinates are harmonic, so rings in geometric progression are an exact solution of
  // the Winslow equations; the cut corners see the second differences along both grid lines.
  const auto error = [](Index sectors, Index rings) {
    Mesh mesh = make_mesh(annulus(sectors, rings, std::pow(4.0, 1.0 / rings), Cells::quads));
    const Coordinates exact = mesh.coordinates;
    const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
    const auto linear = make_linear_solver({});
    SmoothOptions options;
    options.clip = Clip::off;
    options.threads = 1;
    const auto [plain, clipped] = clip_variants(winslow);
    PicardSolver solver({plain, clipped}, *linear, equation_options(options, 2));
    solver.start(mesh.coordinates);
    for (int k = 0; k < 500 && !solver.converged(); ++k) solver.step(mesh.coordinates);
    REQUIRE(solver.converged());
    return largest_difference(mesh.coordinates, exact) / 4;
  };
  const double coarse = error(16, 4), medium = error(32, 8), fine = error(64, 16);
  CAPTURE(coarse);
  CHECK(coarse < 0.05);
  CHECK(coarse / medium == doctest::Approx(4).epsilon(0.2));
  CHECK(medium / fine == doctest::Approx(4).epsilon(0.1));
}
