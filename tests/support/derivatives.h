#pragma once

#include <doctest/doctest.h>

#include <vector>

#include "core/formulation/variational_form.h"
#include "support/random.h"

namespace winslow::test {

/// u . A u.
inline double product(const SparseMatrix& a, const std::vector<double>& u) {
  const auto block = static_cast<std::size_t>(a.block);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < a.pattern->offsets.size(); ++i) {
    for (auto e = static_cast<std::size_t>(a.pattern->offsets[i]);
         e < static_cast<std::size_t>(a.pattern->offsets[i + 1]); ++e) {
      const auto j = static_cast<std::size_t>(a.pattern->columns[e]);
      for (std::size_t r = 0; r < block; ++r)
        for (std::size_t c = 0; c < block; ++c)
          sum += u[i * block + r] * a.values[(e * block + r) * block + c] * u[j * block + c];
    }
  }
  return sum;
}

/// A direction over the unknowns, zero where a number stands for nothing.
inline std::vector<double> direction(const VariationalForm& form, const NodeClasses& classes,
                                     const Coordinates& x, Random& random, double size) {
  std::vector<double> u(form.unknowns());
  const auto d = static_cast<std::size_t>(x.dimension());
  std::size_t row = 0;
  for (Index node = 0; node < x.size(); ++node) {
    const int unknowns = classes.unknowns(node);
    if (unknowns == 0) continue;
    for (std::size_t k = 0; k < static_cast<std::size_t>(unknowns); ++k)
      u[row * d + k] = size * random.uniform(-1, 1);
    ++row;
  }
  return u;
}

/// The residual and the Hessian of a form at x against differences of its energy. edge: of the
/// mesh; how far the differences reach.
inline void check_derivatives(const VariationalForm& form, const NodeClasses& classes,
                              const Coordinates& x, double edge) {
  Random random(5);
  SparseMatrix hessian;
  std::vector<double> residual(form.unknowns());
  form.linearise(x, Curvature::exact, hessian, residual);
  for (int run = 0; run < 6; ++run) {
    const auto u = direction(form, classes, x, random, edge);
    const auto energy = [&](double t) {
      Coordinates y = x;
      form.advance(u, t, y);
      return form.energy(y);
    };
    double slope = 0;
    for (std::size_t i = 0; i < u.size(); ++i) slope -= residual[i] * u[i];
    constexpr double h = 1e-4;
    CHECK((energy(h) - energy(-h)) / (2 * h) == doctest::Approx(slope).epsilon(1e-6));
    const double curvature = product(hessian, u);
    constexpr double step = 2e-3;
    CHECK((energy(step) - 2 * energy(0) + energy(-step)) / (step * step) ==
          doctest::Approx(curvature).epsilon(2e-4));
  }
}

}  // namespace winslow::test
