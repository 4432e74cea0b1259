#include "core/linear/factorisation.h"

#include <doctest/doctest.h>

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
