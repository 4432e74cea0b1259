#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "support/surface_meshes.h"

/// Surfaces with a sharp edge that is no feature line: the energy has no derivative there.
namespace winslow::test {
namespace {

/// z = -slope |x|, nearest places: two half planes.
Shape roof(double slope) {
  return [=](const Vec3& p) {
    const auto on_side = [&](double sign) {
      const Vec3 along = Vec3(sign, 0, -slope).normalized();
      const double t = std::max(0.0, p.dot(along));
      return ShapePoint{t * along + Vec3(0, p.y(), 0), Vec3(sign * slope, 0, 1).normalized()};
    };
    const ShapePoint left = on_side(-1), right = on_side(1);
    return (left.point - p).norm() < (right.point - p).norm() ? left : right;
  };
}

/// The smallest elements along the ridge are those of a column of nodes close to it.
MeshState mesh_on_roof(double shift) {
  constexpr double slope = 4;
  const auto place = [&](const Vec2& p) -> Vec3 {
    const double x = 2 * p.x() - 1 + shift;
    return {x, p.y(), -slope * std::abs(x)};
  };
  return on_shape(make_mesh(lifted(square(8, Cells::triangles), place)), roof(slope));
}

/// Cancels within an iteration, and never after one.
class CancelsWithin final : public SolverMonitor {
 public:
  bool on_iteration(const IterationRecord&, const Coordinates&) override { return true; }
  bool cancelled() override { return true; }
};

}  // namespace

TEST_CASE("nodes that stop at a fold of the surface are held there, and the others converge") {
  for (const double shift : {0.02, 0.05, 0.08}) {
    CAPTURE(shift);
    const MeshState state = mesh_on_roof(shift);
    SmoothCommand command;
    command.smooth.threads = 1;
    const SmoothResult result = execute(command, state).smooth;
    CHECK(result.converged);
    CHECK(result.inverted == 0);
    CHECK(result.stuck_nodes > 0);
  }
}

TEST_CASE("a run is cancelled while it looks for stuck nodes, too") {
  CancelsWithin monitor;
  RunOptions options;
  options.monitor = &monitor;
  CHECK_THROWS_AS(execute(SmoothCommand{}, mesh_on_roof(0.05), options), Cancelled);
}

}  // namespace winslow::test
