#include "core/strategy/untangling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/samples.h"
#include "support/space_meshes.h"

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
    command.bodies[0].markers = {"inner"};
    command.bodies[0].motion.rotate = 90;
    command.how.increments = 1;
    command.smooth = by_energy();
    const CommandResult result = execute(command, state);
    CHECK(result.smooth.inverted == 0);
    CHECK(result.smooth.converged);
    CHECK(without_fixed_point(result.smooth));
  }
}

namespace {

/// A cube that was given a waist and turned about its axis, more and more from bottom to top.
/// twist: degrees in all; waist: share by which the middle is narrower.
Mesh twisted_waist(Index n, double twist, double waist) {
  Mesh mesh = make_mesh(cube(n, Volumes::tetrahedra));
  for (Index node = 0; node < mesh.topology->node_count(); ++node) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const double from_middle = p.z() - 0.5, angle = radians(twist * from_middle);
    const double width = 1 - waist * std::exp(-20 * from_middle * from_middle);
    const double x = width * (p.x() - 0.5), y = width * (p.y() - 0.5);
    mesh.coordinates.set_xyz(node, Vec3(std::cos(angle) * x - std::sin(angle) * y,
                                        std::sin(angle) * x + std::cos(angle) * y, p.z()));
  }
  return mesh;
}

}  // namespace

TEST_CASE("inverted cells among flat ones do not come to rest: a twisted waist is untangled") {
  struct Case {
    Index n;
    double twist, waist;
  };
  for (const Case& c : {Case{5, 360, 0.93}, Case{6, 400, 0.95}}) {
    MeshState state = make_state(twisted_waist(c.n, c.twist, c.waist));
    const Topology& topology = *state.mesh.topology;
    Coordinates& x = state.mesh.coordinates;
    REQUIRE(check_validity(topology, x).inverted == 0);  // so it can be untangled
    const Coordinates valid = x;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      CAPTURE(c.n);
      CAPTURE(seed);
      Random random(seed);
      for (const Index node : topology.interior_nodes()) {
        x.set_xyz(node,
                  Vec3(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(0, 1)));
      }
      REQUIRE(check_validity(topology, x).inverted > 200);
      const CommandResult result = execute(SmoothCommand{by_energy()}, state);
      CHECK(result.smooth.inverted == 0);
      CHECK(check_validity(topology, result.state.mesh.coordinates).inverted == 0);
      CHECK(result.smooth.converged);
      for (Index node = 0; node < topology.node_count(); ++node)
        if (topology.on_boundary(node))
          CHECK(result.state.mesh.coordinates.same_place(node, valid));
    }
  }
}

TEST_CASE("what no position of the interior untangles ends soon, and not as converged") {
  MeshState state = make_state(make_mesh(cube(3, Volumes::tetrahedra)));
  const Topology& topology = *state.mesh.topology;
  Coordinates& x = state.mesh.coordinates;
  // A node of the lower side is drawn out through the upper one.
  const auto is_there = [&](Index node) {
    return (x.xyz(node) - Vec3(1.0 / 3, 1.0 / 3, 0)).norm() < 1e-9;
  };
  Index drawn = 0;
  while (!is_there(drawn)) ++drawn;
  x.set_xyz(drawn, Vec3(0.4, 0.4, 1.5));
  REQUIRE(check_validity(topology, x).inverted > 0);
  const CommandResult result = execute(SmoothCommand{by_energy()}, state);
  CHECK(result.smooth.inverted > 0);
  CHECK_FALSE(result.smooth.converged);
  CHECK(result.smooth.outer_iterations < 400);
  CHECK(!result.smooth.out_of_iterations);
}

