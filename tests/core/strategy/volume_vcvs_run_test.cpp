#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A ball of radius 1 in a box of edge 10: a cubic cavity of a grid, whose layers grow outwards
/// and turn from spheres into cubes; the interior shaken. Markers outer, cavity. n: cells of the
/// grid along an edge, a multiple of 6.
Mesh make_ball_in_box(Index n) {
  Mesh mesh = make_mesh(cube_with_cavity(n, Volumes::tetrahedra));
  Random random(41);
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    const Vec3 p = mesh.coordinates.xyz(i) - Vec3::Constant(0.5);
    const double layer = p.cwiseAbs().maxCoeff();              // 1/6 at the body, 1/2 at the box
    const double out = std::clamp(3 * layer - 0.5, 0.0, 1.0);  // 0 at the body, 1 at the box
    const double radius = std::pow(5.0, out);
    Vec3 place = radius * ((1 - out) * p.normalized() + out * p / layer);
    if (!mesh.topology->on_boundary(i)) place += 0.04 * radius * random_vector(random);
    mesh.coordinates.set_xyz(i, place);
  }
  return mesh;
}

const Mesh& ball_in_box() {
  static const Mesh made = make_ball_in_box(12);
  return made;
}
/// For tests that smooth it many times over.
const Mesh& coarse_ball_in_box() {
  static const Mesh made = make_ball_in_box(6);
  return made;
}

SmoothCommand smooth_by(Formulation formulation, VcvKind vcv,
                        OuterMethod outer = OuterMethod::automatic) {
  SmoothCommand command;
  command.smooth.formulation = formulation;
  command.smooth.targets = {.automatic = 0, .vcv = 1};
  command.smooth.outer = outer;
  command.smooth.vcv = vcv;
  command.smooth.tolerance = 1e-10;
  return command;
}

double mean_aspect(const Mesh& mesh) {
  return measure_quality(mesh).of(Metric::aspect_ratio).statistics.avg;
}
double smallest_angle(const Mesh& mesh) {
  return measure_quality(mesh).of(Metric::smallest_solid_angle).statistics.min;
}

class Watch final : public SolverMonitor {
 public:
  explicit Watch(int most) : most_(most) {}
  bool on_iteration(const IterationRecord& record, const Coordinates&) override {
    records.push_back(record);
    return static_cast<int>(records.size()) < most_;
  }
  std::vector<IterationRecord> records;

 private:
  int most_;
};

}  // namespace

TEST_CASE("adjusted VCVs improve a volume mesh, in either form") {
  const Mesh& mesh = ball_in_box();
  REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    const CommandResult result = execute(smooth_by(form, VcvKind::adjusted), make_state(mesh));
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    CHECK(mean_aspect(result.state.mesh) < mean_aspect(mesh));
    CHECK(smallest_angle(result.state.mesh) > smallest_angle(mesh));
  }
}

TEST_CASE("in space Newton's method and the fixed point lead to the same mesh") {
  const MeshState state = make_state(ball_in_box());
  const CommandResult newton =
      execute(smooth_by(Formulation::pointwise, VcvKind::adjusted, OuterMethod::newton), state);
  const CommandResult picard =
      execute(smooth_by(Formulation::pointwise, VcvKind::adjusted, OuterMethod::picard), state);
  CHECK(newton.smooth.converged);
  CHECK(picard.smooth.converged);
  CHECK(newton.smooth.linear_solves < picard.smooth.linear_solves);
  CHECK(newton.smooth.linear_solves <= 8);
  CHECK(largest_difference(newton.state.mesh.coordinates, picard.state.mesh.coordinates) < 1e-8);
}

TEST_CASE("adjusted VCVs follow the mesh until they settle") {
  const MeshState state = make_state(coarse_ball_in_box());
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    SmoothCommand command = smooth_by(form, VcvKind::adjusted);
    const CommandResult once = execute(command, state);
    command.smooth.vcv_updates = 3;
    const CommandResult some = execute(command, state);
    command.smooth.vcv_updates = 30;
    const CommandResult many = execute(command, state);
    for (const CommandResult* result : {&once, &some, &many}) {
      CHECK(result->smooth.converged);
      CHECK(result->smooth.inverted == 0);
    }
    // A contraction: three updates have done most of the way.
    const Coordinates& end = many.state.mesh.coordinates;
    const double first = largest_difference(once.state.mesh.coordinates, end);
    CHECK(first > 1e-4);
    CHECK(largest_difference(some.state.mesh.coordinates, end) < 0.5 * first);
    // It ended because no VCV changed, long before so many updates of a solve or more each.
    CHECK(many.smooth.outer_iterations < 120);
    // The mesh that they settled on is its own: from there nothing moves far.
    const CommandResult again = execute(smooth_by(form, VcvKind::adjusted), many.state);
    CHECK(largest_difference(again.state.mesh.coordinates, end) < 0.1 * first);
  }
}

TEST_CASE("VCVs of the other kinds do not follow the mesh, and updates of them are refused") {
  const MeshState state = make_state(ball_in_box());
  for (const VcvKind kind : {VcvKind::equal, VcvKind::existing}) {
    SmoothCommand command = smooth_by(Formulation::variational, kind);
    command.smooth.vcv_updates = 1;
    CHECK_THROWS_WITH_AS(
        execute(command, state),
        "equal and existing VCVs do not follow the mesh: vcv_updates needs the VCVs adjusted",
        UsageError);
  }
}

