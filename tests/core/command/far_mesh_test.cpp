#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

/// Commands on a mesh far from the origin do what they do near it.
namespace winslow::test {

namespace {

constexpr double ulp = 0x1p-28;  // of coordinates around 3e7

const Vec2 away(1e7, -3e7);

/// The same mesh near the origin and far from it, with the same coordinates in binary: what the
/// shift rounds off is taken off the near one as well.
struct Pair {
  MeshState near, far;
};

Pair pair_of(MeshData data) {
  MeshData far = data;
  for (Index i = 0; i < data.node_count(); ++i) {
    far.coordinates.set_xy(i, data.coordinates.xy(i) + away);
    data.coordinates.set_xy(i, far.coordinates.xy(i) - away);
  }
  return {make_state(make_mesh(data)), make_state(make_mesh(far))};
}

MeshData holes() { return square_with_two_holes(20, Cells::mixed); }

double largest_difference(const Coordinates& near, const Coordinates& far) {
  REQUIRE(near.size() == far.size());
  double largest = 0;
  for (Index i = 0; i < near.size(); ++i)
    largest = std::max(largest, (far.xy(i) - away - near.xy(i)).lpNorm<Eigen::Infinity>());
  return largest;
}

void check_same(const Command& near, const Command& far, MeshData data) {
  const Pair states = pair_of(std::move(data));
  const CommandResult a = execute(near, states.near);
  const CommandResult b = execute(far, states.far);
  CHECK(b.smooth.converged == a.smooth.converged);
  CHECK(b.smooth.outer_iterations == a.smooth.outer_iterations);
  CHECK(b.smooth.linear_solves == a.smooth.linear_solves);
  CHECK(b.smooth.fraction_reached == a.smooth.fraction_reached);
  CHECK(b.smooth.inverted == a.smooth.inverted);
  CHECK(largest_difference(a.state.mesh.coordinates, b.state.mesh.coordinates) < 2 * ulp);
  const Topology& topology = *states.far.mesh.topology;
  if (!markers_of(near).empty()) return;
  for (Index i = 0; i < topology.node_count(); ++i) {
    if (topology.on_boundary(i))
      CHECK(b.state.mesh.coordinates.xy(i) == states.far.mesh.coordinates.xy(i));
  }
}

void check_same(const Command& command, MeshData data) {
  check_same(command, command, std::move(data));
}

}  // namespace

TEST_CASE("far away: smoothing, by either formulation") {
  SmoothCommand command;
  check_same(command, holes());
  command.smooth.formulation = "pointwise";
  command.smooth.outer = OuterMethod::picard;
  check_same(command, holes());
}

TEST_CASE("far away: motions, about the bodies' centre and about a named pivot") {
  MoveCommand near;
  near.markers = {"hole_a"};
  near.motion.rotate = 40;  // about the centre
  near.motion.translate = Vec2(0.05, 0.1);
  check_same(near, holes());
  MoveCommand far = near;
  near.motion.pivot = Vec2(0.5, 0.25);
  far.motion.pivot = away + Vec2(0.5, 0.25);
  check_same(near, far, holes());
}

TEST_CASE("far away: deformations, of the whole body and of nodes by their place") {
  DeformCommand sine;
  sine.markers = {"hole_b"};
  sine.shape = SineDeformation{0.04, 1.5};
  check_same(sine, holes());
  DeformCommand near = sine, far = sine;
  const Vec2 corner(0.6, 0.4);
  near.shape = DisplacementTable{{{std::nullopt, corner, Vec2(0.02, -0.03), 7}}, "d.csv"};
  far.shape = DisplacementTable{{{std::nullopt, away + corner, Vec2(0.02, -0.03), 7}}, "d.csv"};
  check_same(near, far, holes());
  // A place that is none is named as the user wrote it.
  std::get<DisplacementTable>(far.shape).entries[0].position = away;
  try {
    execute(far, pair_of(holes()).far);
    FAIL("expected UsageError");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what()).find("d.csv:7: position (10000000") == 0);
  }
}

TEST_CASE("far away: layers, at a part of a wall that a box names") {
  LayersCommand near;
  LayerWall wall;
  wall.markers = {"hole_a"};
  wall.spacing.count = 4;
  wall.spacing.first = 0.002;
  wall.part.xmax = 0.31;
  near.layers.walls = {wall};
  LayersCommand far = near;
  far.layers.walls[0].part.xmax += away.x();
  check_same(near, far, square_with_two_holes(20, Cells::triangles));
}

