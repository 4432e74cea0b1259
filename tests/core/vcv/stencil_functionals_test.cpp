#include "core/vcv/stencil_functionals.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "support/meshes.h"
#include "support/vcv.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Eigen::Matrix2d random_matrix(Random& random) {
  Eigen::Matrix2d m;
  m << random.vector(), random.vector();
  return m;
}

std::vector<Vec2> affine_image(std::span<const Vec2> points, const Eigen::Matrix2d& a,
                               const Vec2& b) {
  std::vector<Vec2> image;
  for (const Vec2& p : points) image.emplace_back(a * p + b);
  return image;
}

Eigen::Matrix2d gradient(std::span<const NeighbourFunctionals> f, const Vec2& r0,
                         std::span<const Vec2> r) {
  Eigen::Matrix2d g = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < f.size(); ++k) {
    g.col(0) += f[k].dx * (r[k] - r0);
    g.col(1) += f[k].dy * (r[k] - r0);
  }
  return g;
}

Vec2 weighted(std::span<const double> w, const Vec2& r0, std::span<const Vec2> r) {
  Vec2 sum(0, 0);
  for (std::size_t k = 0; k < w.size(); ++k) sum += w[k] * (r[k] - r0);
  return sum;
}

std::vector<Vec2> random_ring(Random& random, std::size_t n) {
  std::vector<Vec2> r;
  for (std::size_t k = 0; k < n; ++k) r.push_back(random.vector(-2, 2));
  return r;
}

}  // namespace

TEST_CASE("the gradient functionals are exact for linear functions on any VCV") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto points = random_vcv(random, 3 + random.index(8));
    const Eigen::Matrix2d a = random_matrix(random);
    const Vec2 b = random.vector(-5, 5);
    const auto g = gradient(functionals_of(points), b, affine_image(points, a, b));
    CHECK((g - a).norm() < 1e-12);
  }
}

TEST_CASE("gradient and flux agree with an integration triangle by triangle") {
  for (std::uint64_t seed = 101; seed <= 140; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto points = random_vcv(random, 3 + random.index(8));
    const Vec2 r0 = random.vector();
    const auto r = random_ring(random, points.size());
    const double alpha = random.uniform(0, 3), beta = random.uniform(-2, 2);
    const double gamma = random.uniform(0, 3);
    Eigen::Matrix2d k;
    k << alpha, -beta, -beta, gamma;
    const BruteForce expected = integrate(points, r0, r, k);
    const auto f = functionals_of(points);
    CHECK((gradient(f, r0, r) - expected.gradient).norm() < 1e-11);
    const Vec2 residual = weighted(weights_of(f, alpha, beta, gamma), r0, r);
    CHECK((residual - expected.residual).norm() < 1e-10 * (1 + expected.residual.norm()));
  }
}

