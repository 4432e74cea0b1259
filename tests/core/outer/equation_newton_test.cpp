#include "core/outer/equation_newton.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/error.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/motion/motion.h"
#include "core/outer/path_follower.h"
#include "core/outer/picard_solver.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"
#include "core/strategy/workspace.h"
#include "support/coordinate.h"
#include "support/formulations.h"
#include "support/samples.h"

using namespace winslow;
using namespace winslow::test;

namespace {

SmoothOptions tight(Clip clip = Clip::automatic) {
  SmoothOptions options;
  options.tolerance = 1e-12;
  options.max_iterations = 1000;
  options.threads = 1;
  options.clip = clip;
  return options;
}

/// In the shape that a solver takes.
template <typename Solver>
auto variants(const PointwiseWinslow& formulation) {
  using Problem = std::conditional_t<std::is_same_v<Solver, EquationNewton>, EquationProblem,
                                     FixedPointProblem>;
  const auto [plain, clipped] = clip_variants(formulation);
  return ClipVariants<Problem>{plain, clipped};
}

/// A solver with everything it needs.
template <typename Solver>
class Smoother {
 public:
  Smoother(const Mesh& mesh, const SmoothOptions& options)
      : vcv_(mesh.topology),
        formulation_(pointwise(vcv_, options.threads)),
        linear_(make_linear_solver(options.linear, options.threads)),
        solver_(variants<Solver>(formulation_), *linear_, equation_options(options, 2)) {}

  /// Iterates to convergence, a stall or the limit.
  Coordinates run(Coordinates x, int limit) {
    history_ = {solver_.start(x)};
    while (!solver_.converged() && !solver_.stalled() && history_.back().iteration < limit) {
      history_.push_back(solver_.step(x));
    }
    return x;
  }

  Solver& solver() { return solver_; }
  bool converged() const { return solver_.converged(); }
  const std::vector<IterationRecord>& history() const { return history_; }
  const PointwiseWinslow& formulation() const { return formulation_; }

 private:
  VirtualControlVolumes vcv_;
  PointwiseWinslow formulation_;
  std::unique_ptr<LinearSolver> linear_;
  Solver solver_;
  std::vector<IterationRecord> history_;
};

using Newton = Smoother<EquationNewton>;
using Picard = Smoother<PicardSolver>;

Mesh graded_annulus(Index sectors, Cells cells) {
  return make_mesh(annulus(sectors, sectors / 3, 1 + 6.0 / sectors, cells));
}

/// Its rings turned, the inner one by 80 degrees, the outer one not at all: sheared far enough for
/// weights to turn negative. Quadrilaterals, which never have negative ones, by 20 degrees.
Mesh sheared_annulus(Index sectors, Cells cells) {
  const double turn = (cells == Cells::quads ? 20 : 80) * pi / 180;
  Mesh mesh = graded_annulus(sectors, cells);
  double outer = 0;
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    outer = std::max(outer, mesh.coordinates.xy(i).norm());
  }
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    const Vec2 p = mesh.coordinates.xy(i);
    const double angle = turn * std::log(outer / p.norm()) / std::log(outer);
    const double c = std::cos(angle), s = std::sin(angle);
    mesh.coordinates.set_xy(i, Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  }
  return mesh;
}

/// The mesh that Picard's iteration smooths to, its nodes then moved at random.
Mesh smoothed_then_perturbed(Mesh mesh, std::uint64_t seed) {
  Picard picard(mesh, tight());
  mesh.coordinates = picard.run(mesh.coordinates, 1000);
  REQUIRE(picard.converged());
  REQUIRE(picard.history().back().inverted == 0);
  Random random(seed);
  perturb(mesh, random);
  return mesh;
}

std::unique_ptr<Motion> rotation(const Mesh& mesh, const std::string& marker, double degrees,
                                 const Vec2& pivot) {
  RigidMotion rigid;
  rigid.rotate = degrees;
  rigid.pivot = pivot;
  const std::vector<std::string> markers{marker};
  return make_motion(*mesh.topology, mesh.coordinates, markers, rigid);
}

BoundaryMotion along(const Motion& motion, const Coordinates& rest) {
  return [&](double fraction, Coordinates& x) { motion.apply(rest, fraction, x); };
}

