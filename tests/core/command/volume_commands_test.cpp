#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <span>

#include "core/command/command.h"
#include "core/drag/drag_session.h"
#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/inspect/element_field.h"
#include "core/inspect/nodal_view.h"
#include "core/layers/layer_control.h"
#include "core/layers/layer_detection.h"
#include "core/layers/layer_insertion.h"
#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "core/layers/wall_chain.h"
#include "core/mesh/mesh.h"
#include "core/motion/transfer.h"
#include "core/quality/quality.h"
#include "core/quality/validity.h"
#include "core/strategy/smooth_run.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/space_meshes.h"
#include "support/volume_layers.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Index inverted(const Mesh& mesh) {
  return check_validity(*mesh.topology, mesh.coordinates).inverted;
}

/// Sees every mesh that a run shows.
class Watch final : public SolverMonitor {
 public:
  explicit Watch(std::shared_ptr<const Topology> topology) : topology_(std::move(topology)) {}
  bool on_iteration(const IterationRecord& record, const Coordinates& x) override {
    CHECK(record.inverted == check_validity(*topology_, x).inverted);
    worst_ = std::max(worst_, record.inverted);
    ++meshes_;
    return true;
  }
  Index worst() const { return worst_; }
  int meshes() const { return meshes_; }

 private:
  std::shared_ptr<const Topology> topology_;
  Index worst_ = 0;
  int meshes_ = 0;
};

}  // namespace

TEST_CASE("a scrambled volume mesh is untangled, and its regular elements come back") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::prisms}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    ScrambleCommand scramble;
    scramble.seed = 3;
    const CommandResult tangled = execute(scramble, make_state(mesh));
    REQUIRE(tangled.smooth.inverted > 0);
    SmoothCommand smooth;
    smooth.smooth.targets = TargetBlend::regular();
    smooth.smooth.tolerance = 1e-10;
    const CommandResult result = execute(smooth, tangled.state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    CHECK(inverted(result.state.mesh) == 0);
    for (Index node = 0; node < mesh.topology->node_count(); ++node) {
      if (mesh.topology->on_boundary(node))
        CHECK(result.state.mesh.coordinates.same_place(node, mesh.coordinates));
    }
    if (volumes != Volumes::hexahedra) continue;
    // A grid of cubes is the only minimum: every element matches its target.
    for (Index node = 0; node < mesh.topology->node_count(); ++node) {
      CHECK((result.state.mesh.coordinates.xyz(node) - mesh.coordinates.xyz(node)).norm() < 1e-8);
    }
  }
}

TEST_CASE("a body in a volume mesh is turned and moved through valid meshes only") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = box_with_body(5, volumes);
    Watch watch(mesh.topology);
    RunOptions options;
    options.monitor = &watch;
    MoveCommand move;
    move.bodies[0].markers = {"body"};
    move.bodies[0].motion.rotate = 30;
    move.bodies[0].motion.axis = Vec3(1, 1, 0.5);
    move.bodies[0].motion.translate = Vec3(0.03, -0.02, 0.04);
    const CommandResult result = execute(move, make_state(mesh), options);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(watch.worst() == 0);
    CHECK(watch.meshes() > 2);
    CHECK(inverted(result.state.mesh) == 0);
    // The body is where a rotation about its centre and the shift put it (Rodrigues' formula).
    const Vec3 axis = Vec3(1, 1, 0.5).normalized();
    const double angle = radians(30);
    const auto body = mesh.topology->markers().nodes_of(std::vector<std::string>{"body"});
    const Box<3> box = space_bounds(mesh.coordinates, body);
    for (const Index node : body) {
      const Vec3 arm = mesh.coordinates.xyz(node) - box.centre();
      const Vec3 cross(axis.y() * arm.z() - axis.z() * arm.y(),
                       axis.z() * arm.x() - axis.x() * arm.z(),
                       axis.x() * arm.y() - axis.y() * arm.x());
      const Vec3 turned = std::cos(angle) * arm + std::sin(angle) * cross +
                          (1 - std::cos(angle)) * axis.dot(arm) * axis;
      const Vec3 expected = box.centre() + turned + Vec3(0.03, -0.02, 0.04);
      CHECK((result.state.mesh.coordinates.xyz(node) - expected).norm() < 1e-12);
    }
  }
}

TEST_CASE("volume meshes are smoothed alike at one and two threads, and twice alike") {
  const Mesh mesh = box_with_body(5, Volumes::mixed);
  Mesh shaken = mesh;
  Random random(5);
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec3 by(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    shaken.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 0.02 * by);
  }
  SmoothCommand smooth;
  smooth.smooth.threads = 1;
  const CommandResult one = execute(smooth, make_state(shaken));
  smooth.smooth.threads = 2;
  const CommandResult two = execute(smooth, make_state(shaken));
  CHECK(one.smooth.converged);
  CHECK(one.state.mesh.coordinates == two.state.mesh.coordinates);
}