TEST_CASE("VCVs with the edges and angles of the mesh keep it nearer to what it was") {
  const MeshState state = make_state(ball_in_box());
  const Coordinates& given = state.mesh.coordinates;
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    SmoothCommand command = smooth_by(form, VcvKind::existing);
    double last = 1e300;
    for (const double power : {0.0, 0.5, 1.0}) {
      CAPTURE(power);
      command.smooth.vcv_lengths = power;
      const CommandResult result = execute(command, state);
      CHECK(result.smooth.converged);
      CHECK(result.smooth.inverted == 0);
      double moved = 0;
      for (const Index node : state.mesh.topology->interior_nodes())
        moved += (result.state.mesh.coordinates.xyz(node) - given.xyz(node)).norm();
      CHECK(moved < last);
      last = moved;
    }
  }
}

TEST_CASE("a scrambled volume mesh comes back over VCVs, in either form") {
  const Mesh mesh = make_mesh(cube(4, Volumes::tetrahedra));
  ScrambleCommand scramble;
  scramble.seed = 5;
  const CommandResult tangled = execute(scramble, make_state(mesh));
  REQUIRE(tangled.smooth.inverted > 0);
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    const CommandResult result = execute(smooth_by(form, VcvKind::adjusted), tangled.state);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    CHECK(smallest_angle(result.state.mesh) > 0.08);
  }
}

TEST_CASE("a body moves in a volume mesh over its VCVs, through valid meshes") {
  const MeshState state = make_state(ball_in_box());
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    MoveCommand move;
    move.bodies[0].markers = {"cavity"};
    move.bodies[0].motion.translate = Vec2(0.06, 0.03);
    move.bodies[0].motion.rotate = 25;
    move.bodies[0].motion.axis = Vec3(1, 0, 1);
    move.smooth = smooth_by(form, VcvKind::automatic).smooth;
    Watch watch(10'000);
    RunOptions options;
    options.monitor = &watch;
    const CommandResult result = execute(move, state, options);
    CHECK(result.smooth.converged);
    CHECK(result.smooth.fraction_reached == 1);
    CHECK(result.smooth.inverted == 0);
    CHECK(std::all_of(watch.records.begin(), watch.records.end(),
                      [](const IterationRecord& record) { return record.inverted == 0; }));
    // By the fixed point, at once: the same equations, the same mesh.
    if (form == Formulation::variational) continue;
    move.smooth.outer = OuterMethod::picard;
    const CommandResult direct = execute(move, state);
    CHECK(direct.smooth.converged);
    CHECK(largest_difference(direct.state.mesh.coordinates, result.state.mesh.coordinates) < 1e-7);
  }
}

TEST_CASE("runs over VCVs give the same bits at any number of threads") {
  const MeshState state = make_state(ball_in_box());  // so large that threads share the work
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    SmoothCommand command = smooth_by(form, VcvKind::adjusted);
    command.smooth.vcv_updates = 1;
    command.smooth.threads = 1;
    const Coordinates one = execute(command, state).state.mesh.coordinates;
    command.smooth.threads = 3;
    CHECK(execute(command, state).state.mesh.coordinates == one);
  }
}

TEST_CASE("runs over VCVs give the same bits with a used cache") {
  const MeshState state = make_state(coarse_ball_in_box());
  for (const Formulation form : {Formulation::pointwise, Formulation::variational}) {
    CAPTURE(formulation_name(form));
    SmoothCommand command = smooth_by(form, VcvKind::adjusted);
    command.smooth.vcv_updates = 2;
    command.smooth.threads = 1;
    const Coordinates one = execute(command, state).state.mesh.coordinates;
    SolverCache cache;
    RunOptions options;
    options.cache = &cache;
    CHECK(execute(command, state, options).state.mesh.coordinates == one);
    CHECK(execute(command, state, options).state.mesh.coordinates == one);
    // Another kind in between.
    SmoothCommand other = smooth_by(form, VcvKind::existing);
    other.smooth.threads = 1;
    const Coordinates fresh = execute(other, state).state.mesh.coordinates;
    CHECK(fresh != one);
    CHECK(execute(other, state, options).state.mesh.coordinates == fresh);
    CHECK(execute(command, state, options).state.mesh.coordinates == one);
  }
}

TEST_CASE("a fixed point in space reports every iteration, is cancelled, and may not converge") {
  const MeshState state = make_state(ball_in_box());
  SmoothCommand command = smooth_by(Formulation::pointwise, VcvKind::adjusted, OuterMethod::picard);
  command.smooth.max_iterations = 3;
  Watch watch(100);
  RunOptions options;
  options.monitor = &watch;
  const CommandResult result = execute(command, state, options);
  CHECK(!result.smooth.converged);
  CHECK(result.smooth.outer_iterations == 3);
  REQUIRE(watch.records.size() == 4);
  CHECK(watch.records.back().stage == Stage::picard);
  CHECK(watch.records.back().residual < watch.records.front().residual);
  Watch impatient(2);
  options.monitor = &impatient;
  CHECK_THROWS_AS(execute(command, state, options), Cancelled);
  CHECK(impatient.records.size() == 2);
}

TEST_CASE("the paper's perturbation serves in the place of the fit") {
  const MeshState state = make_state(make_mesh(cube_with_cavity(6, Volumes::tetrahedra)));
  const CommandResult result =
      execute(smooth_by(Formulation::variational, VcvKind::perturbation), state);
  CHECK(result.smooth.converged);
  CHECK(result.smooth.inverted == 0);
  const CommandResult fitted =
      execute(smooth_by(Formulation::variational, VcvKind::adjusted), state);
  CHECK(result.state.mesh.coordinates != fitted.state.mesh.coordinates);
}
