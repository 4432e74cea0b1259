#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/linear/linear_solver.h"
#include "support/meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Mesh small_mesh() { return make_mesh(square_with_hole(15, Cells::triangles)); }

/// A - shift I.
SparseSystem shifted(SparseSystem system, double shift) {
  SparseMatrix& a = system.matrix;
  for (Index i = 0; i < a.pattern->rows(); ++i) {
    add_block(a, i, i, -shift * Dense::Identity(a.block, a.block));
  }
  return system;
}

double smallest_eigenvalue_of(const SparseMatrix& matrix) {
  return Eigen::SelfAdjointEigenSolver<Dense>(dense_matrix(matrix)).eigenvalues()[0];
}

/// The same pattern, every entry changed by up to `share` of itself, symmetrically.
SparseSystem nearby(const SparseSystem& system, double share, Random& random) {
  SparseSystem result = system;
  const Dense old = dense_matrix(system.matrix);
  const Index block = system.matrix.block;
  const SparsityPattern& p = *system.matrix.pattern;
  for (Index i = 0; i < p.rows(); ++i) {
    for (Index e = p.offsets[at(i)]; e < p.offsets[at(i) + 1]; ++e) {
      const Index j = p.columns[at(e)];
      if (j > i) continue;
      const double factor = share * random.uniform(-1, 1);
      const Dense change = factor * old.block(i * block, j * block, block, block);
      add_block(result.matrix, i, j, change);
      if (j < i) add_block(result.matrix, j, i, change.transpose());
    }
  }
  return result;
}

}  // namespace

TEST_CASE("every solver solves symmetric systems of one, two and three unknowns a row") {
  const Mesh mesh = small_mesh();
  for (const int block : {1, 2, 3}) {
    for (const std::string& name : linear_solver_names()) {
      CAPTURE(block);
      CAPTURE(name);
      constexpr std::uint64_t seed = 3;
      CAPTURE(seed);
      Random random(seed);
      const auto solver = make_linear_solver(tight_linear(name));
      for (int round = 0; round < 2; ++round) {
        const SparseSystem system = springs(mesh, random, block, 0.1, 3);
        std::vector<double> x(system.rhs.size(), 0.0);
        const LinearResult result = solve(*solver, system, x);
        const Dense expected = dense_solution(system);
        CHECK((as_matrix(system, x) - expected).norm() < 1e-8 * expected.norm());
        CHECK(result.relative_residual < 1e-10);
        CHECK(result.relative_residual < 2 * dense_relative_residual(system, x) + 1e-15);
        CHECK(solver->name() == name);
        CHECK(solver->description().size() > 5);
      }
    }
  }
}

TEST_CASE("blocks of unsymmetric systems") {
  for (const int block : {1, 2, 3}) {
    for (const std::string& name : general_solver_names()) {
      CAPTURE(block);
      CAPTURE(name);
      constexpr std::uint64_t seed = 5;
      CAPTURE(seed);
      Random random(seed);
      const SparseSystem system = random_system(random, 70, 2, block);
      std::vector<double> x(system.rhs.size(), 0.0);
      const LinearResult result = solve(*make_linear_solver(tight_linear(name)), system, x);
      const Dense expected = dense_solution(system);
      CHECK((as_matrix(system, x) - expected).norm() < 1e-9 * expected.norm());
      CHECK(result.relative_residual < 1e-11);
    }
  }
}

TEST_CASE("one solver takes other block sizes, symmetries and patterns in turn") {
  const Mesh one = small_mesh(), two = make_mesh(square(9, Cells::triangles));
  for (const std::string& name : general_solver_names()) {
    CAPTURE(name);
    constexpr std::uint64_t seed = 7;
    CAPTURE(seed);
    Random random(seed);
    std::vector<SparseSystem> systems;
    for (const Mesh* mesh : {&one, &two}) {
      for (const int block : {1, 2}) {
        systems.push_back(springs(*mesh, random, block, 0.1));
        // The same pattern object with other blocks, and without symmetry.
        systems.push_back(systems.back());
        systems.back().matrix.block = 3 - block;
        systems.back().matrix.symmetric = false;
        randomise(systems.back(), random);
      }
    }
    const auto solver = make_linear_solver(tight_linear(name));
    for (const SparseSystem& system : systems) {
      std::vector<double> x(system.rhs.size(), 0.0);
      solve(*solver, system, x);
      const Dense expected = dense_solution(system);
      CHECK((as_matrix(system, x) - expected).norm() < 1e-8 * expected.norm());
    }
  }
}

