#include "core/outer/energy_newton.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/motion/motion.h"
#include "core/outer/energy_untangler.h"
#include "core/outer/newton_step.h"
#include "core/outer/path_follower.h"
#include "core/quality/quality.h"
#include "core/quality/validity.h"
#include "core/strategy/workspace.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A Newton solver with everything it needs.
struct Solver {
  explicit Solver(const Mesh& mesh, const std::string& linear_name = "direct",
                  const PenaltyOptions& penalty = {})
      : vcv(mesh.topology),
        energy(std::make_shared<const VariationalWinslow>(
            free_interior(mesh.topology), TargetShapes::build(vcv, TargetBlend::regular(), nullptr),
            penalty, 0)) {
    LinearOptions linear_options;
    linear_options.solver = linear_name;
    linear_options.tolerance = 1e-8;
    linear = make_linear_solver(linear_options);
    newton = std::make_unique<EnergyNewton>(energy, *linear, newton_options({}, 2));
  }

  std::vector<IterationRecord> run(Coordinates& x) const {
    std::vector<IterationRecord> history{newton->start(x)};
    while (!newton->converged() && !newton->stalled() && history.size() < 100) {
      history.push_back(newton->step(x));
      CHECK(history.back().inverted == 0);
    }
    return history;
  }

  VirtualControlVolumes vcv;
  std::shared_ptr<const VariationalWinslow> energy;
  std::unique_ptr<LinearSolver> linear;
  std::unique_ptr<EnergyNewton> newton;
};

constexpr double loose = 1e-3;  // tolerance of linear solves

std::shared_ptr<const VariationalWinslow> winslows_functional(const Mesh& mesh) {
  const VirtualControlVolumes vcv(mesh.topology);
  return std::make_shared<const VariationalWinslow>(
      free_interior(mesh.topology), TargetShapes::build(vcv, TargetBlend::regular(), nullptr),
      PenaltyOptions{1, 0}, 0);
}

BoundaryMotion along(const Motion& motion, const Coordinates& rest) {
  return [&](double fraction, Coordinates& x) { motion.apply(rest, fraction, x); };
}

}  // namespace

TEST_CASE("Newton's method ends quadratically and lowers the energy at every step") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Random random(1);
    Mesh mesh = make_mesh(annulus(32, 8, 1.2, cells));
    perturb(mesh, random, 0.2);
    const Solver solver(mesh);
    Coordinates x = mesh.coordinates;
    double energy = solver.energy->energy(x);
    solver.newton->start(x);
    std::vector<double> residuals;
    while (!solver.newton->converged() && residuals.size() < 40) {
      residuals.push_back(solver.newton->step(x).residual);
      const double next = solver.energy->energy(x);
      CHECK(next <= energy * (1 + 1e-12));
      energy = next;
    }
    CHECK(solver.newton->converged());
    CHECK(residuals.size() <= 20);
    // Once the residual is small, each one is about the square of the one before.
    bool seen = false;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
      if (residuals[i - 1] < 1e-2 && residuals[i - 1] > 1e-6) {
        CHECK(residuals[i] < 30 * residuals[i - 1] * residuals[i - 1]);
        seen = true;
      }
    }
    CHECK(seen);
  }
}

TEST_CASE("every linear solver leads to the same mesh") {
  Random random(3);
  Mesh mesh = make_mesh(square_with_hole(15, Cells::mixed));
  perturb(mesh, random, 0.2);
  Coordinates expected = mesh.coordinates;
  Solver(mesh).run(expected);
  for (const std::string& name : linear_solver_names()) {
    if (name == "point-implicit") continue;  // too slow an inner solver for Newton's method
    CAPTURE(name);
    const Solver solver(mesh, name);
    Coordinates x = mesh.coordinates;
    solver.run(x);
    CHECK(solver.newton->converged());
    CHECK(largest_difference(x, expected) < 1e-9);
  }
}

TEST_CASE("Newton's method refuses a tangled mesh") {
  Random random(3);
  Mesh mesh = make_mesh(square(8, Cells::triangles));
  tangle(mesh, random);
  const Solver solver(mesh);
  CHECK_THROWS_AS(solver.newton->start(mesh.coordinates), UsageError);
}

