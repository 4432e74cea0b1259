#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/outer/energy_newton.h"

namespace winslow::test {
namespace {

/// One unknown u, of which the model says everywhere that the energy falls by 1 per unit and bends
/// by 1. In fact it falls by `fall` per unit: as where it has kinks, which no derivative tells of.
/// The residual is exp(-decay u). No step is longer than 0.02.
class Ramp final : public EnergyProblem {
 public:
  Ramp(double fall, double decay) : fall_(fall), decay_(decay) {
    auto pattern = std::make_shared<SparsityPattern>();
    pattern->offsets = {0, 1};
    pattern->columns = pattern->diagonal = {0};
    pattern_ = std::move(pattern);
  }

  std::string_view name() const override { return "ramp"; }
  std::size_t unknowns() const override { return 1; }
  void values(const Coordinates& x, std::span<double> out) const override { out[0] = u(x); }
  void lengths(const Coordinates&, std::span<double> out) const override { out[0] = 1; }
  double advance(std::span<const double> direction, double step, Coordinates& x) const override {
    x.set_xy(0, Vec2(u(x) + step * direction[0], 0));
    return std::abs(step * direction[0]);
  }
  void velocities(const Coordinates&, std::span<const double> rates,
                  Coordinates& out) const override {
    out.set_xy(0, Vec2(rates[0], 0));
  }
  double largest_valid_step(const Coordinates&, const Coordinates&, double most) const override {
    return std::min(most, 0.02 / 0.9);  // of which a line search takes 0.9
  }
  Validity validity(const Coordinates&) const override { return {0, 1}; }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override {
    if (!out.empty()) out[0] = 1;
    return {std::exp(-decay_ * u(x)), 1};
  }
  double residual_round_off(const Coordinates&) const override { return 0; }
  void boundary_response(const Coordinates&, const Coordinates&,
                         std::span<double> out) const override {
    out[0] = 0;
  }
  double energy(const Coordinates& x) const override { return 100 - fall_ * u(x); }
  Linearisation linearise(const Coordinates& x, Curvature, SparseMatrix& hessian,
                          std::span<double> out) const override {
    hessian.pattern = pattern_;
    hessian.block = 1;
    hessian.symmetric = true;
    hessian.values = {1};
    return {residual(x, out), energy(x)};
  }

 private:
  static double u(const Coordinates& x) { return x.xy(0).x(); }

  double fall_, decay_;
  std::shared_ptr<const SparsityPattern> pattern_;
};

/// Steps until the method says that it has stalled; -1: not within 200.
int steps_to_stall(EnergyNewton& newton, Coordinates& x) {
  newton.start(x);
  for (int k = 1; k <= 200; ++k) {
    CHECK(newton.step(x).damping == doctest::Approx(0.02));
    CHECK_FALSE(newton.converged());
    if (newton.stalled()) return k;
  }
  return -1;
}

int steps_to_stall(double fall, double decay) {
  const auto linear = make_linear_solver({.solver = "direct"});
  EnergyNewton newton(std::make_shared<const Ramp>(fall, decay), *linear, {});
  Coordinates x(2, 1);
  return steps_to_stall(newton, x);
}

}  // namespace

TEST_CASE("Newton's method ends where 40 steps gain next to nothing of what its model promises") {
  // 40 steps of 0.02 gain 8e-4 where the model promises 1 of a whole one.
  CHECK(steps_to_stall(1e-3, 0) == 41);
  // The same with a residual that falls by 4 % meanwhile.
  CHECK(steps_to_stall(1e-3, 0.05) == 41);
}

TEST_CASE("short steps alone, or a residual that falls, end no run") {
  CHECK(steps_to_stall(1, 0) == -1);       // 40 steps gain 0.8
  CHECK(steps_to_stall(0.2, 0) == -1);     // 0.16
  CHECK(steps_to_stall(1e-3, 0.2) == -1);  // nothing, but the residual falls by 15 %
}

TEST_CASE("a run that has stalled begins anew where it is started again") {
  const auto linear = make_linear_solver({.solver = "direct"});
  EnergyNewton newton(std::make_shared<const Ramp>(1e-3, 0), *linear, {});
  Coordinates x(2, 1);
  CHECK(steps_to_stall(newton, x) == 41);
  CHECK(steps_to_stall(newton, x) == 41);
}

}  // namespace winslow::test
