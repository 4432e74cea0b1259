#include "core/command/command.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <set>

#include "core/error.h"
#include "support/meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState plate_state(Cells cells = Cells::triangles) {
  return make_state(make_mesh(square_with_hole(20, cells)));
}

/// The hole turned and shifted a little: smoothing it at once succeeds.
MoveCommand small_move() {
  MoveCommand command;
  command.bodies[0].markers = {"hole"};
  command.bodies[0].motion = {15, Vec2(0.5, 0.5), {0.05, -0.05}};
  command.smooth.threads = 1;
  return command;
}

/// An annulus whose inner ring is turned.
MoveCommand turn(double degrees) {
  MoveCommand command;
  command.bodies[0].markers = {"inner"};
  command.bodies[0].motion.rotate = degrees;
  command.smooth.threads = 1;
  return command;
}

MeshState ring_state() {
  return make_state(make_mesh(annulus(24, 16, std::pow(20.0, 1.0 / 16), Cells::triangles)));
}

/// Cancels at a given call, and remembers all records.
class Watcher final : public SolverMonitor {
 public:
  explicit Watcher(int cancel_at = -1) : cancel_at_(cancel_at) {}
  bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) override {
    records.push_back(record);
    last = coordinates;
    return static_cast<int>(records.size()) != cancel_at_;
  }
  std::vector<IterationRecord> records;
  Coordinates last;

 private:
  int cancel_at_;
};

Index inverted(const MeshState& state) {
  return check_validity(*state.mesh.topology, state.mesh.coordinates).inverted;
}

Coordinates boundary_moved(const MeshState& state, const MoveCommand& command) {
  const auto motion = make_motion(*state.mesh.topology, state.mesh.coordinates,
                                  command.bodies[0].markers, command.bodies[0].motion);
  Coordinates x = state.mesh.coordinates;
  motion->apply(state.mesh.coordinates, 1, x);
  return x;
}

void check_boundary(const MeshState& state, const Coordinates& expected) {
  for (Index i = 0; i < expected.size(); ++i) {
    if (state.mesh.topology->on_boundary(i)) {
      CHECK((state.mesh.coordinates.xy(i) - expected.xy(i)).norm() < 1e-14);
    }
  }
}

}  // namespace

TEST_CASE("move: the boundary ends where it was sent, the interior follows, the input stays") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const MeshState state = plate_state(cells);
    const Coordinates before = state.mesh.coordinates;
    const CommandResult result = execute(small_move(), state);
    CHECK(state.mesh.coordinates == before);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    CHECK(result.smooth.increments == 1);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.outer_iterations > 0);
    CHECK(result.smooth.linear_solves >= result.smooth.outer_iterations);
    CHECK(result.smooth.residual <= 1e-10);
    CHECK(inverted(result.state) == 0);
    CHECK(result.state.mesh.topology == state.mesh.topology);
    CHECK(result.state.vcvs.plane() == state.vcvs.plane());
    check_boundary(result.state, boundary_moved(state, small_move()));
  }
}

TEST_CASE("smooth: only free nodes move, and a second time changes nothing") {
  MeshState state = plate_state();
  constexpr std::uint64_t seed = 1;
  CAPTURE(seed);
  Random random(seed);
  perturb(state.mesh, random);
  // Targets `auto` are those of the mesh as given, which is another one the second time.
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  const CommandResult once = execute(command, state);
  CHECK(once.smooth.converged);
  check_boundary(once.state, state.mesh.coordinates);
  const CommandResult twice = execute(command, once.state);
  CHECK(twice.smooth.converged);
  CHECK(twice.smooth.outer_iterations == 0);
  CHECK(twice.state.mesh.coordinates == once.state.mesh.coordinates);
}