namespace {

/// With nodes of the boundary moved at random, so that no element can be perfect.
Mesh uneven(Mesh mesh, double by, std::uint64_t seed) {
  Random random(seed);
  for (double& c : mesh.coordinates.values()) c += random.uniform(-by, by);
  return mesh;
}

/// Of the unit square or cube, with nodes moved at random within the edges and faces they lie on:
/// no corner of the boundary limits what can be done inside.
Mesh shifted(Mesh mesh, double by, std::uint64_t seed) {
  Random random(seed);
  for (double& c : mesh.coordinates.values())
    if (c > 1e-9 && c < 1 - 1e-9) c += random.uniform(-by, by);
  return mesh;
}

SmoothCommand raising() {
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  command.smooth.raise_worst = true;
  command.smooth.threads = 1;
  return command;
}

double worst_of(const Mesh& mesh) {
  const auto values = element_values(mesh, Metric::normalized_jacobian);
  return *std::ranges::min_element(values);
}

/// The best smallest normalized Jacobian that one node allows, by a search through ever finer
/// grids.
double best_place(Mesh mesh, Index node) {
  const auto dimension = static_cast<std::size_t>(mesh.coordinates.dimension());
  const auto place = mesh.coordinates.values().subspan(at(node) * dimension, dimension);
  std::vector<double> centre(place.begin(), place.end());
  double best = worst_of(mesh);
  for (double reach = 0.3; reach > 1e-4; reach *= 0.6) {
    const std::vector<double> middle = centre;
    const int steps = 4, side = 2 * steps + 1;
    for (int k = 0; k < (dimension == 3 ? side * side * side : side * side); ++k) {
      for (std::size_t c = 0, rest = static_cast<std::size_t>(k); c < dimension; ++c) {
        place[c] = middle[c] + reach * (static_cast<int>(rest % side) - steps) / steps;
        rest /= side;
      }
      const double worst = worst_of(mesh);
      if (worst <= best) continue;
      best = worst;
      centre.assign(place.begin(), place.end());
    }
  }
  return best;
}

}  // namespace

TEST_CASE("raising the worst element finds the best place of a node as a search does") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    for (const bool space : {false, true}) {
      CAPTURE(space);
      const MeshState state =
          make_state(space ? uneven(make_mesh(cube(2, Volumes::hexahedra)), 0.08, seed)
                           : uneven(make_mesh(square(2, Cells::quads)), 0.1, seed));
      const Mesh& mesh = state.mesh;
      REQUIRE(mesh.topology->interior_nodes().size() == 1);
      const CommandResult outcome = execute(raising(), state);
      const Mesh& after = outcome.state.mesh;
      const double best = best_place(mesh, mesh.topology->interior_nodes()[0]);
      CHECK(worst_of(after) >= best - 2e-3);
      CHECK(worst_of(after) <= best + 1e-3);
      // The boundary stays to the bit.
      for (Index i = 0; i < mesh.topology->node_count(); ++i)
        if (mesh.topology->on_boundary(i)) CHECK(after.coordinates.same_place(i, mesh.coordinates));
    }
  }
}

TEST_CASE("the worst element of a mesh is better than without, and no worse with other targets") {
  const auto check = [](const Mesh& mesh, TargetBlend targets, bool better) {
    const MeshState state = make_state(mesh);
    SmoothCommand command = raising();
    command.smooth.targets = targets;
    const CommandResult raised = execute(command, state);
    command.smooth.raise_worst = false;
    const CommandResult plain = execute(command, state);
    REQUIRE(plain.smooth.converged);
    CHECK(raised.smooth.converged);
    CHECK(raised.smooth.history.back().stage == Stage::worst);
    const double before = worst_of(plain.state.mesh), after = worst_of(raised.state.mesh);
    if (better)
      CHECK(after > before + 2e-3);
    else
      CHECK(after >= before);
  };
  const Mesh quads = shifted(make_mesh(square(6, Cells::quads)), 0.05, 6);
  check(shifted(make_mesh(cube(4, Volumes::hexahedra)), 0.05, 5), TargetBlend::regular(), true);
  check(quads, TargetBlend::regular(), true);
  check(shifted(make_mesh(square(6, Cells::triangles)), 0.04, 7), TargetBlend::regular(), true);
  check(quads, {.automatic = 0, .rest = 1}, false);
}

TEST_CASE("the pointwise form has no worst element to raise") {
  const MeshState state = make_state(make_mesh(square(3, Cells::quads)));
  SmoothCommand command = raising();
  command.smooth.formulation = Formulation::pointwise;
  CHECK_THROWS_AS(execute(command, state), UsageError);
}

TEST_CASE("limits of the quality and raising the worst element do not go together") {
  const MeshState state = make_state(make_mesh(square_with_hole(6, Cells::quads)));
  MoveCommand command;
  command.bodies[0].markers = {state.mesh.topology->markers()[0].name};
  command.bodies[0].motion.translate = Vec2(0.01, 0);
  command.smooth.raise_worst = true;
  command.how.floor.set(Metric::normalized_jacobian, 0.1);
  CHECK_THROWS_AS(execute(command, state), UsageError);
}