TEST_CASE("far away: the meshes on the way are shown where the mesh is") {
  class Watch final : public SolverMonitor {
   public:
    bool on_iteration(const IterationRecord&, const Coordinates& x) override {
      CHECK((x.xy(0) - away).norm() < 2);
      ++seen;
      return true;
    }
    int seen = 0;
  };
  const Pair states = pair_of(holes());
  Watch watch;
  RunOptions options;
  options.monitor = &watch;
  // The start is given where the mesh is, too.
  const Coordinates start = states.far.mesh.coordinates;
  options.start = &start;
  MoveCommand command;
  command.markers = {"hole_a"};
  command.motion.rotate = 20;
  const CommandResult result = execute(command, states.far, options);
  CHECK(result.smooth.converged);
  CHECK(watch.seen > 0);
}

/// Commands on a volume mesh far from the origin do what they do near it.

namespace {

const Vec3 away_in_space(4.5e5, 5.1e6, 300);
constexpr double step_in_space = 0x1p-30;  // between neighbouring numbers around 5e6

/// A body in a box near the origin and far from it, with the same coordinates in binary: what the
/// shift rounds off is taken off the near one as well. Inner nodes off their regular places.
struct VolumePair {
  explicit VolumePair(Volumes volumes, const Vec3& by = away_in_space) : away(by) {
    Mesh mesh = box_with_body(5, volumes), shifted = mesh;
    Random random(11);
    for (const Index node : mesh.topology->interior_nodes()) {
      const Vec3 off(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 0.02 * off);
    }
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      shifted.coordinates.set_xyz(i, mesh.coordinates.xyz(i) + away);
      mesh.coordinates.set_xyz(i, shifted.coordinates.xyz(i) - away);
    }
    near = make_state(mesh);
    far = make_state(shifted);
  }

  Vec3 away;
  MeshState near, far;
};

double far_difference(const VolumePair& pair, const Coordinates& near, const Coordinates& far) {
  double largest = 0;
  for (Index i = 0; i < near.size(); ++i)
    largest = std::max(largest, (far.xyz(i) - pair.away - near.xyz(i)).lpNorm<Eigen::Infinity>());
  return largest;
}

void check_same_far(const Command& near, const Command& far, const VolumePair& pair) {
  const CommandResult a = execute(near, pair.near);
  const CommandResult b = execute(far, pair.far);
  CHECK(b.smooth.converged == a.smooth.converged);
  CHECK(b.smooth.outer_iterations == a.smooth.outer_iterations);
  CHECK(b.smooth.linear_solves == a.smooth.linear_solves);
  CHECK(b.smooth.fraction_reached == a.smooth.fraction_reached);
  CHECK(b.smooth.inverted == a.smooth.inverted);
  CHECK(far_difference(pair, a.state.mesh.coordinates, b.state.mesh.coordinates) <
        2 * step_in_space);
  const Topology& topology = *pair.far.mesh.topology;
  std::vector<Index> moved;
  if (!markers_of(far).empty()) moved = topology.markers().nodes_of(markers_of(far));
  int kept = 0;
  for (Index i = 0; i < topology.node_count(); ++i) {
    if (!topology.on_boundary(i) || std::ranges::binary_search(moved, i)) continue;
    CHECK(b.state.mesh.coordinates.same_place(i, pair.far.mesh.coordinates));
    ++kept;
  }
  CHECK(kept > 100);
}

MoveCommand turned_body() {
  MoveCommand move;
  move.markers = {"body"};
  move.motion.rotate = 25;
  move.motion.axis = Vec3(1, 1, 0.5);
  move.motion.translate = Vec2(0.03, -0.02);
  move.motion.translate_z = 0.04;
  return move;
}

}  // namespace

TEST_CASE("far away in space: smoothing, of all elements and along each axis") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    check_same_far(SmoothCommand{}, SmoothCommand{}, VolumePair(volumes));
  }
  for (const Vec3& by : {Vec3(0, 0, 5.1e6), Vec3(0, -5.1e6, 0), Vec3(5.1e6, 0, 0)}) {
    CAPTURE(by.transpose());
    check_same_far(SmoothCommand{}, SmoothCommand{}, VolumePair(Volumes::tetrahedra, by));
  }
}

TEST_CASE("far away in space: every form and its virtual control volumes") {
  const VolumePair pair(Volumes::tetrahedra);
  SmoothCommand command;
  command.smooth.targets = {.automatic = 0, .vcv = 1};
  for (const VcvKind kind : {VcvKind::equal, VcvKind::existing, VcvKind::adjusted}) {
    command.smooth.vcv = kind;
    check_same_far(command, command, pair);
  }
  command.smooth.vcv_lengths = 0.5;
  command.smooth.vcv_updates = 2;
  check_same_far(command, command, pair);
  command = {};
  command.smooth.formulation = "pointwise";
  command.smooth.outer = OuterMethod::picard;
  check_same_far(command, command, pair);
}

