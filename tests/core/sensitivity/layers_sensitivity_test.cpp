#include "core/error.h"
#include "core/layers/layer_control.h"
#include "core/motion/node_table.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/sensitivities.h"
#include "support/space_meshes.h"

namespace winslow::test {
namespace {

/// A motion by a parameter: 0 where its derivative is wanted.
using Motions = std::function<Command(double parameter)>;

CommandResult moved_by(const Motions& motions, double parameter, const MeshState& state,
                       const RunOptions& options = {}) {
  CommandResult result = execute(motions(parameter), state, options);
  REQUIRE(result.smooth.converged);
  REQUIRE(result.smooth.fraction_reached == 1);
  return result;
}

/// Layers on the floor of a cube, held or not, its lid pushed down.
Motions push_down(double by) {
  return [by](double more) {
    MoveCommand move;
    move.bodies[0].markers = {"lid"};
    move.bodies[0].motion.translate = {0, 0, -by - more};
    move.smooth.slide.markers = {"walls"};
    move.smooth.slide.features = true;
    move.smooth.tolerance = 1e-12;
    return move;
  };
}

Motions turn(const std::string& marker, double degrees) {
  return [=](double more) {
    MoveCommand move;
    move.bodies[0].markers = {marker};
    move.bodies[0].motion.pivot = Vec2(0.1, 0.2);
    move.bodies[0].motion.rotate = degrees + 20 * more;
    move.bodies[0].motion.translate = GivenVector(0.2 + more, 0.1);
    move.smooth.tolerance = 1e-12;
    return move;
  };
}

/// A wave on the body whose amplitude grows.
Motions bend(const std::string& marker, double amplitude) {
  return [=](double more) {
    DeformCommand deform;
    deform.markers = {marker};
    SineDeformation sine;
    sine.amplitude = amplitude + more;
    sine.fade = Fade::both;
    deform.shape = sine;
    deform.smooth.tolerance = 1e-12;
    return deform;
  };
}

/// The VCVs of layers with their corrections, over the walls of a mesh.
Vcvs vcvs_over(const Mesh& mesh, LayerStack layers) {
  const auto stands = column_stands(layers, mesh.coordinates);
  for (std::size_t c = 0; c < stands.size(); ++c) set_stand(layers.columns[c], stands[c]);
  return layer_vcvs(mesh.topology, layers, VirtualControlVolumes(mesh.topology), mesh.coordinates);
}

LayersCommand insert_at(const std::string& marker, bool control) {
  LayersCommand insert;
  insert.layers.walls.push_back({{marker}, {6, 0.01, 1.3, 1.0, {}, false}});
  insert.control = control;
  return insert;
}

/// Compares the derivative with differences of runs that repeat the corrections of held heights,
/// frozen_run(parameter, result of the motion), and with those of full runs, from which it may be
/// far_from_full.
void check(const Motions& motions, const MeshState& state, double step,
           const std::function<Coordinates(double, const CommandResult&)>& frozen_run,
           double far_from_full) {
  const CommandResult moved = moved_by(motions, 0, state);
  const MeshSensitivity sensitivity(state, motions(0), moved);
  CHECK(sensitivity.distance() < 1e-6);
  const Coordinates frozen =
      difference_of([&](double parameter) { return frozen_run(parameter, moved); }, step);
  const Coordinates found = sensitivity.forward(frozen);  // only the boundary is read
  CHECK(largest_inside(*state.mesh.topology, frozen) > 0.1);
  CHECK(error_of(found, frozen) < 1e-6);
  check_transpose(sensitivity);
  const Coordinates full = difference_of(
      [&](double parameter) { return moved_by(motions, parameter, state).state.mesh.coordinates; },
      step);
  CHECK(error_of(found, full) < far_from_full);
  // The corrections are found again if only the mesh is known.
  const MeshSensitivity again(state, motions(0), moved.state.mesh.coordinates);
  CHECK(again.frozen().heights == sensitivity.frozen().heights);
  CHECK(error_of(again.forward(frozen), found) < 1e-3);
}

}  // namespace

TEST_CASE("derivatives of volume meshes with held layers keep the factors of their heights") {
  for (const Volumes volumes : {Volumes::hexahedra, Volumes::prisms}) {
    CAPTURE(std::string(name_of(volumes)));
    LayersCommand hold;
    hold.task = LayerTask::hold;
    hold.layers.walls = {{{"floor"}, {}}};
    const MeshState held = execute(hold, make_state(layered_cube(volumes))).state;
    const auto frozen_run = [&](double parameter, const CommandResult& moved) {
      MeshState free = held;
      free.held_walls.clear();
      REQUIRE(moved.smooth.layers_held);
      return moved_by(push_down(0.25), parameter, free,
                      {.layer_factors = &moved.smooth.layers_held->factors})
          .state.mesh.coordinates;
    };
    check(push_down(0.25), held, 1e-5, frozen_run, 0.05);
  }
}

TEST_CASE("derivatives of plane meshes with held layers keep the corrections of their VCVs") {
  const MeshState ring = make_state(make_mesh(annulus(32, 10, 1.2, Cells::triangles)));
  const MeshState inserted = execute(insert_at("inner", true), ring).state;
  LayersCommand hold;
  hold.task = LayerTask::hold;
  hold.layers.walls = {{{"body"}, {}}};
  hold.layers.walls[0].spacing.count = 100;
  const MeshState found =
      execute(hold, make_state(make_mesh(ring_grid(40, 12, 0.02, 1.3, 0.3)))).state;
  // The columns at both ends of this wall lie on the sides of the square.
  const MeshState square_mesh = make_state(make_mesh(square(10, Cells::triangles)));
  const MeshState between = execute(insert_at("bottom", true), square_mesh).state;
  struct Held {
    MeshState state;
    Motions motions;
    double far_from_full;
  };
  for (const Held& of :
       {Held{inserted, turn("inner", 20), 1e-6}, Held{inserted, bend("inner", 0.15), 0.02},
        Held{found, bend("body", 0.15), 0.01}, Held{between, bend("bottom", 0.08), 0.15}}) {
    const MeshState& held = of.state;
    const Motions& with = of.motions;
    REQUIRE(held.layers->held);
    const auto frozen_run = [&](double parameter, const CommandResult& moved) {
      MeshState free = held;
      free.layers = nullptr;
      free.vcvs = moved.state.vcvs;
      free.roles = moved.state.roles;
      if (moved.state.vcvs != held.vcvs)
        free.vcvs = vcvs_over(moved_by(with, parameter, free).state.mesh, *moved.state.layers);
      return moved_by(with, parameter, free).state.mesh.coordinates;
    };
    check(with, held, 1e-5, frozen_run, of.far_from_full);
  }
}

TEST_CASE("motions after layers were inserted or VCVs edited have derivatives") {
  const MeshState ring = make_state(make_mesh(annulus(32, 10, 1.2, Cells::triangles)));
  const MeshState layered = execute(insert_at("inner", false), ring).state;
  REQUIRE_FALSE(layered.layers->held);
  const Topology& topology = *ring.mesh.topology;
  const Index inside = topology.interior_nodes()[40];
  const auto neighbours = topology.neighbours(inside);
  REQUIRE(neighbours.size() == 6);
  EditVcvCommand edit;
  edit.edits = {{inside, {neighbours.begin(), neighbours.end()}, {90, 54, 54, 54, 54, 54}, {}}};
  for (const MeshState& state : {layered, execute(edit, ring).state}) {
    const auto run = [&](double parameter, const CommandResult&) {
      return moved_by(turn("inner", 20), parameter, state).state.mesh.coordinates;
    };
    check(turn("inner", 20), state, 1e-5, run, 1e-6);
  }
}

TEST_CASE("a result of another mesh has no derivative") {
  const MeshState ring = make_state(make_mesh(annulus(32, 10, 1.2, Cells::triangles)));
  const MeshState layered = execute(insert_at("inner", false), ring).state;
  CHECK_THROWS_WITH_AS(
      MeshSensitivity(ring, turn("inner", 20)(0), CommandResult{layered, {}}),
      doctest::Contains("not of the nodes and elements of the mesh before the motion"), UsageError);
}

}  // namespace winslow::test
