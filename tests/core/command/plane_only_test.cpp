#include <doctest/doctest.h>

#include <functional>

#include "core/command/command.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/inspect/element_field.h"
#include "core/inspect/nodal_view.h"
#include "core/layers/clearance.h"
#include "core/layers/layer_control.h"
#include "core/layers/layer_detection.h"
#include "core/layers/layer_fit.h"
#include "core/layers/layer_insertion.h"
#include "core/layers/layer_measures.h"
#include "core/layers/sound_plan.h"
#include "core/layers/wall_chain.h"
#include "core/motion/transfer.h"
#include "core/quality/quality.h"
#include "core/quality/valid_step.h"
#include "core/strategy/smooth_run.h"
#include "support/formulations.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

/// What works on plane meshes alone refuses all others, and says what it is that refuses.
namespace {

struct Other {
  std::string kind;
  Mesh mesh;
};

std::vector<Other> other_meshes() {
  const auto bowl = [](const Vec2& p) -> Vec3 { return {p.x(), p.y(), p.squaredNorm()}; };
  std::vector<Other> others;
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed})
    others.push_back({"surface mesh", make_mesh(lifted(square(3, cells), bowl))});
  for (const Volumes volumes : all_volumes)
    others.push_back({"volume mesh", make_mesh(cube(2, volumes))});
  return others;
}

/// volumes: whether volume meshes are refused, too.
void check_refused(const std::string& who, const std::function<void(const Mesh&)>& call,
                   bool volumes = true) {
  for (const Other& other : other_meshes()) {
    if (!volumes && other.kind == "volume mesh") continue;
    CAPTURE(who);
    const std::string message = who + ": only for a plane mesh, and this is a " + other.kind;
    CHECK_THROWS_WITH_AS(call(other.mesh), message.c_str(), UsageError);
  }
}

/// A state whose VCVs say nothing against its mesh.
MeshState state_of(const Mesh& mesh) {
  return {mesh, make_state(make_mesh(square(3, Cells::quads))).vcv};
}

std::vector<std::string> a_marker(const Mesh& mesh) { return {mesh.topology->markers()[0].name}; }

LayerOptions layers_at(const Mesh& mesh, bool match_outside) {
  LayerOptions options;
  options.walls.push_back({a_marker(mesh), {3, 0.01, 1.2, 1.0, {}, match_outside}});
  return options;
}

}  // namespace

TEST_CASE("commands are refused by their names on meshes that are not plane") {
  for (const Command& command : all_commands()) {
    const bool serves_volumes = !std::holds_alternative<LayersCommand>(command);
    if (std::holds_alternative<SmoothCommand>(command) ||
        std::holds_alternative<ScrambleCommand>(command) ||
        std::holds_alternative<EditVcvCommand>(command))
      continue;  // of surface meshes, too
    check_refused(
        std::string(command_name(command)),
        [&](const Mesh& mesh) { execute(command, state_of(mesh)); }, !serves_volumes);
  }
}

TEST_CASE("what volume meshes cannot do yet is refused by its name") {
  const MeshState state = make_state(make_mesh(cube(2, Volumes::tetrahedra)));
  MoveCommand move;
  move.markers = a_marker(state.mesh);
  move.motion.rotate = 10;
  CHECK_THROWS_WITH_AS(execute(move, state), "a rotation in space needs an axis", UsageError);
  const MeshState plane = make_state(make_mesh(square(3, Cells::quads)));
  for (const VcvKind kind : {VcvKind::existing, VcvKind::adjusted, VcvKind::perturbation}) {
    smooth = {};
    smooth.smooth.vcv = kind;
    CHECK_THROWS_WITH_AS(
        execute(smooth, plane),
        "vcv: solid angles of volume meshes only; a plane mesh takes auto or equal", UsageError);
  }
  smooth = {};
  smooth.smooth.vcv = VcvKind::equal;
  CHECK_NOTHROW(execute(smooth, plane));
  smooth.smooth.vcv_lengths = 0.5;
  CHECK_THROWS_WITH_AS(execute(smooth, plane),
                       "vcv_lengths: for volume meshes only; the edges of a plane mesh's VCVs have "
                       "the lengths that they are given",
                       UsageError);
  smooth = {};
  smooth.smooth.vcv_updates = 1;
  CHECK_THROWS_WITH_AS(
      execute(smooth, plane),
      "vcv_updates: for volume meshes only; the VCVs of a plane mesh do not change", UsageError);
  move.markers = a_marker(plane.mesh);
  move.motion.axis = Vec3(0, 0, 1);
  CHECK_THROWS_WITH_AS(
      execute(move, plane),
      "an axis or a third component: only for a volume mesh, and this is a plane mesh", UsageError);
}

TEST_CASE("what smooths a surface mesh is refused by its name where it is for other meshes") {
  const auto smooth = [](auto set) {
    return [set](const Mesh& mesh) {
      SmoothCommand command;
      set(command.smooth);
      execute(command, make_state(mesh));
    };
  };
  const auto refused = [&](const char* who, auto set) {
    const auto call = smooth(set);
    check_refused(who, [&](const Mesh& mesh) {
      if (is_surface(*mesh.topology)) return call(mesh);
      require_plane(*mesh.topology, who);
    });
  };
  refused("the pointwise form", [](SmoothOptions& o) { o.formulation = "pointwise"; });
  refused("the fixed-point iteration", [](SmoothOptions& o) { o.outer = OuterMethod::picard; });
  refused("untangling by the fixed-point iteration",
          [](SmoothOptions& o) { o.untangle = Untangle::picard; });
  refused("keep-outside", [](SmoothOptions& o) { o.keep_outside.radius = 1; });
}