TEST_CASE("far away in space: scrambled, and smoothed again") {
  const VolumePair pair(Volumes::tetrahedra);
  ScrambleCommand scramble;
  scramble.seed = 4;
  check_same_far(scramble, scramble, pair);
  VolumePair tangled = pair;
  tangled.near = execute(scramble, pair.near).state;
  tangled.far = execute(scramble, pair.far).state;
  const CommandResult result = execute(SmoothCommand{}, tangled.far);
  CHECK(result.smooth.inverted == 0);
  CHECK(far_difference(pair, execute(SmoothCommand{}, tangled.near).state.mesh.coordinates,
                       result.state.mesh.coordinates) < 1e-6);
}

TEST_CASE("far away in space: motions about the body's centre and about a named pivot") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::mixed}) {
    CAPTURE(name_of(volumes));
    const VolumePair pair(volumes);
    MoveCommand near = turned_body();
    check_same_far(near, near, pair);
    const Vec3 pivot(0.5, 0.25, 0.375);
    MoveCommand far = near;
    near.motion.pivot = pivot.head<2>();
    near.motion.pivot_z = pivot.z();
    far.motion.pivot = Vec2((away_in_space + pivot).head<2>());
    far.motion.pivot_z = away_in_space.z() + pivot.z();
    check_same_far(near, far, pair);
  }
}

TEST_CASE("far away in space: a pivot without a third component lies at z = 0") {
  const VolumePair pair(Volumes::tetrahedra, Vec3(0, 0, 64));
  MoveCommand near = turned_body();
  near.motion.rotate = 0.05;
  near.motion.pivot = Vec2(0.5, 0.5);
  near.motion.pivot_z = -64;
  MoveCommand far = near;
  far.motion.pivot_z.reset();
  check_same_far(near, far, pair);
}

TEST_CASE("far away in space: deformations, of the whole body and of nodes by their place") {
  const VolumePair pair(Volumes::mixed);
  DeformCommand sine;
  sine.markers = {"body"};
  sine.shape = SineDeformation{.amplitude = 0.02, .waves = 0.5, .along = Vec3(0, 0, 1)};
  check_same_far(sine, sine, pair);
  const Vec3 corner(0.4, 0.4, 0.6), far_corner = away_in_space + corner;
  const auto table_at = [](const Vec3& place) {
    DisplacementEntry entry{std::nullopt, place.head<2>(), Vec2(0.02, -0.03), 7};
    entry.position_z = place.z();
    entry.displacement_z = 0.01;
    return DisplacementTable{{entry}, "d.csv"};
  };
  DeformCommand near = sine, far = sine;
  near.shape = table_at(corner);
  far.shape = table_at(far_corner);
  check_same_far(near, far, pair);
  // A place that is none is named as the user wrote it, and one without z is refused.
  const auto refusal = [&](const std::function<void(DisplacementEntry&)>& change) {
    DeformCommand wrong = far;
    change(std::get<DisplacementTable>(wrong.shape).entries[0]);
    try {
      execute(wrong, pair.far);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal([](DisplacementEntry& e) {
          e.position_z = 310;
        }).find("d.csv:7: position (450000.4") == 0);
  CHECK(refusal([](DisplacementEntry& e) { e.position_z.reset(); }).find("has no z") !=
        std::string::npos);
}

TEST_CASE("far away in space: a contact is named where it lies") {
  const VolumePair pair(Volumes::tetrahedra);
  MoveCommand move = turned_body();
  move.motion.rotate = 0;
  move.motion.translate = Vec2(0.9, 0);
  move.motion.translate_z.reset();
  const CommandResult a = execute(move, pair.near), b = execute(move, pair.far);
  REQUIRE(a.smooth.contact);
  REQUIRE(b.smooth.contact);
  CHECK(b.smooth.contact->fraction == a.smooth.contact->fraction);
  const EdgePair &near = a.smooth.contact->edges, &far = b.smooth.contact->edges;
  REQUIRE((near.place_z && far.place_z));
  const Vec3 difference(far.place.x() - near.place.x() - away_in_space.x(),
                        far.place.y() - near.place.y() - away_in_space.y(),
                        *far.place_z - *near.place_z - away_in_space.z());
  CHECK(difference.norm() < 1e-7);
}

TEST_CASE("far away in space: the meshes on the way are shown where the mesh is") {
  class Watch final : public SolverMonitor {
   public:
    bool on_iteration(const IterationRecord&, const Coordinates& x) override {
      CHECK((x.xyz(0) - away_in_space).norm() < 2);
      ++seen;
      return true;
    }
    int seen = 0;
  };
  const VolumePair pair(Volumes::tetrahedra);
  Watch watch;
  RunOptions options;
  options.monitor = &watch;
  const Coordinates start = pair.far.mesh.coordinates;
  options.start = &start;
  CHECK(execute(turned_body(), pair.far, options).smooth.converged);
  CHECK(watch.seen > 0);
}

}  // namespace winslow::test
