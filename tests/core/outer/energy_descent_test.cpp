#include "core/outer/energy_descent.h"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/command/command.h"
#include "core/error.h"
#include "core/formulation/gradient_parts.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/linear/multigrid.h"
#include "core/outer/energy_newton.h"
#include "core/quality/quality.h"
#include "core/strategy/workspace.h"
#include "support/formulations.h"
#include "support/random.h"
#include "support/space_meshes.h"
#include "support/systems.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Form = std::shared_ptr<const VolumeWinslow>;

Form form_of(const Mesh& mesh, const std::shared_ptr<const NodeClasses>& classes,
             const TargetBlend& blend = TargetBlend::regular(), int threads = 1) {
  const VolumeVcvs vcvs(mesh.topology);
  return std::make_shared<const VolumeWinslow>(
      classes, volume_targets(*mesh.topology, &vcvs, blend, &mesh.coordinates, 1), PenaltyOptions{},
      threads);
}
Form form_of(const Mesh& mesh, const TargetBlend& blend = TargetBlend::regular(), int threads = 1) {
  return form_of(mesh, free_interior(mesh.topology), blend, threads);
}

/// The interior of a cube is free, and the nodes inside its floor and its lid slide.
std::shared_ptr<const NodeClasses> sliding_floor(const Mesh& mesh) {
  auto classes = std::make_shared<NodeClasses>(mesh.topology);
  for (Index node = 0; node < mesh.topology->node_count(); ++node) {
    const Vec3 p = mesh.coordinates.xyz(node);
    const auto inside = [](double a) { return a > 1e-9 && a < 1 - 1e-9; };
    if (inside(p.x()) && inside(p.y()) && !inside(p.z())) classes->set_on_surface(node, {0, 0, 1});
  }
  return classes;
}

std::vector<IterationRecord> solve(OuterSolver& solver, Coordinates& x, int limit = 300) {
  std::vector<IterationRecord> history{solver.start(x)};
  while (!solver.converged() && !solver.stalled() && std::ssize(history) < limit)
    history.push_back(solver.step(x));
  return history;
}

Coordinates newtons_solution(const Form& form, Coordinates x) {
  const auto linear = make_linear_solver({});
  EnergyNewton newton(form, *linear, NewtonOptions{1e-11, 1e-3});
  solve(newton, x);
  REQUIRE(newton.converged());
  return x;
}

double largest_move(const Coordinates& a, const Coordinates& b) {
  double largest = 0;
  for (Index node = 0; node < a.size(); ++node)
    largest = std::max(largest, (a.xyz(node) - b.xyz(node)).norm());
  return largest;
}

/// The targets of one term a cell, of several, and with guards.
const std::vector<TargetBlend> blends{TargetBlend::regular(),
                                      TargetBlend::automatically(),
                                      TargetBlend::keeping(),
                                      {.element = 0.5, .vcv = 0.5}};

}  // namespace

