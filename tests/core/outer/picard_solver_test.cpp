#include "core/outer/picard_solver.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/parallel/parallel_for.h"
#include "core/strategy/workspace.h"
#include "support/coordinate.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

namespace {

ClipVariants<FixedPointProblem> variants(const PointwiseWinslow& formulation) {
  const auto [plain, clipped] = clip_variants(formulation);
  return {plain, clipped};
}

/// A solver with everything it needs.
class Smoother {
 public:
  Smoother(const Mesh& mesh, const SmoothOptions& options)
      : mesh_(mesh),
        vcv_(mesh.topology),
        formulation_(pointwise(vcv_, options.threads)),
        linear_(make_linear_solver(options.linear)),
        solver_(variants(formulation_), *linear_, equation_options(options, 2)),
        options_(options) {}

  /// Iterates to convergence or to the limit.
  Coordinates run() {
    Coordinates x = mesh_.coordinates;
    history_ = {solver_.start(x)};
    while (!solver_.converged() && history_.back().iteration < options_.max_iterations) {
      history_.push_back(solver_.step(x));
    }
    return x;
  }

  PicardSolver& solver() { return solver_; }
  const PointwiseWinslow& formulation() const { return formulation_; }
  const std::vector<IterationRecord>& history() const { return history_; }
  bool converged() const { return solver_.converged(); }

 private:
  Mesh mesh_;
  VirtualControlVolumes vcv_;
  PointwiseWinslow formulation_;
  std::unique_ptr<LinearSolver> linear_;
  PicardSolver solver_;
  SmoothOptions options_;
  std::vector<IterationRecord> history_;
};

Mesh sample(Cells cells) { return make_mesh(annulus(24, 8, 1.25, cells)); }

Mesh with_moved_hole(double degrees) {
  Mesh mesh = make_mesh(square_with_hole(20, Cells::triangles));
  const std::vector<std::string> hole{"hole"};
  const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
  for (const Index node : mesh.topology->markers().nodes_of(hole)) {
    const Vec2 d = mesh.coordinates.xy(node) - Vec2(0.5, 0.5);
    mesh.coordinates.set_xy(node,
                            Vec2(0.55, 0.45) + Vec2(c * d.x() - s * d.y(), s * d.x() + c * d.y()));
  }
  return mesh;
}

/// One node that is asked to move along x by 0.1 - 0.01 x: the solution is at x = 10.
class CreepingProblem final : public NodeProblem<FixedPointProblem> {
 public:
  explicit CreepingProblem(const std::shared_ptr<const Topology>& topology)
      : NodeProblem(NodeUnknowns(free_interior(topology), 1)),
        pattern_(*topology, topology->interior_nodes()) {}
  static double step_at(double x) { return 0.1 - 0.01 * x; }

  std::string_view name() const override { return "creeping"; }
  ResidualNorms residual(const Coordinates& x, std::span<double>) const override {
    const double r = std::abs(step_at(x.xy(0).x()));
    return {r, r};
  }
  void boundary_response(const Coordinates&, const Coordinates&, std::span<double>) const override {
  }
  Index freeze(const Coordinates& x, SparseSystem& out) const override {
    out.matrix.pattern = pattern_.pattern;
    out.matrix.block = 1;
    out.matrix.symmetric = false;
    out.matrix.values.assign(1, 1.0);
    out.columns = 2;
    out.rhs.assign(2, 0.0);
    out.rhs[0] = step_at(x.xy(0).x());
    return 0;
  }

 private:
  NodePattern pattern_;
};

SmoothOptions tight() {
  SmoothOptions options;
  options.tolerance = 1e-12;
  options.max_iterations = 2000;
  options.threads = 1;
  return options;
}

}  // namespace

TEST_CASE("the three linear solvers give the same converged mesh") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Mesh mesh = sample(cells);
    constexpr std::uint64_t seed = 1;
    CAPTURE(seed);
    Random random(seed);
    perturb(mesh, random);
    Coordinates reference;
    for (const std::string& name : general_solver_names()) {
      CAPTURE(name);
      SmoothOptions options = tight();
      options.linear.solver = name;
      Smoother smoother(mesh, options);
      const Coordinates x = smoother.run();
      REQUIRE(smoother.converged());
      CHECK(smoother.history().back().inverted == 0);
      if (reference.empty()) reference = x;
      CHECK(largest_difference(x, reference) < 1e-8 * bounds(mesh).size().maxCoeff());
    }
  }
}