TEST_CASE("the predictor is the derivative of the solution with respect to the boundary") {
  Mesh mesh = make_mesh(annulus(24, 6, 1.25, Cells::triangles));
  const Topology& topology = *mesh.topology;
  const Solver solver(mesh);
  Coordinates x = mesh.coordinates;
  solver.run(x);
  solver.newton->step(x);  // the factorisation belongs to the solution
  Coordinates displacement(2, x.size());
  const Index marker = *topology.markers().find("inner");
  for (const Index node : topology.markers().nodes(marker)) displacement.set_xy(node, Vec2(1, 0.5));
  std::vector<double> predicted(2 * topology.interior_nodes().size());
  solver.newton->predict(x, displacement, predicted);

  constexpr double h = 1e-4;
  const auto solution = [&](double step) {
    Coordinates y = x;
    for (const Index node : topology.markers().nodes(marker)) {
      y.set_xy(node, y.xy(node) + step * displacement.xy(node));
    }
    solver.run(y);
    return y;
  };
  const Coordinates plus = solution(h), minus = solution(-h);
  const auto free = topology.interior_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 difference = (plus.xy(free[i]) - minus.xy(free[i])) / (2 * h);
    CHECK((difference - Vec2(predicted[2 * i], predicted[2 * i + 1])).norm() < 1e-5);
  }
}

TEST_CASE("a correcting prediction is a prediction and a Newton step in one") {
  Random random(5);
  Mesh mesh = make_mesh(annulus(24, 6, 1.25, Cells::triangles));
  const Topology& topology = *mesh.topology;
  const Solver solver(mesh);
  Coordinates steady = mesh.coordinates;
  solver.run(steady);
  constexpr double shaken = 1e-4;
  Coordinates x = steady;
  for (const Index node : topology.interior_nodes()) {
    x.set_xy(node, x.xy(node) + random.vector(-shaken, shaken));
  }
  std::vector<double> answer(2 * topology.interior_nodes().size());
  solver.newton->start(x);
  solver.newton->reject();
  solver.newton->predict_and_correct(x, Coordinates(2, x.size()), answer);
  double worst = 0;
  for (std::size_t i = 0; i < topology.interior_nodes().size(); ++i) {
    const Index node = topology.interior_nodes()[i];
    const Vec2 corrected = x.xy(node) + Vec2(answer[2 * i], answer[2 * i + 1]);
    worst = std::max(worst, (corrected - steady.xy(node)).norm());
  }
  CHECK(worst < 0.05 * shaken);
}

TEST_CASE("a path leads through valid meshes to the solution, however far the body turns") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    for (const double degrees : {90.0, -178.0, 225.0}) {
      if (degrees == 225 && cells != Cells::triangles) continue;  // such quads shear too far
      CAPTURE(name_of(cells));
      CAPTURE(degrees);
      const Mesh mesh = make_mesh(annulus(32, 26, 1.2, cells));
      const Solver solver(mesh);
      Coordinates x = mesh.coordinates;
      const auto motion =
          make_motion(*mesh.topology, x, {"inner"}, RigidMotion{degrees, Vec2(0, 0), Vec2(0, 0)});
      solver.run(x);
      double last = 0;
      const double reached =
          PathFollower(*solver.newton, {})
              .follow(along(*motion, mesh.coordinates), 0, x,
                      [&](const IterationRecord& record, const Coordinates& at) {
                        CHECK(record.fraction > last);
                        last = record.fraction;
                        CHECK(check_validity(*mesh.topology, at, 1).inverted == 0);
                        return true;
                      });
      CHECK(reached == 1);
      solver.run(x);
      CHECK(solver.newton->converged());
      Coordinates boundary = mesh.coordinates;
      motion->apply(mesh.coordinates, 1, boundary);
      for (const Index node : motion->nodes()) CHECK(x.xy(node) == boundary.xy(node));
    }
  }
}

TEST_CASE("a path that is blocked ends at the last valid mesh") {
  // The inner circle cannot leave the outer one.
  const Mesh mesh = make_mesh(annulus(24, 6, 1.2, Cells::triangles));
  const Solver solver(mesh);
  Coordinates x = mesh.coordinates;
  const auto motion =
      make_motion(*mesh.topology, x, {"inner"}, RigidMotion{0, Vec2(0, 0), Vec2(10, 0)});
  solver.run(x);
  const double reached =
      PathFollower(*solver.newton, {})
          .follow(along(*motion, mesh.coordinates), 0, x,
                  [](const IterationRecord&, const Coordinates&) { return true; });
  const double contact = (std::pow(1.2, 6) - 1) / 10;
  CHECK(reached < contact);
  CHECK(reached > 0.8 * contact);
  CHECK(check_validity(*mesh.topology, x, 1).inverted == 0);
}