TEST_CASE("deform by a sine and by a table") {
  const MeshState state = plate_state(Cells::quads);
  DeformCommand command;
  command.markers = {"hole"};
  SUBCASE("sine") { command.shape = SineDeformation{0.02, 1, {0, 1}, Fade::both, 0.2}; }
  SUBCASE("table") {
    DisplacementTable table;
    const std::vector<std::string> hole{"hole"};
    for (const Index node : state.mesh.topology->markers().nodes_of(hole)) {
      table.entries.push_back({node, {0, 0}, {0.03, -0.01}, 0});
    }
    command.shape = table;
  }
  const CommandResult result = execute(command, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  const auto motion = std::visit(
      [&](const auto& shape) {
        return make_motion(*state.mesh.topology, state.mesh.coordinates, command.markers, shape);
      },
      command.shape);
  Coordinates expected = state.mesh.coordinates;
  motion->apply(state.mesh.coordinates, 1, expected);
  CHECK(largest_difference(expected, state.mesh.coordinates) > 0.01);
  check_boundary(result.state, expected);
}

TEST_CASE("scramble: the same mesh for the same seed, inside the box, boundary untouched") {
  const MeshState state = plate_state(Cells::mixed);
  const CommandResult first = execute(ScrambleCommand{5}, state);
  const CommandResult again = execute(ScrambleCommand{5}, state);
  const CommandResult other = execute(ScrambleCommand{6}, state);
  CHECK(first.state.mesh.coordinates == again.state.mesh.coordinates);
  CHECK_FALSE(first.state.mesh.coordinates == other.state.mesh.coordinates);
  CHECK(first.smooth.inverted == inverted(first.state));
  CHECK(first.smooth.inverted > 0);
  CHECK(first.smooth.converged);
  CHECK(first.smooth.outer_iterations == 0);
  check_boundary(first.state, state.mesh.coordinates);
  const Bounds box = bounds(state.mesh);
  Index moved = 0;
  for (const Index node : state.mesh.topology->interior_nodes()) {
    const Vec2 p = first.state.mesh.coordinates.xy(node);
    CHECK((p.array() >= box.min.array()).all());
    CHECK((p.array() <= box.max.array()).all());
    moved += p != state.mesh.coordinates.xy(node) ? 1 : 0;
  }
  CHECK(moved == static_cast<Index>(state.mesh.topology->interior_nodes().size()));
}

TEST_CASE("a scrambled seed means these coordinates on every machine") {
  const MeshState state = make_state(make_mesh(regular_star(4)));
  const CommandResult result = execute(ScrambleCommand{1}, state);
  // The first two numbers of mt19937_64 with seed 1, over the box [-1, 1] squared.
  std::mt19937_64 generator(1);
  const double u = static_cast<double>(generator() >> 11) / 9007199254740992.0;
  const double v = static_cast<double>(generator() >> 11) / 9007199254740992.0;
  CHECK(result.state.mesh.coordinates.xy(0).x() == doctest::Approx(2 * u - 1));
  CHECK(result.state.mesh.coordinates.xy(0).y() == doctest::Approx(2 * v - 1));
}

TEST_CASE("scramble and smooth give the mesh that smoothing alone gives") {
  const MeshState state = plate_state(Cells::mixed);
  SmoothCommand command;
  command.smooth.targets = TargetBlend::regular();
  const Coordinates expected = execute(command, state).state.mesh.coordinates;
  const CommandResult scrambled = execute(ScrambleCommand{3}, state);
  const CommandResult result = execute(command, scrambled.state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  CHECK(largest_difference(result.state.mesh.coordinates, expected) < 1e-6);
}

TEST_CASE("moving the boundary only leaves the interior where it is") {
  const MeshState state = plate_state();
  MoveCommand command = small_move();
  command.how.smooth_after = false;
  const CommandResult result = execute(command, state);
  CHECK(result.state.mesh.coordinates == boundary_moved(state, command));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.outer_iterations == 0);
  CHECK(result.smooth.history.empty());
  CHECK(result.smooth.inverted == inverted(result.state));
  CHECK(result.smooth.inverted > 0);
}

TEST_CASE("a warm start changes the way, not the result") {
  const MeshState state = plate_state();
  const CommandResult cold = execute(small_move(), state);
  Coordinates start = cold.state.mesh.coordinates;
  for (Index i = 0; i < start.size(); ++i) {
    // The boundary part of a start is ignored.
    if (state.mesh.topology->on_boundary(i)) start.set_xy(i, {99, 99});
  }
  RunOptions options;
  options.start = &start;
  const CommandResult warm = execute(small_move(), state, options);
  CHECK(warm.smooth.converged);
  CHECK(warm.smooth.outer_iterations < cold.smooth.outer_iterations);
  CHECK(largest_difference(warm.state.mesh.coordinates, cold.state.mesh.coordinates) < 1e-8);
  const Coordinates wrong(2, 3);
  options.start = &wrong;
  CHECK_THROWS_AS(execute(small_move(), state, options), UsageError);
}

TEST_CASE("a start whose boundary has arrived is smoothed to the end") {
  const MeshState state = ring_state();
  const Coordinates& rest = state.mesh.coordinates;
  for (const double degrees : {30.0, 60.0, 90.0}) {
    CAPTURE(degrees);
    MoveCommand move;
    move.bodies[0].markers = {"inner"};
    move.bodies[0].motion = {degrees, Vec2(0, 0), {0, 0}};
    const CommandResult cold = execute(move, state);
    // A mesh far from the solution, as the first one of a drag: each node turns by an angle that is
    // linear in its radius, which is from 1 to 20.
    Coordinates start = rest;
    for (Index i = 0; i < start.size(); ++i) {
      const double share = (20 - rest.xy(i).norm()) / 19;
      start.set_xy(i, transform({degrees * share, Vec2(0, 0), {0, 0}}, rest.xy(i)));
    }
    for (Index i = 0; i < start.size(); ++i)
      if (state.mesh.topology->on_boundary(i)) start.copy_node(i, cold.state.mesh.coordinates);
    REQUIRE(check_validity(*state.mesh.topology, start).inverted == 0);
    RunOptions options;
    options.start = &start;
    const CommandResult warm = execute(move, state, options);
    CHECK(warm.smooth.converged);
    CHECK(warm.smooth.fraction_reached == 1);
    CHECK(largest_difference(warm.state.mesh.coordinates, cold.state.mesh.coordinates) < 1e-8);
  }
}

TEST_CASE("a cache kept over commands, meshes and options changes no bit of the result") {
  SolverCache cache;
  const MeshState states[] = {plate_state(), ring_state(), plate_state(Cells::quads)};
  for (int round = 0; round < 2; ++round) {
    for (const MeshState& state : states) {
      for (const std::string& name : general_solver_names()) {
        CAPTURE(name);
        SmoothCommand command;
        command.smooth.linear.solver = name;
        command.smooth.threads = 1 + round;
        MeshState start = state;
        Random random(9);
        tangle(start.mesh, random);
        command.smooth.max_iterations = 12;
        RunOptions options;
        options.cache = &cache;
        const CommandResult kept = execute(command, start, options);
        const CommandResult fresh = execute(command, start);
        CHECK(kept.state.mesh.coordinates == fresh.state.mesh.coordinates);
      }
    }
  }
}

TEST_CASE("cancelling throws, and leaves the state as it was") {
  const MeshState state = plate_state();
  const Coordinates before = state.mesh.coordinates;
  for (const int at_call : {1, 2, 5}) {
    Watcher watcher(at_call);
    RunOptions options;
    options.monitor = &watcher;
    CHECK_THROWS_AS(execute(small_move(), state, options), Cancelled);
    CHECK(static_cast<int>(watcher.records.size()) == at_call);
    CHECK(state.mesh.coordinates == before);
  }
}

TEST_CASE("the monitor sees every record of the history, and the coordinates of each") {
  const MeshState state = plate_state();
  MoveCommand command = small_move();
  command.how.increments = 3;
  Watcher watcher;
  RunOptions options;
  options.monitor = &watcher;
  const CommandResult result = execute(command, state, options);
  REQUIRE(watcher.records.size() == result.smooth.history.size());
  CHECK(watcher.last == result.state.mesh.coordinates);
  CHECK(result.smooth.increments == 3);
  int last_iteration = 0;
  double fraction = 0;
  for (std::size_t k = 0; k < watcher.records.size(); ++k) {
    const IterationRecord& record = watcher.records[k];
    CHECK(record.residual == result.smooth.history[k].residual);
    CHECK(record.iteration >= last_iteration);
    CHECK(record.iteration <= last_iteration + 1);
    CHECK(record.fraction >= fraction);
    last_iteration = record.iteration;
    fraction = record.fraction;
  }
  CHECK(fraction == 1);
  CHECK(watcher.records.front().fraction == doctest::Approx(1.0 / 3));
  CHECK(last_iteration == result.smooth.outer_iterations);
}

TEST_CASE("explicit increments reach the mesh that one step reaches") {
  const MeshState state = plate_state();
  const CommandResult once = execute(small_move(), state);
  for (const int increments : {1, 2, 5}) {
    CAPTURE(increments);
    MoveCommand command = small_move();
    command.how.increments = increments;
    const CommandResult result = execute(command, state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.increments == increments);
    CHECK(largest_difference(result.state.mesh.coordinates, once.state.mesh.coordinates) < 1e-8);
  }
}

TEST_CASE("a winding that cannot be done at once is done in steps, automatically") {
  const MeshState state = ring_state();
  MoveCommand direct = turn(200);
  direct.smooth.formulation = Formulation::pointwise;
  direct.smooth.outer = OuterMethod::picard;
  direct.how.increments = 1;
  const CommandResult at_once = execute(direct, state);
  CHECK(at_once.smooth.inverted > 0);
  CHECK(at_once.smooth.increments == 1);
  // How far the mesh turns from the inner to the outer ring, along one chain of edges.
  const auto inner_to_outer = [&](const Coordinates& x) {
    double winding = 0;
    Index node = 0;
    for (int ring = 0; ring < 16; ++ring) {
      const auto row = state.mesh.topology->neighbours(node);
      Index next = -1;
      for (const Index k : row) {
        if (k > node && (next < 0 || k < next) && k >= (ring + 1) * 24) next = k;
      }
      REQUIRE(next >= 0);
      const Vec2 a = x.xy(node), b = x.xy(next);
      winding += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      node = next;
    }
    return winding * 180 / pi;
  };
  const double rest = inner_to_outer(state.mesh.coordinates);
  MoveCommand stepped = direct;
  stepped.how.increments = 0;
  const CommandResult automatic = execute(stepped, state);
  CHECK(automatic.smooth.increments > 1);
  CHECK(automatic.smooth.inverted == 0);
  CHECK(automatic.smooth.converged);
  CHECK(inverted(automatic.state) == 0);
  CHECK(inner_to_outer(automatic.state.mesh.coordinates) - rest == doctest::Approx(-200));
  check_boundary(automatic.state, boundary_moved(state, turn(200)));
  // Along a path the winding needs no steps to be chosen.
  const CommandResult followed = execute(turn(200), state);
  CHECK(followed.smooth.converged);
  CHECK(followed.smooth.inverted == 0);
  CHECK(inner_to_outer(followed.state.mesh.coordinates) - rest == doctest::Approx(-200));
}

TEST_CASE("the limit of iterations is kept, and said") {
  const MeshState state = plate_state();
  for (const Formulation formulation : {Formulation::variational, Formulation::pointwise}) {
    for (const int increments : {0, 1}) {
      CAPTURE(formulation_name(formulation));
      CAPTURE(increments);
      // The fixed point may begin anew with more steps, each time with the whole limit.
      if (formulation == Formulation::pointwise && increments == 0) continue;
      MoveCommand command = small_move();
      command.smooth.formulation = formulation;
      command.smooth.max_iterations = 3;
      command.how.increments = increments;
      const CommandResult result = execute(command, state);
      CHECK_FALSE(result.smooth.converged);
      CHECK(result.smooth.outer_iterations == 3);
      CHECK(result.smooth.residual > 1e-10);
      CHECK(result.smooth.inverted == inverted(result.state));
    }
  }
}

TEST_CASE("commands with options out of range are refused") {
  const MeshState state = plate_state();
  MoveCommand command = small_move();
  SUBCASE("unknown marker") { command.bodies[0].markers = {"wing"}; }
  SUBCASE("no marker") { command.bodies[0].markers = {}; }
  SUBCASE("negative increments") { command.how.increments = -1; }
  SUBCASE("damping") { command.smooth.damping = 0; }
  SUBCASE("formulation") { command.smooth.formulation = static_cast<Formulation>(2); }
  SUBCASE("linear solver") { command.smooth.linear.solver = "magic"; }
  CHECK_THROWS_AS(execute(command, state), UsageError);
  DeformCommand deform;
  deform.markers = {"hole"};
  deform.smooth.tolerance = -1;
  CHECK_THROWS_AS(execute(deform, state), UsageError);
  SmoothCommand smooth;
  smooth.smooth.threads = -1;
  CHECK_THROWS_AS(execute(smooth, state), UsageError);
}

TEST_CASE("commands have names and one-line descriptions") {
  MoveCommand move;
  move.bodies[0].markers = {"slat", "flap"};
  move.bodies[0].motion.rotate = -40;
  CHECK(describe(move) == "Rotate slat, flap by -40 deg");
  move.bodies[0].motion.translate = {0.5, -2};
  CHECK(describe(move) == "Rotate slat, flap by -40 deg and move it by (0.5, -2)");
  move.bodies[0].motion.rotate = 0;
  CHECK(describe(move) == "Move slat, flap by (0.5, -2)");
  CHECK(command_name(move) == "move");
  // What a drag gives has more digits than one reads.
  move.bodies[0].motion = {30.000000012, Vec2(0, 0), Vec2(0, 0)};
  CHECK(describe(move) == "Rotate slat, flap by 30 deg");
  move.bodies[0].motion.rotate = 12.3456789;
  CHECK(describe(move) == "Rotate slat, flap by 12.35 deg");
  move.bodies[0].motion.rotate = 0.00123456;
  CHECK(describe(move) == "Rotate slat, flap by 0.00123456 deg");
  move.bodies[0].motion = {0, Vec2(0, 0), Vec2(0.123456789, -1234.5678)};
  CHECK(describe(move) == "Move slat, flap by (0.1235, -1235)");
  MoveCommand several;
  several.bodies = {{{"slat"}, {.rotate = 20}},
                    {{"flap", "vane"}, {.rotate = -40, .translate = Vec2(0.5, -2)}},
                    {{"tab"}, {.translate = Vec3(0, 0, 1), .axis = Vec3(0, 0, 1)}}};
  CHECK(describe(several) ==
        "Rotate slat by 20 deg, rotate flap, vane by -40 deg and move it by (0.5, -2), "
        "move tab by (0, 0, 1)");
  DeformCommand deform;
  deform.markers = {"main"};
  deform.shape = SineDeformation{0.05, 2, {0, 1}, Fade::none, 0.2};
  CHECK(describe(deform) == "Deform main: sine, amplitude 0.05, 2 waves");
  deform.shape = DisplacementTable{{{1, {0, 0}, {1, 1}, 0}, {2, {0, 0}, {1, 1}, 0}}, "f.csv"};
  CHECK(describe(deform) == "Displace 2 nodes of main");
  CHECK(command_name(deform) == "deform");
  CHECK(describe(ScrambleCommand{12}) == "Scramble, seed 12");
  CHECK(command_name(ScrambleCommand{}) == "scramble");
  CHECK(describe(SmoothCommand{}) == "Smooth");
  CHECK(command_name(SmoothCommand{}) == "smooth");
  std::set<std::string_view> names;
  for (const Command& each : all_commands()) CHECK(names.insert(command_name(each)).second);
  CHECK(names.size() == std::variant_size_v<Command>);
  CHECK(markers_of(move) == move.bodies[0].markers);
  CHECK(markers_of(SmoothCommand{}).empty());
  LayersCommand layers;
  layers.layers.walls = {{{"a", "b"}, {}}, {{"c"}, {}}};
  CHECK(markers_of(layers) == std::vector<std::string>{"a", "b", "c"});
}

TEST_CASE("the smoothing options of a command can be reached, where there are any") {
  Command move = MoveCommand{};
  REQUIRE(smooth_options(move) != nullptr);
  smooth_options(move)->damping = 0.125;
  CHECK(std::get<MoveCommand>(move).smooth.damping == 0.125);
  Command smooth = SmoothCommand{}, deform = DeformCommand{}, scramble = ScrambleCommand{};
  CHECK(smooth_options(smooth) != nullptr);
  CHECK(smooth_options(deform) != nullptr);
  CHECK(smooth_options(scramble) == nullptr);
}

TEST_CASE("bodies that are moved together end where each motion takes them, in a valid mesh") {
  const MeshState state = make_state(make_mesh(square_with_two_holes(20, Cells::triangles)));
  MoveCommand command;
  command.bodies = {{{"hole_a"}, {.rotate = 35, .translate = Vec2(0.05, 0.02)}},
                    {{"hole_b"}, {.rotate = -20, .pivot = Vec2(0.6, 0.5)}}};
  CHECK(markers_of(command) == std::vector<std::string>{"hole_a", "hole_b"});
  const CommandResult result = execute(command, state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.fraction_reached == 1);
  CHECK(result.smooth.inverted == 0);
  const RigidMotion of_a{35, Vec2(0.3, 0.5), Vec2(0.05, 0.02)}, of_b{-20, Vec2(0.6, 0.5), {0, 0}};
  const Topology& topology = *state.mesh.topology;
  for (Index node = 0; node < topology.node_count(); ++node) {
    const Vec2 from = state.mesh.coordinates.xy(node), to = result.state.mesh.coordinates.xy(node);
    const bool outer = (from - Vec2(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.5 - 1e-9;
    if (!topology.on_boundary(node)) continue;
    const Vec2 there = outer ? from : transform(from.x() < 0.5 ? of_a : of_b, from);
    CHECK((to - there).norm() < 1e-12);
  }
  // Far away it is the same.
  MeshState far = state;
  const Vec2 away(3e6, -4e6);
  for (Index node = 0; node < topology.node_count(); ++node)
    far.mesh.coordinates.set_xy(node, far.mesh.coordinates.xy(node) + away);
  command.bodies[1].motion.pivot = Vec2(away + Vec2(0.6, 0.5));
  const CommandResult there = execute(command, make_state(far.mesh));
  CHECK(there.smooth.converged);
  for (Index node = 0; node < topology.node_count(); ++node)
    CHECK((there.state.mesh.coordinates.xy(node) - away - result.state.mesh.coordinates.xy(node))
              .norm() < 1e-6);
}

TEST_CASE("bodies that would run into each other on their way end before that") {
  const MeshState state = make_state(make_mesh(square_with_two_holes(20, Cells::triangles)));
  MoveCommand command;
  command.bodies = {{{"hole_a"}, {.translate = Vec2(0.2, 0.01)}},
                    {{"hole_b"}, {.translate = Vec2(-0.2, 0)}}};
  RunOptions whole;
  whole.all_or_nothing = true;
  const CommandResult refused = execute(command, state, whole);
  REQUIRE(refused.smooth.contact);
  CHECK(refused.smooth.contact->fraction == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(describe_touch(refused.smooth.contact->edges) == "hole_a would touch hole_b");
  CHECK(refused.state.mesh.coordinates == state.mesh.coordinates);
  const CommandResult partial = execute(command, state);
  CHECK(partial.smooth.inverted == 0);
  CHECK(partial.smooth.fraction_reached > 0.2);
  CHECK(partial.smooth.fraction_reached < 0.5);
}