TEST_CASE("a scrambled interior comes back to the mesh that the original smooths to") {
  std::vector<Mesh> meshes{with_moved_hole(0), with_moved_hole(30)};
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    meshes.push_back(sample(cells));
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const std::uint64_t seed : {2u, 3u}) {
      CAPTURE(m);
      CAPTURE(seed);
      Smoother original(meshes[m], tight());
      const Coordinates expected = original.run();
      REQUIRE(original.converged());
      Mesh scrambled = meshes[m];
      Random random(seed);
      tangle(scrambled, random);
      REQUIRE(check_validity(*scrambled.topology, scrambled.coordinates).inverted > 0);
      Smoother again(scrambled, tight());
      const Coordinates x = again.run();
      REQUIRE(again.converged());
      CHECK(again.history().back().inverted == 0);
      CHECK(largest_difference(x, expected) < 1e-6 * bounds(meshes[m]).size().maxCoeff());
    }
  }
}

TEST_CASE("the plain iteration of the paper reaches the same fixed point") {
  Mesh mesh = with_moved_hole(20);
  Smoother accelerated(mesh, tight());
  const Coordinates expected = accelerated.run();
  REQUIRE(accelerated.converged());
  SmoothOptions options = tight();
  options.acceleration = 0;
  Smoother plain(mesh, options);
  const Coordinates x = plain.run();
  REQUIRE(plain.converged());
  CHECK(largest_difference(x, expected) < 1e-8);
  CHECK(accelerated.history().size() < plain.history().size());
}

TEST_CASE("on a valid mesh the automatic clip ends on the unclipped equations") {
  for (const double degrees : {0.0, 25.0}) {
    CAPTURE(degrees);
    const Mesh mesh = with_moved_hole(degrees);
    Smoother smoother(mesh, tight());
    const Coordinates x = smoother.run();
    REQUIRE(smoother.converged());
    CHECK(smoother.history().back().inverted == 0);
    CHECK_FALSE(smoother.history().back().clipped);
    CHECK(smoother.formulation().residual(x, {}).max < 1e-11);
  }
}

TEST_CASE("clip on and off are obeyed, automatic clips exactly while the mesh is tangled") {
  Mesh mesh = sample(Cells::triangles);
  constexpr std::uint64_t seed = 4;
  CAPTURE(seed);
  Random random(seed);
  tangle(mesh, random);
  for (const Clip clip : {Clip::on, Clip::off, Clip::automatic}) {
    SmoothOptions options = tight();
    options.clip = clip;
    options.max_iterations = 30;
    Smoother smoother(mesh, options);
    smoother.run();
    bool both = false;
    for (const IterationRecord& record : smoother.history()) {
      const bool expected = clip == Clip::on || (clip == Clip::automatic && record.inverted > 0);
      CHECK(record.clipped == expected);
      both = both || record.clipped != smoother.history().front().clipped;
    }
    CHECK(both == (clip == Clip::automatic));
  }
}

TEST_CASE("coordinates are bitwise the same at any number of threads") {
  Mesh mesh = make_mesh(square(110, Cells::triangles));
  REQUIRE(static_cast<Index>(mesh.topology->interior_nodes().size()) > 2 * parallel_block);
  constexpr std::uint64_t seed = 5;
  CAPTURE(seed);
  Random random(seed);
  tangle(mesh, random);
  Coordinates expected;
  std::vector<IterationRecord> history;
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    SmoothOptions options;
    options.threads = threads;
    options.max_iterations = 4;
    Smoother smoother(mesh, options);
    const Coordinates x = smoother.run();
    if (threads == 1) {
      expected = x;
      history = smoother.history();
    }
    CHECK(x == expected);
    REQUIRE(smoother.history().size() == history.size());
    for (std::size_t k = 0; k < history.size(); ++k) {
      CHECK(smoother.history()[k].residual == history[k].residual);
      CHECK(smoother.history()[k].min_sine == history[k].min_sine);
      CHECK(smoother.history()[k].inverted == history[k].inverted);
    }
  }
}