/// Finds every matrix singular.
class Refusing final : public LinearSolver {
 public:
  std::string_view name() const override { return "refusing"; }
  std::string description() const override { return "refusing"; }
  void set_matrix(const SparseMatrix&, bool) override { throw NumericError("singular"); }
  LinearResult solve(std::span<const double>, int, std::span<double>) override { return {}; }
  void set_tolerance(double) override {}
};

}  // namespace

TEST_CASE("Newton on the pointwise form converges quadratically from a perturbed mesh") {
  for (const Cells cells : all_cells) {
    for (const bool holes : {false, true}) {
      CAPTURE(name_of(cells));
      CAPTURE(holes);
      constexpr std::uint64_t seed = 201;
      CAPTURE(seed);
      const Mesh mesh = smoothed_then_perturbed(
          holes ? make_mesh(square_with_two_holes(20, cells)) : graded_annulus(36, cells), seed);
      Newton newton(mesh, tight());
      newton.run(mesh.coordinates, 50);
      REQUIRE(newton.converged());
      const auto& history = newton.history();
      CHECK(history.front().residual > 0.3);
      CHECK(history.back().iteration <= 8);
      CHECK(newton.solver().linear_solves() == history.back().iteration);
      for (std::size_t k = 1; k < history.size(); ++k) {
        const double before = history[k - 1].residual;
        // Below it round-off shows.
        if (before > 1e-2 || before < 1e-7) continue;
        CHECK(history[k].damping == 1);
        CHECK(history[k].residual < 50 * before * before + 1e-13);
      }
    }
  }
}

TEST_CASE("the number of Newton steps does not grow with the mesh") {
  for (const Index sectors : {24, 48, 96}) {
    CAPTURE(sectors);
    Mesh mesh = graded_annulus(sectors, Cells::triangles);
    Random random(211);
    perturb(mesh, random);
    Newton newton(mesh, tight());
    newton.run(mesh.coordinates, 50);
    CHECK(newton.converged());
    CHECK(newton.history().back().iteration <= 7);
  }
}

TEST_CASE("Newton and Picard on the pointwise form have the same fixed point") {
  for (const Cells cells : all_cells) {
    for (const Clip clip : {Clip::automatic, Clip::on, Clip::off}) {
      CAPTURE(name_of(cells));
      CAPTURE(static_cast<int>(clip));
      constexpr std::uint64_t seed = 221;
      CAPTURE(seed);
      const Mesh mesh = sheared_annulus(36, cells);
      REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
      Newton newton(mesh, tight(clip));
      Picard picard(mesh, tight(clip));
      const Coordinates x = newton.run(mesh.coordinates, 50);
      const Coordinates y = picard.run(mesh.coordinates, 1000);
      REQUIRE(newton.converged());
      REQUIRE(picard.converged());
      CHECK(newton.history().back().clipped == (clip == Clip::on));
      CHECK(largest_difference(x, y) < 1e-8);
      if (cells == Cells::quads) continue;
      // It tells the clipped equations from the unclipped ones.
      CHECK(newton.formulation().clipped(clip != Clip::on).residual(x, {}).max > 1e-3);
    }
  }
}

TEST_CASE("from distorted valid meshes no Newton step inverts an element") {
  // Six rounds leave elements of almost no area, from which there may be no way on.
  for (const int rounds : {2, 6}) {
    int damped = 0, converged = 0, runs = 0;
    for (const Cells cells : all_cells) {
      for (const std::uint64_t seed : {231u, 232u, 233u, 234u}) {
        CAPTURE(rounds);
        CAPTURE(name_of(cells));
        CAPTURE(seed);
        Mesh mesh = make_mesh(square_with_hole(20, cells));
        Random random(seed);
        for (int k = 0; k < rounds; ++k) perturb(mesh, random, rounds == 2 ? 0.7 : 1.5);
        REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
        Newton newton(mesh, tight());
        const Coordinates x = newton.run(mesh.coordinates, 60);
        CHECK(newton.converged() != newton.solver().stalled());
        CHECK(check_validity(*mesh.topology, x).inverted == 0);
        for (const IterationRecord& record : newton.history()) {
          CHECK(record.inverted == 0);
          damped += record.damping < 1 ? 1 : 0;
        }
        converged += newton.converged() ? 1 : 0;
        ++runs;
      }
    }
    if (rounds == 6) CHECK(damped > 0);
    CHECK(converged >= (rounds == 2 ? runs : runs / 2));
  }
}