TEST_CASE("the first-order form has the energy and the gradient of the problem") {
  for (const Volumes volumes : all_volumes) {
    const Mesh mesh = shaken_box(4, 0.1, 3, volumes);
    for (const auto& classes : {free_interior(mesh.topology), sliding_floor(mesh)}) {
      for (const TargetBlend& blend : blends) {
        CAPTURE(name_of(volumes));
        CAPTURE(blend.keep);
        CAPTURE(blend.vcv);
        const Form form = form_of(mesh, classes, blend);
        const auto first_order = form->first_order();
        REQUIRE(first_order);
        // Targets that keep shapes have their minimum at the mesh as given.
        const Coordinates x = shaken_box(4, 0.16, 9, volumes).coordinates;
        std::vector<double> gradient(3 * at(first_order->rows())), rates(form->unknowns()),
            residual(rates.size());
        const double energy = first_order->gradient(x, gradient);
        CHECK(energy == doctest::Approx(form->energy(x)).epsilon(1e-12));
        const ResidualNorms norms = form->residual(x, residual);
        first_order->rates(x, gradient, rates);
        double error = 0, size = 0;
        for (std::size_t i = 0; i < rates.size(); ++i) {
          error = std::max(error, std::abs(rates[i] + residual[i]));
          size = std::max(size, std::abs(residual[i]));
        }
        CHECK(error < 1e-12 * size);
        std::vector<double> scales(at(first_order->rows()));
        first_order->scales(x, scales);
        double largest = 0;
        for (std::size_t i = 0; i < scales.size(); ++i)
          largest = std::max(largest, Eigen::Map<Vec3>(&gradient[3 * i]).norm() / scales[i]);
        CHECK(largest == doctest::Approx(norms.max).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("an inverted element makes the energy of the first-order form infinite") {
  Mesh mesh = shaken_box(4, 0.1, 3);
  const auto first_order = form_of(mesh)->first_order();
  std::vector<double> gradient(3 * at(first_order->rows()));
  const Index node = mesh.topology->interior_nodes()[5];
  mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(0.4, 0, 0));
  CHECK(std::isinf(first_order->gradient(mesh.coordinates, gradient)));
  EnergyDescent descent(form_of(mesh), {.threads = 1});
  CHECK_THROWS_AS(descent.start(mesh.coordinates), UsageError);
}

TEST_CASE("the scalar operator is symmetric, positive definite and like the Hessian") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::mixed}) {
    const Mesh mesh = shaken_box(5, 0.1, 3, volumes);
    const Form form = form_of(mesh);
    SparseMatrix scalar, hessian;
    const auto first_order = form->first_order();
    first_order->laplacian(mesh.coordinates, scalar);
    const Dense k = dense_matrix(scalar);
    CHECK((k - k.transpose()).norm() < 1e-14 * k.norm());
    CHECK(Eigen::SelfAdjointEigenSolver<Dense>(k).eigenvalues()[0] > 0);
    std::vector<double> residual(form->unknowns());
    form->linearise(mesh.coordinates, Curvature::projected, hessian, residual);
    // A third of the trace of each block of the Hessian, which has more (all of psi'').
    const auto rows = first_order->rows();
    std::vector<double> places(3 * at(rows));
    first_order->positions(mesh.coordinates, places);
    std::vector<Index> row_at(at(rows));  // of the Hessian
    const auto nodes = mesh.topology->interior_nodes();
    for (std::size_t row = 0; row < nodes.size(); ++row)
      for (std::size_t p = 0; p < at(rows); ++p)
        if (Eigen::Map<Vec3>(&places[3 * p]) == mesh.coordinates.xyz(nodes[row]))
          row_at[p] = static_cast<Index>(row);
    const Dense h = dense_matrix(hessian);
    Dense thirds(rows, rows);
    for (Index i = 0; i < rows; ++i)
      for (Index j = 0; j < rows; ++j)
        thirds(i, j) = h.block<3, 3>(3 * row_at[at(i)], 3 * row_at[at(j)]).trace() / 3;
    const auto ratios = Eigen::GeneralizedSelfAdjointEigenSolver<Dense>(thirds, k).eigenvalues();
    CHECK(ratios[0] > 0.5);
    CHECK(ratios[ratios.size() - 1] < 2);
  }
}

TEST_CASE("a multigrid cycle for three components is that for each of them") {
  Random random(1);
  const SparseSystem system = springs(make_mesh(square_with_hole(45, Cells::triangles)), random, 1);
  const auto one = make_multigrid(1), three = make_multigrid_of_components(1);
  one->build(system.matrix);
  three->build(system.matrix);
  CHECK(three->description() == one->description());
  const auto rows = at(system.matrix.rows());
  std::vector<double> r(3 * rows), z(r.size()), of_one(rows), solved(rows);
  for (double& v : r) v = random.uniform(-1, 1);
  three->apply(r, z);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < rows; ++i) of_one[i] = r[3 * i + c];
    one->apply(of_one, solved);
    double error = 0, size = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      error = std::max(error, std::abs(solved[i] - z[3 * i + c]));
      size = std::max(size, std::abs(solved[i]));
    }
    CHECK(error < 1e-5 * size);
  }
  CHECK_THROWS_AS(make_multigrid_of_components(1)->build(
                      springs(make_mesh(square(20, Cells::triangles)), random, 2).matrix),
                  UsageError);
}

