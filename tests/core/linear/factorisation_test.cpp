#include "core/linear/factorisation.h"

#include <doctest/doctest.h>

#include <functional>
#include <future>
#include <vector>

#include "support/meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("block matrices expand to scalar columns, whole or the lower triangle") {
  const Mesh mesh = make_mesh(square_with_hole(10, Cells::triangles));
  EigenMatrix all(EigenMatrix::Part::all), lower(EigenMatrix::Part::lower);
  Random random(1);
  for (const int block : {1, 2, 3}) {
    CAPTURE(block);
    SparseSystem system = random_system(random, 40, 1, block);
    CHECK(all.assign(system.matrix));
    CHECK(Dense(all.matrix()) == dense_matrix(system.matrix));
    CHECK(all.matrix().nonZeros() == static_cast<Eigen::Index>(system.matrix.values.size()));
    randomise(system, random);
    CHECK_FALSE(all.assign(system.matrix));
    CHECK(Dense(all.matrix()) == dense_matrix(system.matrix));

    const SparseSystem symmetric = springs(mesh, random, block);
    CHECK(lower.assign(symmetric.matrix));
    CHECK_FALSE(lower.assign(symmetric.matrix));
    Dense expected = dense_matrix(symmetric.matrix);
    expected = expected.triangularView<Eigen::Lower>();
    CHECK(Dense(lower.matrix()) == expected);
    // Rows ascend within columns: the solvers rely on it.
    for (const auto* m : {&all.matrix(), &lower.matrix()}) {
      for (Eigen::Index c = 0; c < m->cols(); ++c) {
        for (Index k = m->outerIndexPtr()[c] + 1; k < m->outerIndexPtr()[c + 1]; ++k) {
          REQUIRE(m->innerIndexPtr()[k - 1] < m->innerIndexPtr()[k]);
        }
      }
    }
  }
}

TEST_CASE("factorisations on several threads at once have the bits of one alone") {
  const SparseSystem system = elasticity(make_mesh(square_with_hole(60, Cells::triangles)));
  // Large enough for the dense kernels of both.
  const auto make_large_lu = [] { return make_lu(100'000); };
  for (const auto& make : {std::function(make_cholesky), std::function(make_large_lu)}) {
    const auto solved = [&] {
      const auto factorisation = make();
      std::vector<double> x(system.rhs.size());
      for (int repeat = 0; repeat < 3; ++repeat) {
        factorisation->factorise(system.matrix);
        factorisation->solve(system.rhs, system.columns, x);
      }
      return x;
    };
    CAPTURE(make()->description());
    const std::vector<double> alone = solved();
    std::vector<std::future<std::vector<double>>> at_once;
    for (int thread = 0; thread < 4; ++thread)
      at_once.push_back(std::async(std::launch::async, solved));
    for (auto& one : at_once) CHECK(one.get() == alone);
  }
}