TEST_CASE("a tangled mesh is refused without clipping and taken on with it") {
  constexpr std::uint64_t seed = 241;
  CAPTURE(seed);
  const Mesh straight = graded_annulus(24, Cells::triangles);
  Mesh mesh = straight;
  Random random(seed);
  tangle(mesh, random);
  Newton refused(mesh, tight(Clip::off));
  CHECK_THROWS_AS(refused.solver().start(mesh.coordinates), UsageError);
  Newton newton(mesh, tight());
  const Coordinates x = newton.run(mesh.coordinates, 200);
  REQUIRE(newton.converged());
  Newton direct(straight, tight());
  CHECK(largest_difference(x, direct.run(straight.coordinates, 50)) < 1e-8);
  bool valid = false;
  for (const IterationRecord& record : newton.history()) {
    CHECK(record.clipped == (record.inverted > 0));
    if (valid) CHECK(record.inverted == 0);
    valid = valid || record.inverted == 0;
  }
  CHECK(newton.history().front().inverted > 0);
}

TEST_CASE("the pointwise Newton is stalled where the solution is no valid mesh, and stays valid") {
  // Quadrilaterals in an annulus sheared by 60 degrees: Picard converges to a tangled mesh.
  Mesh mesh = make_mesh(annulus(48, 16, 1.125, Cells::quads));
  const auto motion = rotation(mesh, "inner", 60, {0, 0});
  Coordinates x = mesh.coordinates;
  Newton newton(mesh, tight());
  newton.solver().start(x);
  PathOptions uncorrected;  // with them the path ends where there still is a solution
  uncorrected.flattened = 0;
  uncorrected.tightened = 1;
  PathFollower follower(newton.solver(), uncorrected);
  const double reached =
      follower.follow(along(*motion, mesh.coordinates), 0, x, [&](auto&&, auto&& y) {
        CHECK(check_validity(*mesh.topology, y).inverted == 0);
        return true;
      });
  CHECK(reached > 0.5);
  CHECK(reached < 1);
  const Coordinates end = newton.run(x, 200);
  CHECK(!newton.converged());
  CHECK(newton.solver().stalled());
  CHECK(newton.history().back().largest_move == 0);
  CHECK(check_validity(*mesh.topology, end).inverted == 0);
  Picard picard(mesh, tight(Clip::off));
  motion->apply(mesh.coordinates, 1, mesh.coordinates);
  picard.run(mesh.coordinates, 1000);
  CHECK(picard.converged());
  CHECK(picard.history().back().inverted > 0);
}

TEST_CASE("a prediction is the derivative of the solution by the boundary") {
  for (const Clip clip : {Clip::off, Clip::on}) {
    CAPTURE(static_cast<int>(clip));
    // Without symmetries, so that no weight sits on the kink at zero.
    const Mesh mesh = sheared_annulus(36, Cells::triangles);
    Newton newton(mesh, tight(clip));
    const Coordinates steady = newton.run(mesh.coordinates, 50);
    REQUIRE(newton.converged());
    newton.solver().reject();
    constexpr double step = 1e-4;
    const std::vector<std::string> inner{"inner"};
    Coordinates displacement(2, steady.size());
    Coordinates ahead = steady, behind = steady;
    for (const Index node : mesh.topology->markers().nodes_of(inner)) {
      const Vec2 d = Vec2(0.5, 0.2) + Vec2(-steady.xy(node).y(), steady.xy(node).x());
      displacement.set_xy(node, d);
      ahead.set_xy(node, steady.xy(node) + step * d);
      behind.set_xy(node, steady.xy(node) - step * d);
    }
    const auto free = mesh.topology->interior_nodes();
    std::vector<double> answer(2 * free.size());
    newton.solver().predict(steady, displacement, answer);
    ahead = newton.run(ahead, 50);
    REQUIRE(newton.converged());
    behind = newton.run(behind, 50);
    REQUIRE(newton.converged());
    double worst = 0;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Vec2 slope = (ahead.xy(free[i]) - behind.xy(free[i])) / (2 * step);
      worst = std::max(worst, (slope - Vec2(answer[2 * i], answer[2 * i + 1])).norm());
    }
    CHECK(worst < 1e-5);
  }
}