TEST_CASE("the memory of curvature is L-BFGS by its recursion") {
  Random random(5);
  constexpr std::size_t n = 30, depth = 4;
  // A quadratic energy with Hessian A, and M = its diagonal.
  Dense root(n, n);
  for (double& v : root.reshaped()) v = random.uniform(-1, 1);
  const Dense a = root * root.transpose() + Dense::Identity(n, n);
  const Eigen::VectorXd inverse = a.diagonal().cwiseInverse();
  const auto vector = [&] {
    Eigen::VectorXd v(n);
    for (double& x : v) x = random.uniform(-1, 1);
    return v;
  };
  const auto span = [](const Eigen::VectorXd& v) { return std::span<const double>(v.data(), n); };
  CurvatureMemory memory(depth, 1);
  std::vector<std::array<Eigen::VectorXd, 2>> pairs;  // s and y
  Eigen::VectorXd g = vector(), out(n);
  for (int step = 0; step < 9; ++step) {
    const Eigen::VectorXd mg = inverse.cwiseProduct(g);
    memory.direction(span(mg), std::span<double>(out.data(), n));
    Eigen::VectorXd q = g;
    std::vector<double> alpha(pairs.size());
    for (std::size_t i = pairs.size(); i-- > 0;) {
      const auto& [s, y] = pairs[i];
      alpha[i] = s.dot(q) / s.dot(y);
      q -= alpha[i] * y;
    }
    double gamma = 1;
    if (!pairs.empty()) {
      const auto& [s, y] = pairs.back();
      gamma = s.dot(y) / y.dot(inverse.cwiseProduct(y));
    }
    CHECK(memory.scale() == doctest::Approx(gamma).epsilon(1e-4));
    Eigen::VectorXd expected = gamma * inverse.cwiseProduct(q);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto& [s, y] = pairs[i];
      expected += (alpha[i] - y.dot(expected) / s.dot(y)) * s;
    }
    CHECK((out + expected).norm() < 1e-4 * expected.norm());
    const Eigen::VectorXd s = vector(), y = a * s, ahead = g + y;
    memory.add(span(s), span(g), span(mg), span(ahead), span(inverse.cwiseProduct(ahead)));
    pairs.push_back({s, y});
    if (pairs.size() > depth) pairs.erase(pairs.begin());
    CHECK(memory.size() == pairs.size());
    g = ahead;
    // A step along negative curvature is not kept.
    const Eigen::VectorXd back = g - s;
    memory.add(span(s), span(g), span(inverse.cwiseProduct(g)), span(back),
               span(inverse.cwiseProduct(back)));
    CHECK(memory.size() == pairs.size());
    g = back;
  }
}

TEST_CASE("first-order steps lower the energy through valid meshes to Newton's solution") {
  for (const Volumes volumes : all_volumes) {
    for (const bool slides : {false, true}) {
      CAPTURE(name_of(volumes));
      CAPTURE(slides);
      const Mesh mesh = shaken_box(6, 0.2, 11, volumes);
      const Form form = form_of(mesh, slides ? sliding_floor(mesh) : free_interior(mesh.topology));
      Coordinates x = mesh.coordinates;
      EnergyDescent descent(form, {.tolerance = 1e-9, .threads = 1});
      descent.start(x);
      double energy = form->energy(x);
      int steps = 0;
      for (; !descent.converged() && !descent.stalled() && steps < 200; ++steps) {
        const IterationRecord record = descent.step(x);
        const double next = form->energy(x);
        CHECK(next <= energy * (1 + 1e-11));
        energy = next;
        CHECK(record.inverted == 0);
        CHECK(record.damping > 0);
        CHECK(check_validity(*mesh.topology, x, 1).inverted == 0);
      }
      CHECK(descent.converged());
      CHECK(steps > 5);
      CHECK(form->residual(x, {}).max < 1.01e-9);
      CHECK(largest_move(x, newtons_solution(form, mesh.coordinates)) < 1e-7);
    }
  }
}

TEST_CASE("all targets have the same solution by first-order steps and by Newton's method") {
  const Mesh mesh = shaken_box(6, 0.1, 11);
  for (const TargetBlend& blend : blends) {
    CAPTURE(blend.keep);
    CAPTURE(blend.vcv);
    const Form form = form_of(mesh, blend);
    Coordinates x = shaken_box(6, 0.15, 12).coordinates;
    const Coordinates expected = newtons_solution(form, x);
    EnergyDescent descent(form, {.tolerance = 1e-9, .threads = 1});
    solve(descent, x);
    CHECK(descent.converged());
    CHECK(largest_move(x, expected) < 1e-7);
  }
}