TEST_CASE("a record says what happened in its iteration") {
  Mesh mesh = with_moved_hole(10);
  Smoother smoother(mesh, tight());
  Coordinates x = mesh.coordinates;
  const IterationRecord zero = smoother.solver().start(x);
  CHECK(x == mesh.coordinates);
  CHECK(zero.iteration == 0);
  CHECK(zero.largest_move == 0);
  CHECK(zero.linear_iterations == 0);
  for (int k = 1; k <= 5; ++k) {
    const Coordinates before = x;
    const IterationRecord record = smoother.solver().step(x);
    CHECK(record.iteration == k);
    CHECK(record.largest_move == doctest::Approx(largest_difference(before, x)).epsilon(1e-9));
    const Validity validity = check_validity(*mesh.topology, x);
    CHECK(record.inverted == validity.inverted);
    CHECK(record.min_sine == validity.min_sine);
    CHECK(record.residual == smoother.formulation().clipped(record.clipped).residual(x, {}).max);
    CHECK(record.linear_iterations == 1);
    for (Index i = 0; i < x.size(); ++i) {
      if (mesh.topology->on_boundary(i)) CHECK(x.xy(i) == mesh.coordinates.xy(i));
    }
  }
}

TEST_CASE("without acceleration a step is the damped solution of the frozen system") {
  Mesh mesh = with_moved_hole(10);
  SmoothOptions options = tight();
  options.acceleration = 0;
  options.damping = 0.37;
  Smoother smoother(mesh, options);
  Coordinates x = mesh.coordinates;
  const IterationRecord start = smoother.solver().start(x);
  SparseSystem system;
  smoother.formulation().clipped(start.clipped).freeze(x, system);
  std::vector<double> delta(system.rhs.size(), 0.0);
  const auto linear = make_linear_solver({});
  linear->set_matrix(system.matrix);
  linear->solve(system.rhs, system.columns, delta);
  smoother.solver().step(x);
  const auto free = mesh.topology->interior_nodes();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec2 expected =
        mesh.coordinates.xy(free[i]) + 0.37 * Vec2(delta[2 * i], delta[2 * i + 1]);
    CHECK((x.xy(free[i]) - expected).norm() < 1e-14);
  }
}

TEST_CASE("an accelerated step never inverts a valid mesh: the plain one takes its place") {
  // The node creeps along the x axis by nearly equal steps, so that acceleration extrapolates to
  // x = 10: beyond a small star, within a large one.
  for (const bool small : {true, false}) {
    CAPTURE(small);
    Mesh mesh = make_mesh(regular_star(6));
    if (!small) {
      for (double& v : mesh.coordinates.values()) v *= 100;
    }
    const auto creeping = std::make_shared<const CreepingProblem>(mesh.topology);
    const auto linear = make_linear_solver({});
    SmoothOptions options = tight();
    options.damping = 0.5;
    PicardSolver solver({creeping, creeping}, *linear, equation_options(options, 2));
    Coordinates x = mesh.coordinates;
    solver.start(x);
    solver.step(x);
    CHECK(x.xy(0).x() == doctest::Approx(0.5 * 0.1));
    const double before = x.xy(0).x();
    const IterationRecord record = solver.step(x);
    CHECK(record.inverted == 0);
    const double plain = before + 0.5 * CreepingProblem::step_at(before);
    if (small) CHECK(x.xy(0).x() == doctest::Approx(plain));
    if (!small) CHECK(x.xy(0).x() == doctest::Approx(10));
    CHECK(record.largest_move == doctest::Approx(x.xy(0).x() - before));
  }
}