TEST_CASE("short steps away from the path use up the patience of its follower") {
  const Mesh mesh = make_mesh(annulus(32, 12, 1.2, Cells::triangles));
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, {"inner"},
                                  RigidMotion{30, Vec2(0, 0), Vec2(0, 0)});
  const auto follow = [&](bool away, int patience, int& steps) {
    const Solver solver(mesh);
    Coordinates x = mesh.coordinates;
    solver.run(x);
    if (away) {
      const Coordinates solution = x;
      for (double by = 0.05; by == 0.05 || solver.newton->start(x).residual > 0.2; by /= 2) {
        Random random(7);
        x = solution;
        for (const Index node : mesh.topology->interior_nodes())
          x.set_xy(node, x.xy(node) + by * random.vector());
      }
      REQUIRE(solver.newton->start(x).residual > 0.02);
    }
    PathOptions options;
    options.first_step = 0.01;
    options.growth = 1;
    options.loose_tolerance = 0.5;
    options.flattened = 0;
    options.trusted_residual = 1;
    options.patience = patience;
    return PathFollower(*solver.newton, options)
        .follow(along(*motion, mesh.coordinates), 0, x,
                [&](const IterationRecord&, const Coordinates&) { return ++steps > 0; });
  };
  int steps = 0;
  CHECK(follow(true, 3, steps) == doctest::Approx(0.03));
  CHECK(steps == 3);
  steps = 0;
  CHECK(follow(true, 0, steps) == 1);  // never impatient
  CHECK(steps > 50);
  steps = 0;
  CHECK(follow(false, 3, steps) == 1);  // on the path
}

TEST_CASE("the regularised energy untangles a boundary that was turned at once") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const Mesh mesh = make_mesh(annulus(32, 10, 1.2, cells));
    const auto energy = winslows_functional(mesh);
    LinearOptions linear_options;
    linear_options.solver = "direct";
    const auto linear = make_linear_solver(linear_options);
    Coordinates x = mesh.coordinates;
    make_motion(*mesh.topology, x, {"inner"}, RigidMotion{100, Vec2(0, 0), Vec2(0, 0)})
        ->apply(mesh.coordinates, 1, x);
    EnergyUntangler untangler(energy, *linear, loose, &mesh.coordinates, Interior::as_given);
    CHECK(untangler.start(x).inverted > 0);
    for (int i = 0; i < 200 && !untangler.converged(); ++i) untangler.step(x);
    CHECK(untangler.converged());
    CHECK(check_validity(*mesh.topology, x, 1).inverted == 0);
  }
}

TEST_CASE("the regularised energy undoes a scramble, starting from a harmonic interior") {
  const auto meshes = [](Cells cells) {
    return std::vector<MeshData>{annulus(32, 26, 1.2, cells), square_with_two_holes(16, cells)};
  };
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    for (const MeshData& data : meshes(cells)) {
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        CAPTURE(name_of(cells));
        CAPTURE(data.node_count());
        CAPTURE(seed);
        Random random(seed);
        Mesh mesh = make_mesh(data);
        tangle(mesh, random);
        const auto energy = winslows_functional(mesh);
        const auto linear = make_linear_solver({});
        Coordinates x = mesh.coordinates;
        EnergyUntangler untangler(energy, *linear, loose, nullptr, Interior::harmonic);
        CHECK(untangler.start(x).inverted > 0);
        for (int i = 0; i < 60 && !untangler.converged(); ++i) untangler.step(x);
        CHECK(check_validity(*mesh.topology, x, 1).inverted == 0);
      }
    }
  }
}

TEST_CASE("the harmonic interior is the same whatever the interior was") {
  Mesh mesh = make_mesh(square_with_two_holes(16, Cells::triangles));
  const auto energy = winslows_functional(mesh);
  LinearOptions linear_options;
  linear_options.solver = "direct";
  const auto linear = make_linear_solver(linear_options);
  std::vector<Coordinates> interiors;
  for (const std::uint64_t seed : {1U, 2U}) {
    Random random(seed);
    tangle(mesh, random);
    Coordinates x = mesh.coordinates;
    EnergyUntangler untangler(energy, *linear, loose, nullptr, Interior::harmonic);
    untangler.start(x);
    CHECK(untangler.step(x).damping == 1);
    interiors.push_back(std::move(x));
  }
  CHECK(largest_difference(interiors[0], interiors[1]) < 1e-4);
}

TEST_CASE("a longer step ends at the minimum of a parabola") {
  // phi(t) = 3 (t - 1.5)^2 + 7: slope -9 at 0, phi(1) - phi(0) = 0.75 - 6.75.
  CHECK(longer_step(9, -6) == doctest::Approx(1.5));
  // phi(t) = t^2 - t: the minimum lies before 1.
  CHECK(longer_step(1, 0) == doctest::Approx(0.5));
}

TEST_CASE("where the function is concave or straight there is no longer step") {
  CHECK(longer_step(2, -2) == 1);
  CHECK(longer_step(2, -3) == 1);
}