TEST_CASE("first-order steps give the same bits at any number of threads") {
  // More rows than a part of the gradient, a run of the smoother and a block of a sum have.
  const Mesh mesh = shaken_box(19, 0.2, 11);
  REQUIRE(mesh.topology->interior_nodes().size() > 5000);
  std::vector<IterationRecord> expected;
  Coordinates mesh_of_one = mesh.coordinates;
  for (const int threads : {1, 2, 3}) {
    CAPTURE(threads);
    Coordinates x = mesh.coordinates;
    EnergyDescent descent(form_of(mesh, TargetBlend::regular(), threads), {.threads = threads});
    const auto history = solve(descent, x, 25);
    if (threads == 1) {
      expected = history;
      mesh_of_one = x;
    }
    REQUIRE(history.size() == expected.size());
    for (std::size_t i = 0; i < history.size(); ++i)
      CHECK(history[i].residual == expected[i].residual);
    CHECK(x == mesh_of_one);
  }
}

TEST_CASE("first-order steps that Newton's method would beat end early") {
  // Thin layers whose targets are regular elements are not what a scalar operator is like.
  const Mesh mesh = layered_cube(Volumes::tetrahedra, 1e-4, 2.8);
  const Form form = form_of(mesh, TargetBlend{.rest = 1});
  Mesh shaken = mesh;
  Random random(3);
  for (const Index node : mesh.topology->interior_nodes())
    shaken.coordinates.set_xyz(
        node, mesh.coordinates.xyz(node) +
                  Vec3(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), 0));
  REQUIRE(check_validity(*mesh.topology, shaken.coordinates, 1).inverted == 0);
  EnergyDescent descent(form, {.threads = 1});
  Coordinates x = shaken.coordinates;
  const auto history = solve(descent, x, 500);
  CHECK(descent.stalled());
  CHECK(!descent.converged());
  CHECK(history.size() < 120);
}

TEST_CASE("a run may be told to begin with first-order steps, and ends as Newton's method does") {
  const MeshState state = make_state(shaken_box(8, 0.25, 5));
  SmoothCommand command;
  command.smooth.threads = 1;
  command.smooth.targets = TargetBlend::regular();
  command.smooth.tolerance = 1e-10;
  const auto run = [&](OuterMethod outer) {
    command.smooth.outer = outer;
    return execute(command, state);
  };
  const auto stages = [](const SmoothResult& result) {
    std::vector<Stage> list;
    for (const IterationRecord& record : result.history)
      if (list.empty() || list.back() != record.stage) list.push_back(record.stage);
    return list;
  };
  const auto by_newton = run(OuterMethod::newton), by_descent = run(OuterMethod::descent);
  const auto by_default = run(OuterMethod::automatic);
  CHECK(by_descent.smooth.converged);
  CHECK(stages(by_descent.smooth) == std::vector{Stage::descent});
  CHECK(by_descent.smooth.linear_solves == 0);
  CHECK(by_descent.smooth.linear_solver.starts_with("L-BFGS"));
  CHECK(largest_move(by_descent.state.mesh.coordinates, by_newton.state.mesh.coordinates) < 1e-7);
  // A small mesh is not worth it.
  CHECK(stages(by_default.smooth) == stages(by_newton.smooth));
  CHECK(by_default.state.mesh.coordinates == by_newton.state.mesh.coordinates);
}

TEST_CASE("first-order steps refuse meshes that they have no form for") {
  SmoothCommand command;
  command.smooth.outer = OuterMethod::descent;
  CHECK_THROWS_AS(execute(command, make_state(make_mesh(square(8, Cells::triangles)))), UsageError);
  command.smooth.formulation = Formulation::pointwise;
  CHECK_THROWS_AS(execute(command, make_state(shaken_box(4, 0.1, 5))), UsageError);
}

TEST_CASE("first-order steps are reported one by one and can be cancelled") {
  class Limit final : public SolverMonitor {
   public:
    bool on_iteration(const IterationRecord& record, const Coordinates& x) override {
      CHECK(record.stage == Stage::descent);
      CHECK(record.iteration == seen++);
      last = x;
      return seen < 4;
    }
    int seen = 0;
    Coordinates last;
  } monitor;
  const MeshState state = make_state(shaken_box(6, 0.25, 5));
  SmoothCommand command;
  command.smooth.outer = OuterMethod::descent;
  RunOptions options;
  options.monitor = &monitor;
  CHECK_THROWS_AS(execute(command, state, options), Cancelled);
  CHECK(monitor.seen == 4);
  CHECK(check_validity(*state.mesh.topology, monitor.last, 1).inverted == 0);
}
