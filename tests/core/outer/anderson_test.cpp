#include "core/outer/picard_solver.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// x <- x + f(x) with f(x) = b - A x, a linear fixed-point iteration.
struct Linear {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};

Linear random_linear(Random& random, Eigen::Index n) {
  Linear l{Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    l.b[i] = random.uniform(-1, 1);
    for (Eigen::Index j = 0; j < n; ++j) l.a(i, j) += 0.3 * random.uniform(-1, 1);
  }
  return l;
}

/// Norm of the step after some iterations.
double remaining(const Linear& l, int depth, int iterations) {
  const auto n = static_cast<std::size_t>(l.b.size());
  AndersonAcceleration anderson(depth, std::vector<double>(n, 1.0));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(l.b.size());
  for (int k = 0; k < iterations; ++k) {
    Eigen::VectorXd step = l.b - l.a * x;
    anderson.accelerate({x.data(), n}, {step.data(), n});
    x += step;
  }
  return (l.b - l.a * x).norm();
}

}  // namespace

TEST_CASE("on a linear iteration as many differences as unknowns give the solution") {
  // Like GMRES: n + 1 steps are exact in exact arithmetic.
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    Random random(seed);
    const Linear l = random_linear(random, 8);
    CHECK(remaining(l, 8, 12) < 1e-9);
    CHECK(remaining(l, 3, 12) < l.b.norm());
  }
}

TEST_CASE("the first step and a step after a reset are plain") {
  AndersonAcceleration anderson(5, {1, 1});
  const std::vector<double> x{0, 0}, y{1, 1};
  std::vector<double> step{0.5, -0.25};
  anderson.accelerate(x, step);
  CHECK(step == std::vector<double>{0.5, -0.25});
  std::vector<double> second{0.25, -0.5};
  anderson.accelerate(y, second);
  CHECK(second != std::vector<double>{0.25, -0.5});
  anderson.reset();
  step = {0.1, 0.2};
  anderson.accelerate(x, step);
  CHECK(step == std::vector<double>{0.1, 0.2});
}

TEST_CASE("equal iterates do not break it") {
  AndersonAcceleration anderson(5, {1, 2, 3});
  const std::vector<double> x{1, 2, 3};
  for (int k = 0; k < 6; ++k) {
    std::vector<double> step{0.1, 0.2, 0.3};
    anderson.accelerate(x, step);
    for (const double s : step) CHECK(std::isfinite(s));
  }
}

TEST_CASE("weights decide which components the combination annuls") {
  // Two differences that cannot annul both components: the heavy one wins.
  for (const bool heavy_first : {true, false}) {
    AndersonAcceleration anderson(
        1, heavy_first ? std::vector<double>{1e6, 1} : std::vector<double>{1, 1e6});
    std::vector<double> f0{1, 1}, f1{0.5, 0.25};
    anderson.accelerate(std::vector<double>{0, 0}, f0);
    anderson.accelerate(std::vector<double>{1, 1}, f1);
    // gamma annuls f1 - gamma (f1 - f0) in the heavy component: -1 or -1/3.
    const double gamma = heavy_first ? -1 : -1.0 / 3;
    CHECK(f1[0] == doctest::Approx(0.5 - gamma * (1 - 0.5)).epsilon(1e-6));
    CHECK(f1[1] == doctest::Approx(0.25 - gamma * (1 - 0.75)).epsilon(1e-6));
  }
}
