#include <doctest/doctest.h>

#include <cmath>

#include "core/command/command.h"
#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "support/space_meshes.h"

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
    move.markers = {"body"};
    move.motion.rotate = 30;
    move.motion.axis = Vec3(1, 1, 0.5);
    move.motion.translate = Vec2(0.03, -0.02);
    move.motion.translate_z = 0.04;
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
  smooth.smooth.targets = TargetBlend::regular();
  const CommandResult result = execute(smooth, make_state(mesh));
  CHECK(result.smooth.converged);
  CHECK(result.smooth.linear_solves <= 12);
  const auto& history = result.smooth.history;
  // The last step is solved to the tolerance only.
  int quadratic = 0;
  for (std::size_t k = 0; k + 1 < history.size(); ++k) {
    const double residual = history[k].residual;
    if (residual > 1e-2) continue;
    CHECK(history[k + 1].residual < 100 * residual * residual + smooth.smooth.tolerance);
    ++quadratic;
  }
  CHECK(quadratic >= 2);
}
