#include "core/linear/linear_solver.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/linear/krylov.h"
#include "core/linear/vector_operations.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("every solver solves what a dense solver solves, with the same object again and again") {
  for (const std::string& name : general_solver_names()) {
    CAPTURE(name);
    const auto solver = make_linear_solver(tight_linear(name));
    CHECK(solver->name() == name);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      CAPTURE(seed);
      Random random(seed);
      // A new pattern with every seed, then new values in the same pattern.
      SparseSystem system = random_system(random, 40 + 30 * static_cast<Index>(seed));
      for (int round = 0; round < 3; ++round) {
        CAPTURE(round);
        std::vector<double> x(system.rhs.size(), 0.0);
        const LinearResult result = solve(*solver, system, x);
        CHECK((as_matrix(system, x) - dense_solution(system)).norm() < 1e-9);
        CHECK(result.relative_residual < 1e-10);
        CHECK(result.relative_residual ==
              doctest::Approx(dense_relative_residual(system, x)).epsilon(1e-2));
        CHECK(result.iterations >= 1);
        randomise(system, random);
      }
    }
  }
}

TEST_CASE("the reported residual is the true one also when the solver stops early") {
  for (const std::string& name : {std::string("gmres"), std::string("point-implicit")}) {
    CAPTURE(name);
    constexpr std::uint64_t seed = 17;
    CAPTURE(seed);
    Random random(seed);
    const SparseSystem system = random_system(random, 300);
    LinearOptions options = tight_linear(name);
    options.max_iterations = 2;
    std::vector<double> x(system.rhs.size(), 0.0);
    const LinearResult result = solve(*make_linear_solver(options), system, x);
    CHECK(result.iterations <= 2);
    CHECK(result.relative_residual > 1e-12);
    CHECK(result.relative_residual ==
          doctest::Approx(dense_relative_residual(system, x)).epsilon(1e-6));
  }
}

TEST_CASE("iterative solvers stop at the tolerance and start from the guess") {
  for (const std::string& name : {std::string("gmres"), std::string("point-implicit")}) {
    CAPTURE(name);
    constexpr std::uint64_t seed = 23;
    CAPTURE(seed);
    Random random(seed);
    const SparseSystem system = random_system(random, 300);
    LinearOptions options = tight_linear(name);
    std::vector<double> x(system.rhs.size(), 0.0);
    const LinearResult cold = solve(*make_linear_solver(options), system, x);
    std::vector<double> again = x;
    const LinearResult warm = solve(*make_linear_solver(options), system, again);
    CHECK(warm.relative_residual <= 10 * options.tolerance);
    if (name == "point-implicit") CHECK(warm.iterations == 0);
    options.tolerance = 1e-3;
    std::vector<double> rough(system.rhs.size(), 0.0);
    const LinearResult loose = solve(*make_linear_solver(options), system, rough);
    CHECK(loose.relative_residual < 1e-2);
    CHECK(loose.iterations < cold.iterations);
    options.max_iterations = 1;
    std::vector<double> from_exact = x;
    const LinearResult one = solve(*make_linear_solver(options), system, from_exact);
    CHECK(one.relative_residual < 1e-10);
  }
}

TEST_CASE("a right-hand side of zero gives zero") {
  for (const std::string& name : general_solver_names()) {
    CAPTURE(name);
    constexpr std::uint64_t seed = 29;
    CAPTURE(seed);
    Random random(seed);
    SparseSystem system = random_system(random, 50);
    // One column of zeros beside one that is not, then both.
    for (std::size_t i = 0; i < system.rhs.size(); i += 2) system.rhs[i] = 0;
    std::vector<double> x(system.rhs.size(), 0.0);
    const LinearResult one = solve(*make_linear_solver(tight_linear(name)), system, x);
    CHECK(one.relative_residual < 1e-10);
    for (std::size_t i = 0; i < x.size(); i += 2) CHECK(x[i] == 0);
    std::fill(system.rhs.begin(), system.rhs.end(), 0.0);
    std::fill(x.begin(), x.end(), 0.0);
    const LinearResult both = solve(*make_linear_solver(tight_linear(name)), system, x);
    CHECK(both.relative_residual == 0);
    for (const double v : x) CHECK(v == 0);
  }
}

TEST_CASE("one right-hand side or three are as good as two") {
  for (const std::string& name : general_solver_names()) {
    for (const int columns : {1, 3}) {
      CAPTURE(name);
      CAPTURE(columns);
      constexpr std::uint64_t seed = 31;
      CAPTURE(seed);
      Random random(seed);
      const SparseSystem system = random_system(random, 60, columns);
      std::vector<double> x(system.rhs.size(), 0.0);
      solve(*make_linear_solver(tight_linear(name)), system, x);
      CHECK((as_matrix(system, x) - dense_solution(system)).norm() < 1e-9);
    }
  }
}