TEST_CASE("path following on the pointwise form turns a body, through valid meshes, and back") {
  for (const Cells cells : {Cells::triangles, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const Mesh mesh = make_mesh(annulus(48, 16, 1.125, cells));
    Newton newton(mesh, tight());
    const Coordinates rest = newton.run(mesh.coordinates, 50);
    REQUIRE(newton.converged());
    Mesh at_rest = mesh;
    at_rest.coordinates = rest;
    Coordinates x = rest;
    PathFollower follower(newton.solver(), {});
    const auto there = rotation(at_rest, "inner", 90, {0, 0});
    int accepted = 0;
    const auto watch = [&](const IterationRecord& record, const Coordinates& y) {
      ++accepted;
      CHECK(record.inverted == 0);
      CHECK(check_validity(*mesh.topology, y).inverted == 0);
      return true;
    };
    const int before = newton.solver().linear_solves();
    newton.solver().start(x);
    CHECK(follower.follow(along(*there, rest), 0, x, watch) == 1);
    x = newton.run(x, 50);
    REQUIRE(newton.converged());
    CHECK(accepted >= 2);
    CHECK(newton.solver().linear_solves() - before <= 30);
    // Picard, which takes the motion at once, ends on the same mesh.
    Coordinates moved = rest;
    rotation(at_rest, "inner", 90, {0, 0})->apply(rest, 1, moved);
    Picard picard(mesh, tight(Clip::off));
    const Coordinates direct = picard.run(moved, 1000);
    REQUIRE(picard.converged());
    CHECK(largest_difference(x, direct) < 1e-8);

    Mesh turned = mesh;
    turned.coordinates = x;
    newton.solver().start(x);
    const auto back = rotation(turned, "inner", -90, {0, 0});
    CHECK(follower.follow(along(*back, turned.coordinates), 0, x, watch) == 1);
    x = newton.run(x, 50);
    REQUIRE(newton.converged());
    CHECK(largest_difference(x, rest) < 1e-8);
  }
}

TEST_CASE("the pointwise Newton gives bitwise the same coordinates at any number of threads") {
  constexpr std::uint64_t seed = 251;
  CAPTURE(seed);
  Mesh mesh = make_mesh(square(80, Cells::mixed));
  REQUIRE(mesh.topology->interior_nodes().size() > at(parallel_block));
  Random random(seed);
  for (const Index node : mesh.topology->interior_nodes()) {
    mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + 0.25 / 80 * random.vector());
  }
  Newton first(mesh, tight());
  const Coordinates x = first.run(mesh.coordinates, 50);
  CHECK(first.converged());
  for (const int threads : {2, 5}) {
    CAPTURE(threads);
    SmoothOptions options = tight();
    options.threads = threads;
    Newton other(mesh, options);
    CHECK(other.run(mesh.coordinates, 50) == x);
  }
}

TEST_CASE("the pointwise Newton: no free nodes, and coordinates that are no numbers") {
  MeshData data;
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}) data.coordinates.push_xy(p);
  add_triangle(data, 0, 1, 2);
  mark_boundary(data, [](const Vec2&) { return "rim"; });
  Mesh single = make_mesh(std::move(data));
  Newton none(single, tight());
  Coordinates x = single.coordinates;
  none.solver().start(x);
  CHECK(none.converged());
  CHECK(none.solver().step(x).iteration == 1);
  CHECK(x == single.coordinates);
  CHECK(none.solver().linear_solves() == 0);

  Mesh star = make_mesh(regular_star(6));
  coordinate(star.coordinates, 0, 0) = std::numeric_limits<double>::quiet_NaN();
  Newton broken(star, tight());
  CHECK_THROWS_AS(broken.solver().start(star.coordinates), NumericError);
}

TEST_CASE("the pointwise Newton where systems are singular: no step, no prediction") {
  const Mesh mesh = sheared_annulus(12, Cells::triangles);
  const VirtualControlVolumes vcv(mesh.topology);
  const PointwiseWinslow formulation = pointwise(vcv);
  Refusing linear;
  EquationNewton newton(variants<EquationNewton>(formulation), linear,
                        equation_options(tight(), 2));
  Coordinates x = mesh.coordinates;
  newton.start(x);
  newton.step(x);
  CHECK(newton.stalled());
  CHECK_FALSE(newton.converged());
  CHECK(x == mesh.coordinates);
  std::vector<double> answer(2 * mesh.topology->interior_nodes().size(), 1.0);
  newton.predict(x, Coordinates(2, x.size()), answer);
  CHECK(std::all_of(answer.begin(), answer.end(), [](double v) { return v == 0; }));
}
