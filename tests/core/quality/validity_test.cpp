#include "core/quality/validity.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("the first positive root of a quadratic") {
  CHECK(first_positive_root(1, -2, 0) == 0.5);
  CHECK(first_positive_root(2, -3, 1) == doctest::Approx(1));
  CHECK(first_positive_root(1, 1, -2) == doctest::Approx(1));
  CHECK(std::isinf(first_positive_root(1, 0, 0)));
  CHECK(std::isinf(first_positive_root(1, 1, 1)));
  CHECK(std::isinf(first_positive_root(1, 2, 1)));
  // No cancellation: the small root of 1 - 1e9 t + t^2.
  CHECK(first_positive_root(1, -1e9, 1) == doctest::Approx(1e-9).epsilon(1e-14));
}

namespace {
constexpr double unlimited = std::numeric_limits<double>::infinity();
}

TEST_CASE("the largest valid step is where the first corner loses its area") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    for (std::uint64_t seed = 1; seed < 12; ++seed) {
      Random random(seed);
      const Mesh mesh = make_mesh(square(8, cells));
      Coordinates to = mesh.coordinates;
      for (const Index node : mesh.topology->interior_nodes()) {
        to.set_xy(node, to.xy(node) + 0.5 * random.vector());
      }
      const double step = largest_valid_step(*mesh.topology, mesh.coordinates, to, unlimited, 2);
      CHECK(largest_valid_step(*mesh.topology, mesh.coordinates, to, 0.5 * step, 2) == 0.5 * step);
      CHECK(largest_valid_step(*mesh.topology, mesh.coordinates, to, 2 * step, 2) == step);
      REQUIRE(std::isfinite(step));
      const auto inverted = [&](double t) {
        Coordinates x = mesh.coordinates;
        for (Index i = 0; i < x.size(); ++i) x.set_xy(i, x.xy(i) + t * (to.xy(i) - x.xy(i)));
        return check_validity(*mesh.topology, x, 1).inverted;
      };
      for (double t = 0; t < step; t += step / 64) CHECK(inverted(t) == 0);
      CHECK(inverted(step * (1 - 1e-9)) == 0);
      CHECK(inverted(step * (1 + 1e-6)) > 0);
    }
  }
}

TEST_CASE("a tangled mesh has no valid step") {
  Random random(1);
  Mesh mesh = make_mesh(square(6, Cells::triangles));
  const Coordinates valid = mesh.coordinates;
  tangle(mesh, random);
  CHECK(largest_valid_step(*mesh.topology, mesh.coordinates, valid) == 0);
}