TEST_CASE("from a valid mesh the defaults stay valid all the way") {
  for (const std::uint64_t seed : {31u, 32u, 33u}) {
    CAPTURE(seed);
    Random random(seed);
    Mesh mesh = sample(Cells::mixed);
    perturb(mesh, random, 0.4);
    Smoother smoother(mesh, tight());
    smoother.run();
    CHECK(smoother.converged());
    for (const IterationRecord& record : smoother.history()) CHECK(record.inverted == 0);
  }
}

TEST_CASE("adaptive damping rescues an undamped iteration") {
  // Graded so strongly that the undamped iteration leaves even the valid mesh for good.
  const Mesh mesh = make_mesh(annulus(32, 10, 1.7, Cells::triangles));
  SmoothOptions options = tight();
  options.damping = 1;
  options.acceleration = 0;
  options.max_iterations = 600;
  options.adapt_damping = false;
  Smoother stubborn(mesh, options);
  stubborn.run();
  CHECK_FALSE(stubborn.converged());
  CHECK(stubborn.history().back().damping == 1);
  CHECK(stubborn.history().back().inverted > 0);
  options.adapt_damping = true;
  Smoother adaptive(mesh, options);
  const Coordinates x = adaptive.run();
  CHECK(adaptive.converged());
  CHECK(adaptive.history().back().damping < 1);
  CHECK(adaptive.history().back().inverted == 0);
  Smoother reference(mesh, tight());
  CHECK(largest_difference(x, reference.run()) < 1e-8 * bounds(mesh).size().maxCoeff());
}

TEST_CASE("a mesh without free nodes is converged from the start") {
  const Mesh mesh = make_mesh(square(1, Cells::triangles));
  REQUIRE(mesh.topology->interior_nodes().empty());
  Smoother smoother(mesh, tight());
  CHECK(smoother.run() == mesh.coordinates);
  CHECK(smoother.converged());
  CHECK(smoother.history().size() == 1);
  Coordinates x = mesh.coordinates;
  CHECK_NOTHROW(smoother.solver().step(x));
  CHECK(x == mesh.coordinates);
}

TEST_CASE("one free node") {
  for (const std::string& name : general_solver_names()) {
    CAPTURE(name);
    Mesh mesh = make_mesh(regular_star(6));
    mesh.coordinates.set_xy(0, {0.4, -0.3});
    SmoothOptions options = tight();
    options.linear.solver = name;
    Smoother smoother(mesh, options);
    const Coordinates x = smoother.run();
    CHECK(smoother.converged());
    CHECK(x.xy(0).norm() < 1e-11);
  }
}

TEST_CASE("a coordinate that is not a number is a NumericError, not a result") {
  const Mesh good = sample(Cells::triangles);
  Smoother smoother(good, tight());
  for (const Index node :
       {good.topology->interior_nodes().front(), good.topology->interior_nodes().back()}) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      Coordinates x = good.coordinates;
      coordinate(x, node, 1) = bad;
      CHECK_THROWS_AS(smoother.solver().start(x), NumericError);
      Coordinates later = good.coordinates;
      coordinate(later, good.topology->interior_nodes()[0], 0) += 0.01;
      smoother.solver().start(later);
      coordinate(later, node, 1) = bad;
      CHECK_THROWS_AS(smoother.solver().step(later), NumericError);
    }
  }
}

TEST_CASE("a solver can be started again: the second run is as the first") {
  Mesh mesh = with_moved_hole(30);
  constexpr std::uint64_t seed = 6;
  CAPTURE(seed);
  Random random(seed);
  tangle(mesh, random);
  Smoother smoother(mesh, tight());
  const Coordinates first = smoother.run();
  const std::size_t iterations = smoother.history().size();
  CHECK(smoother.run() == first);
  CHECK(smoother.history().size() == iterations);
}

TEST_CASE("everything in one point untangles") {
  Mesh mesh = sample(Cells::triangles);
  Smoother reference(mesh, tight());
  const Coordinates expected = reference.run();
  for (const Index node : mesh.topology->interior_nodes())
    mesh.coordinates.set_xy(node, {0.3, 0.1});
  Smoother smoother(mesh, tight());
  const Coordinates x = smoother.run();
  CHECK(smoother.converged());
  CHECK(largest_difference(x, expected) < 1e-6);
}