TEST_CASE("Newton's method on a valid volume mesh ends in few steps, quadratically") {
  Mesh mesh = box_with_body(7, Volumes::tetrahedra);
  for (Index node = 0; node < mesh.topology->node_count(); ++node) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const Vec3 by(std::sin(3 * p.y()), std::sin(3 * p.z()), std::sin(3 * p.x()));
    mesh.coordinates.set_xyz(node, p + 0.1 * by);
  }
  REQUIRE(inverted(mesh) == 0);
  SmoothCommand smooth;
  constexpr double tolerance = 1e-10;
  smooth.smooth.targets = TargetBlend::regular();
  smooth.smooth.tolerance = tolerance;
  const CommandResult result = execute(smooth, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.linear_solves <= 12);
  const auto& history = result.smooth.history;
  // The last step is solved to the tolerance only.
  int quadratic = 0;
  for (std::size_t k = 0; k + 1 < history.size(); ++k) {
    const double residual = history[k].residual;
    if (residual > 1e-2) continue;
    CHECK(history[k + 1].residual < 100 * residual * residual + tolerance);
    ++quadratic;
  }
  CHECK(quadratic >= 2);
}

namespace {

/// A valid mesh that is no solution.
Mesh waved(const Mesh& mesh) {
  Mesh waved = mesh;
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const Vec3 by(std::sin(9 * p.y()), std::sin(9 * p.z()), std::sin(9 * p.x()));
    waved.coordinates.set_xyz(node, p + 0.02 * by);
  }
  REQUIRE(inverted(waved) == 0);
  return waved;
}

/// The residuals at which the iterations of a run began.
std::vector<double> residuals_before_steps(const CommandResult& result) {
  std::vector<double> residuals;
  const auto& history = result.smooth.history;
  for (std::size_t k = 1; k < history.size(); ++k)
    if (history[k].iteration > history[k - 1].iteration)
      residuals.push_back(history[k - 1].residual);
  return residuals;
}

}  // namespace

TEST_CASE("volume meshes end at a residual of 1e-4, unless a tolerance is given") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const MeshState state = make_state(waved(box_with_body(5, volumes)));
    SmoothCommand smooth;
    smooth.smooth.targets = TargetBlend::regular();
    const CommandResult result = execute(smooth, state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.residual <= 1e-4);
    // No step is taken from a mesh that is good enough.
    const auto before = residuals_before_steps(result);
    REQUIRE_FALSE(before.empty());
    CHECK(*std::ranges::min_element(before) > 1e-4);
    for (const double tolerance : {1e-2, 1e-10}) {
      smooth.smooth.tolerance = tolerance;
      const CommandResult other = execute(smooth, state);
      CHECK(other.smooth.converged);
      CHECK(other.smooth.residual <= tolerance);
      CHECK((other.smooth.outer_iterations > result.smooth.outer_iterations) == (tolerance < 1e-4));
    }
  }
}

TEST_CASE("a run from a start of its own does not end at that start") {
  const MeshState state = make_state(waved(box_with_body(5, Volumes::tetrahedra)));
  SmoothCommand smooth;
  smooth.smooth.targets = TargetBlend::regular();
  const Coordinates first = execute(smooth, state).state.mesh.coordinates;
  RunOptions options;
  options.start = &first;
  CHECK(execute(smooth, state, options).smooth.residual <= 1e-10);
  smooth.smooth.tolerance = 1e-4;
  CHECK(execute(smooth, state, options).state.mesh.coordinates == first);
}