TEST_CASE("weights on the regular polygon have their closed form") {
  for (Index n = 4; n <= 10; ++n) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(n);
      CAPTURE(seed);
      Random random(seed);
      const double alpha = random.uniform(0, 3), beta = random.uniform(-2, 2);
      const double gamma = random.uniform(0, 3);
      const auto w = weights_of(functionals_of(regular_polygon(n)), alpha, beta, gamma);
      const double theta = 2 * pi / n;
      for (Index k = 0; k < n; ++k) {
        const double phi = k * theta;
        const double anisotropy =
            0.5 * (gamma - alpha) * std::cos(2 * phi) + beta * std::sin(2 * phi);
        const double expected = 2 * std::tan(theta / 2) *
                                (0.5 * (alpha + gamma) - (1 + 2 * std::cos(theta)) * anisotropy);
        CHECK(w[at(k)] == doctest::Approx(expected).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("on the square the mixed derivative drops out") {
  for (const auto& f : functionals_of(regular_polygon(4))) CHECK(std::abs(f.lxy) < 1e-15);
}

TEST_CASE("any affine map of any VCV has zero residual, for any constant coefficients") {
  // The gradients of all triangles are equal and the outer edges' normals sum to zero, so this
  // holds for every VCV, not only for regular ones.
  for (std::uint64_t seed = 201; seed <= 240; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const bool regular = seed % 2 == 0;
    const Index n = 3 + random.index(8);
    const auto points = regular ? regular_polygon(n) : random_vcv(random, n);
    const Eigen::Matrix2d a = random_matrix(random);
    const Vec2 b = random.vector(-5, 5);
    const auto r = affine_image(points, a, b);
    const auto f = functionals_of(points);
    const Eigen::Matrix2d k = winslow_matrix(gradient(f, b, r));
    const auto w = weights_of(f, k(0, 0), -k(0, 1), k(1, 1));
    double scale = 0;
    for (const double v : w) scale += std::abs(v);
    CHECK(weighted(w, b, r).norm() < 1e-13 * (1 + scale) * (1 + a.norm()) * 10);
  }
}

TEST_CASE("turning, scaling and renumbering a VCV changes no weight") {
  for (std::uint64_t seed = 301; seed <= 330; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto points = random_vcv(random, 3 + random.index(7));
    const std::size_t n = points.size();
    const Vec2 r0 = random.vector();
    const auto r = random_ring(random, n);
    const auto weights = [&](std::span<const Vec2> p, std::span<const Vec2> ring) {
      const auto f = functionals_of(p);
      const Eigen::Matrix2d k = winslow_matrix(gradient(f, r0, ring));
      const double mean = 0.5 * k.trace();
      return weights_of(f, k(0, 0) / mean, -k(0, 1) / mean, k(1, 1) / mean);
    };
    const auto w = weights(points, r);
    const std::size_t shift = at(random.index(static_cast<Index>(n)));
    const double phi = random.uniform(0, 2 * pi), size = random.uniform(0.01, 100);
    Eigen::Matrix2d turn;
    turn << std::cos(phi), -std::sin(phi), std::sin(phi), std::cos(phi);
    std::vector<Vec2> turned, ring;
    for (std::size_t k = 0; k < n; ++k) {
      turned.emplace_back(size * (turn * points[(k + shift) % n]));
      ring.push_back(r[(k + shift) % n]);
    }
    const auto w2 = weights(turned, ring);
    for (std::size_t k = 0; k < n; ++k) {
      CHECK(w2[k] == doctest::Approx(w[(k + shift) % n]).epsilon(1e-9));
    }
  }
}

TEST_CASE("a node with two edges settles halfway") {
  const std::vector<Vec2> points{Vec2(1, 0), Vec2(-1, 0)};
  const auto f = functionals_of(points);
  const Vec2 r0(0, 0);
  const std::vector<Vec2> ring{Vec2(3, 4), Vec2(-1, 2)};
  const Eigen::Matrix2d g = gradient(f, r0, ring);
  CHECK((g.col(0) - 0.5 * (ring[0] - ring[1])).norm() < 1e-15);
  CHECK(g.col(1).norm() == 0);
  const Eigen::Matrix2d k = winslow_matrix(g);
  const auto w = weights_of(f, k(0, 0), -k(0, 1), k(1, 1));
  CHECK(w[0] > 0);
  CHECK(w[0] == w[1]);
}

TEST_CASE("a VCV without area is refused") {
  const std::vector<Vec2> flat{Vec2(1, 0), Vec2(2, 0), Vec2(-1, 0)};
  const std::vector<Vec2> clockwise{Vec2(1, 0), Vec2(-1, -1), Vec2(-1, 1)};
  std::vector<NeighbourFunctionals> out(3);
  CHECK_THROWS_AS(compute_functionals(flat, out), NumericError);
  CHECK_THROWS_AS(compute_functionals(clockwise, out), NumericError);
}

TEST_CASE("functionals of a mesh: each free node's row is that of its own VCV") {
  const auto topology = Topology::build(square(6, Cells::mixed));
  VirtualControlVolumes vcv(topology);
  constexpr std::uint64_t seed = 7;
  CAPTURE(seed);
  Random random(seed);
  for (const Index node : topology->interior_nodes()) {
    const auto n = static_cast<Index>(topology->neighbours(node).size());
    if (random.index(2) == 0) continue;
    std::vector<double> lengths;
    for (Index k = 0; k < n; ++k) lengths.push_back(random.uniform(0.2, 4));
    vcv.set(node, random_angles(random, n), lengths);
  }
  const StencilFunctionals functionals(vcv);
  for (Index node = 0; node < topology->node_count(); ++node) {
    const auto row = functionals[node];
    REQUIRE(row.size() == topology->neighbours(node).size());
    if (topology->on_boundary(node)) {
      for (const auto& f : row) CHECK((f.dx == 0 && f.lxx == 0 && f.lyy == 0));
      continue;
    }
    std::vector<Vec2> points;
    for (Index k = 0; k < static_cast<Index>(row.size()); ++k) {
      points.push_back(vcv.point(node, k));
    }
    const auto expected = functionals_of(points);
    for (std::size_t k = 0; k < row.size(); ++k) {
      CHECK(row[k].dx == doctest::Approx(expected[k].dx));
      CHECK(row[k].dy == doctest::Approx(expected[k].dy));
      CHECK(row[k].lxx == doctest::Approx(expected[k].lxx));
      CHECK(row[k].lxy == doctest::Approx(expected[k].lxy));
      CHECK(row[k].lyy == doctest::Approx(expected[k].lyy));
    }
  }
}
