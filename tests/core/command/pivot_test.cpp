#include <doctest/doctest.h>

#include <array>
#include <span>

#include "core/command/command.h"
#include "support/meshes.h"

/// Rotations that name no pivot.
namespace winslow::test {

TEST_CASE("without a pivot all markers turn about the centre of them all, wherever they are") {
  MeshData data = square_with_two_holes(20, Cells::triangles);
  const Vec2 away(1000, -400);  // chords
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + away);
  const MeshState state = make_state(make_mesh(data));
  MoveCommand command;
  command.markers = {"hole_a", "hole_b"};
  command.motion.rotate = 20;
  const CommandResult result = execute(command, state);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
  MoveCommand named = command;
  named.motion.pivot = away + Vec2(0.5, 0.5);
  Coordinates expected = state.mesh.coordinates;
  make_motion(*state.mesh.topology, expected, named.markers, named.motion.about({0, 0}))
      ->apply(state.mesh.coordinates, 1, expected);
  for (Index i = 0; i < expected.size(); ++i) {
    if (!state.mesh.topology->on_boundary(i)) continue;
    CHECK((result.state.mesh.coordinates.xy(i) - expected.xy(i)).norm() < 1e-12 * away.norm());
  }
}

TEST_CASE("the pivot that is left open is that of all meshes that a command is about") {
  MeshData data = square_with_two_holes(10, Cells::quads);
  const MeshState here = make_state(make_mesh(data));
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + Vec2(10, 4));
  const MeshState there = make_state(make_mesh(data));
  MoveCommand command;
  command.markers = {"hole_a"};
  const std::array<const MeshState*, 2> both{&here, &there};
  const auto pivot = [&](std::span<const MeshState* const> states) {
    return std::get<MoveCommand>(with_pivot(command, states)).motion.pivot;
  };
  REQUIRE(pivot(both).has_value());
  CHECK(pivot(both)->isApprox(Vec2(5.3, 2.5)));
  CHECK(pivot(std::span(both).first(1))->isApprox(Vec2(0.3, 0.5)));
  command.motion.pivot = Vec2(0, 0);
  CHECK(pivot(both) == Vec2(0, 0));
  command.motion.pivot.reset();
  command.markers = {"nobody"};
  CHECK_FALSE(pivot(both).has_value());
}

}  // namespace winslow::test