TEST_CASE("the interior of a volume mesh follows small motions in proportion") {
  struct Way {
    const char* name;
    Formulation formulation;
    OuterMethod outer;
    int increments;
  };
  for (const Way& way :
       {Way{"path", Formulation::variational, OuterMethod::newton, 0},
        Way{"one step", Formulation::variational, OuterMethod::newton, 1},
        Way{"three steps", Formulation::variational, OuterMethod::newton, 3},
        Way{"first order", Formulation::variational, OuterMethod::descent, 1},
        Way{"first order, path", Formulation::variational, OuterMethod::descent, 0},
        Way{"pointwise", Formulation::pointwise, OuterMethod::newton, 1},
        Way{"fixed point", Formulation::pointwise, OuterMethod::picard, 1}}) {
    SmoothCommand settle;
    MoveCommand move;
    settle.smooth.formulation = way.formulation;
    settle.smooth.tolerance = 1e-13;
    move.smooth.formulation = way.formulation;
    move.smooth.outer = way.outer;
    move.how.increments = way.increments;
    move.bodies[0].markers = {"body"};
    move.bodies[0].motion.axis = Vec3(0, 0.3, 1);
    MeshState state = make_state(box_with_body(5, Volumes::tetrahedra));
    if (way.formulation == Formulation::pointwise) state = execute(settle, state).state;
    for (const double degrees : {1e-3, 1e-6}) {
      CAPTURE(way.name);
      CAPTURE(degrees);
      move.bodies[0].motion.rotate = degrees;
      move.smooth.tolerance.reset();
      const CommandResult result = execute(move, state);
      move.smooth.tolerance = 1e-13;
      const CommandResult exact = execute(move, state);
      CHECK(result.smooth.converged);
      CHECK(result.smooth.inverted == 0);
      double farthest = 0, off = 0;
      for (const Index node : state.mesh.topology->interior_nodes()) {
        const Vec3 there = exact.state.mesh.coordinates.xyz(node);
        farthest = std::max(farthest, (there - state.mesh.coordinates.xyz(node)).norm());
        off = std::max(off, (result.state.mesh.coordinates.xyz(node) - there).norm());
      }
      REQUIRE(farthest > 0.1 * radians(degrees) * 0.2);  // the body is a fifth of the box
      CHECK(off < 0.05 * farthest);
    }
  }
}

/// Rotations that name no pivot.
namespace winslow::test {

TEST_CASE("without a pivot all markers turn about the centre of them all, wherever they are") {
  MeshData data = square_with_two_holes(20, Cells::triangles);
  const Vec2 away(1000, -400);  // chords
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + away);
  const MeshState state = make_state(make_mesh(data));
  MoveCommand command;
  command.bodies[0].markers = {"hole_a", "hole_b"};
  command.bodies[0].motion.rotate = 20;
  const CommandResult result = execute(command, state);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
  MoveCommand named = command;
  named.bodies[0].motion.pivot = away + Vec2(0.5, 0.5);
  Coordinates expected = state.mesh.coordinates;
  make_motion(*state.mesh.topology, expected, named.bodies[0].markers, named.bodies[0].motion)
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
  command.bodies[0].markers = {"hole_a"};
  const std::array<const MeshState*, 2> both{&here, &there};
  const auto pivot = [&](std::span<const MeshState* const> states) {
    return std::get<MoveCommand>(with_pivot(command, states)).bodies[0].motion.pivot;
  };
  REQUIRE(pivot(both).has_value());
  CHECK(pivot(both)->isApprox(Vec3(5.3, 2.5, 0)));
  CHECK(pivot(std::span(both).first(1))->isApprox(Vec3(0.3, 0.5, 0)));
  command.bodies[0].motion.pivot = Vec2(0, 0);
  CHECK(pivot(both) == Vec2(0, 0));
  command.bodies[0].motion.pivot.reset();
  command.bodies[0].markers = {"nobody"};
  CHECK_FALSE(pivot(both).has_value());
}

TEST_CASE("each of several bodies turns about its own centre, in all meshes together") {
  const MeshState here = make_state(make_mesh(square_with_two_holes(10, Cells::quads)));
  MoveCommand command;
  command.bodies = {{{"hole_a"}, {.rotate = 5}},
                    {{"hole_b"}, {.rotate = 5, .pivot = Vec2(0, 1)}},
                    {{"hole_b", "nowhere"}, {}}};
  const std::array<const MeshState*, 1> states{&here};
  const auto bodies = std::get<MoveCommand>(with_pivot(command, states)).bodies;
  CHECK((*bodies[0].motion.pivot - Vec3(0.3, 0.5, 0)).norm() < 1e-15);
  CHECK(*bodies[1].motion.pivot == Vec2(0, 1));
  CHECK((*bodies[2].motion.pivot - Vec3(0.7, 0.5, 0)).norm() < 1e-15);
}

}  // namespace winslow::test

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
  return {mesh, make_state(make_mesh(square(3, Cells::quads))).vcvs.plane()};
}

std::vector<std::string> a_marker(const Mesh& mesh) { return {mesh.topology->markers()[0].name}; }

LayerOptions layers_at(const Mesh& mesh, bool match_outside) {
  LayerOptions options;
  options.walls.push_back({a_marker(mesh), {3, 0.01, 1.2, 1.0, {}, match_outside}});
  return options;
}

}  // namespace

TEST_CASE("commands that cannot serve surface meshes are refused by their names") {
  for (const Command& command : all_commands()) {
    if (std::holds_alternative<SmoothCommand>(command) ||
        std::holds_alternative<ScrambleCommand>(command) ||
        std::holds_alternative<EditVcvCommand>(command))
      continue;  // of surface meshes, too
    const std::string message = std::string(command_name(command)) +
                                ": only for plane and volume meshes, and this is a surface mesh";
    for (const Other& other : other_meshes())
      if (other.kind == "surface mesh")
        CHECK_THROWS_WITH_AS(execute(command, state_of(other.mesh)), message.c_str(), UsageError);
  }
}