TEST_CASE("a matrix that is not positive definite is told, and the solver lives on") {
  const Mesh mesh = make_mesh(square(20, Cells::triangles));
  const SparseSystem good = elasticity(mesh);
  const double smallest = smallest_eigenvalue_of(good.matrix);
  // Barely indefinite: every diagonal block still looks well; then hopelessly.
  for (const double shift : {1.5 * smallest, 20 * smallest, 30.0}) {
    const SparseSystem bad = shifted(good, shift);
    REQUIRE(smallest_eigenvalue_of(bad.matrix) < 0);
    for (const std::string name : {"automatic", "direct", "cg", "multigrid"}) {
      CAPTURE(name);
      CAPTURE(shift);
      const auto solver = make_linear_solver(tight_linear(name));
      std::vector<double> x(good.rhs.size(), 0.0);
      CHECK_THROWS_AS(solve(*solver, bad, x), NotPositiveDefinite);
      for (int round = 0; round < 2; ++round) {
        std::fill(x.begin(), x.end(), 0.0);
        const LinearResult result = solve(*solver, good, x);
        CHECK(result.relative_residual < 1e-11);
        const Dense expected = dense_solution(good);
        CHECK((as_matrix(good, x) - expected).norm() < 1e-8 * expected.norm());
        CHECK_THROWS_AS(solve(*solver, bad, x), NotPositiveDefinite);
      }
    }
  }
}

TEST_CASE("a factor or a preconditioner that is kept solves the new system, not the old one") {
  const Mesh mesh = small_mesh();
  for (const std::string& name : linear_solver_names()) {
    for (const bool symmetric : {true, false}) {
      if (!symmetric && linear_solver_needs_symmetry(name)) continue;
      CAPTURE(name);
      CAPTURE(symmetric);
      constexpr std::uint64_t seed = 11;
      CAPTURE(seed);
      Random random(seed);
      SparseSystem first = springs(mesh, random, 2, 0.1, 2);
      if (!symmetric) {
        first.matrix.symmetric = false;
        randomise(first, random);
      }
      const SparseSystem second = nearby(first, 0.02, random);
      LinearOptions options = tight_linear(name);
      const auto solver = make_linear_solver(options);
      std::vector<double> x(first.rhs.size(), 0.0);
      solve(*solver, first, x);
      std::fill(x.begin(), x.end(), 0.0);
      solver->set_matrix(second.matrix, true);
      const LinearResult kept = solver->solve(second.rhs, 2, x);
      const Dense expected = dense_solution(second);
      CHECK((as_matrix(second, x) - expected).norm() < 1e-8 * expected.norm());
      CHECK(kept.relative_residual < 1e-10);
      if (name != "direct") continue;
      CHECK(kept.iterations > 1);
      CHECK(kept.iterations < 40);
      // A looser tolerance takes fewer iterations; a new factor none.
      solver->set_tolerance(1e-2);
      std::fill(x.begin(), x.end(), 0.0);
      const LinearResult loose = solver->solve(second.rhs, 2, x);
      CHECK(loose.iterations < kept.iterations);
      CHECK(loose.relative_residual <= 1e-2);
      CHECK(loose.relative_residual > 1e-12);
      solver->set_matrix(second.matrix);
      CHECK(solver->solve(second.rhs, 2, x).iterations == 1);
    }
  }
}