TEST_CASE("steps on straight lines and bounds of the plane are those of plane meshes") {
  check_refused(
      "steps that keep a mesh valid",
      [](const Mesh& mesh) {
        largest_valid_step(*mesh.topology, mesh.coordinates, mesh.coordinates);
      },
      false);
  check_refused("bounds", [](const Mesh& mesh) { bounds(mesh); });
}

TEST_CASE("virtual control volumes as data of a state are not those of volume meshes") {
  for (const Other& other : other_meshes()) {
    if (other.kind != "volume mesh") continue;
    CHECK_THROWS_WITH_AS(
        VirtualControlVolumes(other.mesh.topology),
        "virtual control volumes: only for a plane mesh, and this is a volume mesh", UsageError);
  }
}

TEST_CASE("motions are those of plane meshes") {
  const auto move = [](const auto& motion) {
    return [motion](const Mesh& mesh) {
      make_motion(*mesh.topology, mesh.coordinates, a_marker(mesh), motion);
    };
  };
  check_refused("motions of the plane", move(RigidMotion{}));
  check_refused("sine deformations", move(SineDeformation{}), false);
  DisplacementTable table;
  table.entries.emplace_back().node = 0;
  check_refused("displacements", move(table), false);
  check_refused("drags in the plane", [](const Mesh& mesh) {
    DragGrip grip;
    grip.markers = a_marker(mesh);
    DragSession session(state_of(mesh), grip, SmoothOptions{});
  });
}

TEST_CASE("layers are those of plane meshes") {
  for (const bool match : {false, true}) {
    check_refused("layers", [&](const Mesh& mesh) { plan_layers(mesh, layers_at(mesh, match)); });
    check_refused("layers", [&](const Mesh& mesh) { sound_plan(mesh, layers_at(mesh, match)); });
  }
  check_refused("layers", [](const Mesh& mesh) { detect_layers(mesh, layers_at(mesh, false)); });
  check_refused("layers",
                [](const Mesh& mesh) { find_wall_chains(mesh, layers_at(mesh, false).walls); });
  check_refused("layers", [](const Mesh& mesh) { insert_layers(mesh, {}); });
  check_refused("layers", [](const Mesh& mesh) { with_other_layers({}, {}, *mesh.topology); });
  check_refused("layers", [](const Mesh& mesh) {
    fitted_layers({}, *mesh.topology, mesh.coordinates, mesh.coordinates);
  });
  check_refused("layers",
                [](const Mesh& mesh) { Clearance clearance(*mesh.topology, mesh.coordinates, 1); });
  check_refused("layers", [](const Mesh& mesh) {
    LayerStack stack;
    const LayerOptions options = layers_at(mesh, false);
    respace_layers(stack, mesh, options);
  });
  check_refused("virtual control volumes", [](const Mesh& mesh) {
    layer_vcvs(mesh.topology, {}, *state_of(mesh).vcv, mesh.coordinates);
  });
}

TEST_CASE("coordinates in space are refused where those of a plane mesh are expected") {
  const MeshState state = make_state(make_mesh(square(3, Cells::triangles)));
  const VirtualControlVolumes& vcv = *state.vcv;
  const Coordinates space(3, state.mesh.coordinates.size());
  const char* message = "found points of space, expected points of the plane";
  const Index node = state.mesh.topology->interior_nodes().front();
  CHECK_THROWS_WITH_AS(check_validity(*state.mesh.topology, space), message, UsageError);
  CHECK_THROWS_WITH_AS(largest_valid_step(*state.mesh.topology, space, space), message, UsageError);
  CHECK_THROWS_WITH_AS(inspect_node(vcv, space, node), message, UsageError);
  for (const NodalField field :
       {NodalField::kappa, NodalField::smallest_weight, NodalField::residual})
    CHECK_THROWS_WITH_AS(node_values(vcv, space, field, 1), message, UsageError);
  LayerStack stack;
  stack.columns.resize(1);
  stack.columns[0].nodes = {0, 1};
  stack.columns[0].heights = {1};
  CHECK_THROWS_WITH_AS(correct_layers(stack, space), message, UsageError);
  std::vector<double> out(2 * state.mesh.topology->interior_nodes().size());
  CHECK_THROWS_WITH_AS(pointwise(vcv).residual(space, out), message, UsageError);
  const VariationalWinslow variational(free_interior(state.mesh.topology),
                                       TargetShapes::build(vcv, TargetBlend::regular(), nullptr),
                                       {}, 1);
  CHECK_THROWS_WITH_AS(variational.energy(space), message, UsageError);
  CHECK_THROWS_WITH_AS(variational.residual(space, out), message, UsageError);
  CHECK_THROWS_WITH_AS(variational.worst_distortion(space), message, UsageError);
}
