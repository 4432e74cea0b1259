#include <doctest/doctest.h>

#include <algorithm>

#include "core/command/command.h"
#include "support/samples.h"

using namespace winslow;
using namespace winslow::test;

namespace {

SmoothOptions by_energy() {
  SmoothOptions options;
  options.targets = TargetBlend::regular();  // which do not depend on the mesh as given
  options.untangle = Untangle::energy;
  options.threads = 1;
  return options;
}

/// The energy alone: no iteration of the fixed point.
bool without_fixed_point(const SmoothResult& result) {
  return std::none_of(result.history.begin(), result.history.end(),
                      [](const IterationRecord& r) { return r.stage == Stage::picard; });
}

}  // namespace

TEST_CASE("the energy alone undoes a scramble: the same mesh as from a valid start") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    MeshState state = make_state(make_mesh(annulus(32, 26, 1.2, cells)));
    const CommandResult straight = execute(SmoothCommand{by_energy()}, state);
    REQUIRE(straight.smooth.converged);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      CAPTURE(name_of(cells));
      CAPTURE(seed);
      Random random(seed);
      tangle(state.mesh, random);
      const CommandResult result = execute(SmoothCommand{by_energy()}, state);
      CHECK(result.smooth.inverted == 0);
      CHECK(result.smooth.converged);
      CHECK(without_fixed_point(result.smooth));
      CHECK(largest_difference(result.state.mesh.coordinates, straight.state.mesh.coordinates) <
            1e-6);
    }
  }
}

TEST_CASE("where the energy is stuck with the interior as given, the harmonic interior helps") {
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    CAPTURE(name_of(cells));
    const MeshState state = make_state(make_mesh(annulus(32, 26, 1.2, cells)));
    MoveCommand command;
    command.markers = {"inner"};
    command.motion.rotate = 90;
    command.how.increments = 1;
    command.smooth = by_energy();
    const CommandResult result = execute(command, state);
    CHECK(result.smooth.inverted == 0);
    CHECK(result.smooth.converged);
    CHECK(without_fixed_point(result.smooth));
  }
}