TEST_CASE("keep without anything to keep is no keep") {
  const Mesh mesh = small_mesh(), other = make_mesh(square(9, Cells::triangles));
  for (const std::string& name : linear_solver_names()) {
    CAPTURE(name);
    Random random(13);
    const auto solver = make_linear_solver(tight_linear(name));
    for (const Mesh* m : {&mesh, &other}) {
      for (const int block : {1, 2}) {
        const SparseSystem system = springs(*m, random, block, 0.1);
        std::vector<double> x(system.rhs.size(), 0.0);
        solver->set_matrix(system.matrix, true);
        const LinearResult result = solver->solve(system.rhs, 1, x);
        CHECK(dense_relative_residual(system, x) < 1e-10);
        if (name == "direct") CHECK(result.iterations == 1);
      }
    }
  }
}

TEST_CASE("a factor too old to be of use is replaced") {
  const Mesh mesh = small_mesh();
  Random random(17);
  const SparseSystem first = springs(mesh, random, 2), second = springs(mesh, random, 2);
  SparseSystem same_pattern = second;
  same_pattern.matrix.pattern = first.matrix.pattern;
  LinearOptions options = tight_linear("direct");
  options.max_iterations = 3;
  const auto solver = make_linear_solver(options);
  std::vector<double> x(first.rhs.size(), 0.0);
  solve(*solver, first, x);
  solver->set_matrix(same_pattern.matrix, true);
  const LinearResult result = solver->solve(same_pattern.rhs, 1, x);
  CHECK(result.iterations == 1);
  CHECK(dense_relative_residual(same_pattern, x) < 1e-10);
  // An indefinite matrix shows with an old factor as well.
  const SparseSystem bad = shifted(same_pattern, 1);
  solver->set_matrix(bad.matrix, true);
  CHECK_THROWS_AS(solver->solve(bad.rhs, 1, x), NotPositiveDefinite);
  solver->set_matrix(first.matrix, true);
  CHECK(solver->solve(first.rhs, 1, x).relative_residual < 1e-10);
}

TEST_CASE("solvers for symmetric matrices say what to use for others") {
  Random random(19);
  const SparseSystem system = random_system(random, 10);
  for (const std::string& name : linear_solver_names()) {
    CAPTURE(name);
    const auto solver = make_linear_solver(tight_linear(name));
    if (linear_solver_needs_symmetry(name)) {
      CHECK_THROWS_WITH_AS(solver->set_matrix(system.matrix), doctest::Contains("use automatic"),
                           UsageError);
    } else {
      CHECK_NOTHROW(solver->set_matrix(system.matrix));
    }
  }
  CHECK(general_solver_names().size() == 4);
}

TEST_CASE("a system without unknowns") {
  SparseSystem empty;
  empty.matrix.pattern = std::make_shared<SparsityPattern>();
  empty.matrix.block = 2;
  for (const bool symmetric : {true, false}) {
    empty.matrix.symmetric = symmetric;
    for (const std::string& name : symmetric ? linear_solver_names() : general_solver_names()) {
      CAPTURE(name);
      std::vector<double> x;
      CHECK(solve(*make_linear_solver(tight_linear(name)), empty, x).relative_residual == 0);
    }
  }
}

TEST_CASE("a right-hand side of zero and one that is met at the start take no iterations") {
  const Mesh mesh = small_mesh();
  for (const std::string name : {"cg", "multigrid", "gmres"}) {
    CAPTURE(name);
    Random random(23);
    SparseSystem system = springs(mesh, random, 2, 0.1);
    const auto solver = make_linear_solver(tight_linear(name));
    std::vector<double> x(system.rhs.size(), 0.0);
    solve(*solver, system, x);
    solver->set_tolerance(1e-6);
    const std::vector<double> solution = x;
    CHECK(solver->solve(system.rhs, 1, x).iterations == 0);
    CHECK(x == solution);
    std::fill(system.rhs.begin(), system.rhs.end(), 0.0);
    CHECK(solver->solve(system.rhs, 1, x).iterations == 0);
    CHECK(x == std::vector<double>(x.size(), 0.0));
  }
}