TEST_CASE("a singular matrix throws or owns up to its residual, and the solver lives on") {
  for (const std::string& name : general_solver_names()) {
    for (const bool zero_row : {true, false}) {
      CAPTURE(name);
      CAPTURE(zero_row);
      constexpr std::uint64_t seed = 37;
      CAPTURE(seed);
      Random random(seed);
      SparseSystem system = random_system(random, 30);
      const SparseSystem good = system;
      const SparsityPattern& p = *system.matrix.pattern;
      if (zero_row) {
        for (auto e = static_cast<std::size_t>(p.offsets[4]);
             e < static_cast<std::size_t>(p.offsets[5]); ++e) {
          system.matrix.values[e] = 0;
        }
      } else {
        // Row sums of zero: constants are in the kernel, the right-hand side is not in the range.
        for (std::size_t i = 0; i + 1 < p.offsets.size(); ++i) {
          double sum = 0;
          const auto d = static_cast<std::size_t>(p.diagonal[i]);
          for (auto e = static_cast<std::size_t>(p.offsets[i]);
               e < static_cast<std::size_t>(p.offsets[i + 1]); ++e) {
            if (e == d) continue;
            system.matrix.values[e] = -std::abs(system.matrix.values[e]);
            sum += system.matrix.values[e];
          }
          system.matrix.values[d] = -sum;
        }
        std::fill(system.rhs.begin(), system.rhs.end(), 1.0);
      }
      const auto solver = make_linear_solver(tight_linear(name));
      std::vector<double> x(system.rhs.size(), 0.0);
      bool threw = false;
      LinearResult result;
      try {
        result = solve(*solver, system, x);
      } catch (const NumericError&) {
        threw = true;
      }
      CHECK((threw || !(result.relative_residual < 1e-6)));
      std::vector<double> y(good.rhs.size(), 0.0);
      solve(*solver, good, y);
      CHECK((as_matrix(good, y) - dense_solution(good)).norm() < 1e-9);
    }
  }
}

TEST_CASE("a solution that is not finite never passes for an exact one") {
  constexpr std::uint64_t seed = 41;
  CAPTURE(seed);
  Random random(seed);
  const SparseSystem system = random_system(random, 10);
  std::vector<double> x(system.rhs.size(), 0.0);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    x[7] = bad;
    CHECK_FALSE(relative_residual(system.matrix, system.rhs, system.columns, x) < 1);
  }
}

TEST_CASE("a system of one unknown") {
  for (const std::string& name : general_solver_names()) {
    CAPTURE(name);
    auto pattern = std::make_shared<SparsityPattern>();
    pattern->offsets = {0, 1};
    pattern->columns = {0};
    pattern->diagonal = {0};
    const SparseSystem system{{pattern, 1, false, false, {4.0}}, 2, {8.0, -2.0}};
    std::vector<double> x(2, 0.0);
    solve(*make_linear_solver(tight_linear(name)), system, x);
    CHECK(x[0] == doctest::Approx(2));
    CHECK(x[1] == doctest::Approx(-0.5));
  }
}

TEST_CASE("solvers are known by name and described") {
  CHECK(linear_solver_names() == std::vector<std::string>{"automatic", "direct", "cg", "multigrid",
                                                          "gmres", "point-implicit"});
  for (const std::string& name : linear_solver_names()) {
    CHECK(linear_solver_summary(name).size() > 20);
  }
  LinearOptions options;
  options.solver = "magic";
  CHECK_THROWS_WITH_AS(make_linear_solver(options),
                       "unknown linear solver 'magic', expected one of: automatic, direct, cg, "
                       "multigrid, gmres, point-implicit",
                       UsageError);
  CHECK_THROWS_AS(linear_solver_summary(""), UsageError);
}

TEST_CASE("a checkpoint ends a solve between two of its iterations, however many it may make") {
  constexpr std::uint64_t seed = 5;
  CAPTURE(seed);
  for (const std::string name : {"gmres", "point-implicit", "cg", "multigrid"}) {
    CAPTURE(name);
    Random random(seed);
    const SparseSystem system =
        linear_solver_needs_symmetry(name)
            ? springs(make_mesh(square(16, Cells::triangles)), random, 2, 0.1)
            : random_system(random, 300);
    LinearOptions options;
    options.solver = name;
    options.tolerance = 0;  // never reached
    options.max_iterations = 100'000;
    const auto solver = make_linear_solver(options);
    std::vector<double> x(system.rhs.size(), 0.0);
    int asked = 0;
    {
      const LinearCheckpoint checkpoint([&] {
        if (++asked == 3) throw Cancelled();
      });
      CHECK_THROWS_AS(solve(*solver, system, x), Cancelled);
      CHECK(asked == 3);
      const LinearCheckpoint inner([] {});  // asks nothing, as long as it is there
      solver->set_tolerance(1e-2);
      CHECK_NOTHROW(solve(*solver, system, x));
    }
    CHECK(asked == 3);
  }
}