TEST_CASE("layers of a volume mesh are inserted, and motions keep their heights") {
  const MeshState state = make_state(box_with_ball(6, Volumes::tetrahedra));
  const Coordinates before = state.mesh.coordinates;
  LayersCommand layers;
  layers.layers.walls = {{{"cavity"}, {.count = 5, .first = 0.003, .ratio = 1.2}}};
  const CommandResult inserted = execute(layers, state);
  CHECK(inserted.smooth.converged);
  CHECK(inserted.smooth.inverted == 0);
  const std::vector<std::string> cavity{"cavity"};
  const auto check_heights = [&](const MeshState& of, double most) {
    REQUIRE(of.layers);
    const LayerMeasures measures = measure_layers(*of.layers, of.mesh.coordinates);
    CHECK(measures.first_error.max < most);
    CHECK(measures.spacing_error.max < 2 * most);
    CHECK(measures.columns.size() == of.mesh.topology->markers().nodes_of(cavity).size());
  };
  check_heights(inserted.state, 0.01);
  const auto& topology = *inserted.state.mesh.topology;
  const auto of_type = [&](ElementType type) {
    Index count = 0;
    for (Index e = 0; e < topology.element_count(); ++e) count += topology.element_type(e) == type;
    return count;
  };
  CHECK(of_type(ElementType::prism) == 5 * static_cast<Index>(inserted.state.layers->faces.size()));
  CHECK(of_type(ElementType::tetrahedron) == state.mesh.topology->element_count());
  for (const Index node : topology.markers().nodes_of(layers.layers.walls[0].markers))
    CHECK(inserted.state.mesh.coordinates.xyz(node) == before.xyz(node));
  MoveCommand turn{{{{"cavity"}, {.rotate = 30, .axis = Vec3(0, 0, 1)}}}, {}, {}};
  const CommandResult turned = execute(turn, inserted.state);
  CHECK(turned.smooth.fraction_reached == 1);
  check_heights(turned.state, 0.01);
}

TEST_CASE("in a volume mesh layers are not spaced anew") {
  const MeshState state = make_state(make_mesh(cube(2, Volumes::hexahedra)));
  LayersCommand layers;
  layers.layers.walls = {{{"floor"}, {}}};
  layers.task = LayerTask::respace;
  CHECK_THROWS_WITH_AS(
      execute(layers, state),
      "layers that are spaced anew: only for a plane mesh, and this is a volume mesh", UsageError);
  layers.task = LayerTask::hold;
  CHECK_THROWS_WITH_AS(
      execute(layers, state),
      "there are no layers at floor: no elements that are 1.65 times as long along "
      "the wall as high",
      UsageError);
  layers.layers.walls = {{{"flor"}, {}}};
  CHECK_THROWS_AS(execute(layers, state), UsageError);
}

TEST_CASE("what volume meshes cannot do yet is refused by its name") {
  const MeshState state = make_state(make_mesh(cube(2, Volumes::tetrahedra)));
  SmoothCommand smooth;
  MoveCommand move;
  move.bodies[0].markers = a_marker(state.mesh);
  move.bodies[0].motion.rotate = 10;
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
  move.bodies[0].markers = a_marker(plane.mesh);
  move.bodies[0].motion.axis = Vec3(0, 0, 1);
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
  refused("the pointwise form", [](SmoothOptions& o) { o.formulation = Formulation::pointwise; });
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

TEST_CASE("motions are those of plane meshes and volume meshes") {
  const auto move = [](const auto& motion) {
    return [motion](const Mesh& mesh) {
      make_motion(*mesh.topology, mesh.coordinates, a_marker(mesh), motion);
    };
  };
  check_refused("rigid motions", move(RigidMotion{}), false);
  check_refused("sine deformations", move(SineDeformation{}), false);
  DisplacementTable table;
  table.entries.emplace_back().node = 0;
  check_refused("displacements", move(table), false);
  const auto drag = [](const Mesh& mesh) {
    DragGrip grip;
    grip.markers = a_marker(mesh);
    DragSession session(state_of(mesh), grip, SmoothOptions{});
  };
  check_refused("drags", drag, false);
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
    layer_vcvs(mesh.topology, {}, *state_of(mesh).vcvs.plane(), mesh.coordinates);
  });
}

TEST_CASE("coordinates in space are refused where those of a plane mesh are expected") {
  const MeshState state = make_state(make_mesh(square(3, Cells::triangles)));
  const VirtualControlVolumes& vcv = *state.vcvs.plane();
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
