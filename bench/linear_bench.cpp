// Linear solvers on the elasticity of perturbed, triangulated squares, two unknowns a node, which
// is close to the Hessians of the mesh energies. "unknowns" and "iterations" are counters of each
// line.
#include <benchmark/benchmark.h>

#include <memory>

#include "core/linear/linear_solver.h"
#include "support/meshes.h"
#include "support/systems.h"

namespace {

using namespace winslow;

/// The matrix for a square of cells by cells, kept from benchmark to benchmark.
const SparseSystem& system_for(std::int64_t cells, bool symmetric) {
  static std::int64_t kept_cells = 0;
  static SparseSystem kept;
  if (kept_cells != cells) {
    Mesh mesh = make_mesh(test::square(static_cast<Index>(cells), test::Cells::triangles));
    test::Random random(1);
    const double reach = 0.2 / static_cast<double>(cells);
    for (const Index node : mesh.topology->interior_nodes()) {
      mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + random.vector(-reach, reach));
    }
    kept = test::elasticity(mesh);
    kept_cells = cells;
  }
  kept.matrix.symmetric = symmetric;
  return kept;
}

LinearOptions options_for(const char* name) {
  LinearOptions options;
  options.solver = name;
  options.max_iterations = 5000;
  return options;
}

void finish(benchmark::State& run, const SparseSystem& system, const LinearSolver& solver) {
  run.counters["unknowns"] = static_cast<double>(system.matrix.rows());
  run.SetLabel(solver.description());
}

/// Ordering, symbolic work and values: what a new mesh costs.
void first(benchmark::State& run, const char* name, bool symmetric) {
  const SparseSystem& system = system_for(run.range(0), symmetric);
  SparseMatrix matrix = system.matrix;
  const auto solver = make_linear_solver(options_for(name));
  for (auto _ : run) {
    run.PauseTiming();
    matrix.pattern = std::make_shared<SparsityPattern>(*system.matrix.pattern);
    run.ResumeTiming();
    solver->set_matrix(matrix);
  }
  finish(run, system, *solver);
}

/// Values alone: what every Newton step costs.
void again(benchmark::State& run, const char* name, bool symmetric) {
  const SparseSystem& system = system_for(run.range(0), symmetric);
  const auto solver = make_linear_solver(options_for(name));
  solver->set_matrix(system.matrix);
  for (auto _ : run) solver->set_matrix(system.matrix);
  finish(run, system, *solver);
}

/// One right-hand side, to the default tolerance.
void solve(benchmark::State& run, const char* name, bool symmetric) {
  const SparseSystem& system = system_for(run.range(0), symmetric);
  const auto solver = make_linear_solver(options_for(name));
  solver->set_matrix(system.matrix);
  std::vector<double> x(system.rhs.size());
  LinearResult result;
  for (auto _ : run) {
    std::fill(x.begin(), x.end(), 0.0);
    result = solver->solve(system.rhs, 1, x);
  }
  run.counters["iterations"] = result.iterations;
  finish(run, system, *solver);
}

void register_all(const char* name, bool symmetric, std::initializer_list<std::int64_t> sizes) {
  using Body = void (*)(benchmark::State&, const char*, bool);
  const std::pair<const char*, Body> parts[] = {
      {"first", first}, {"again", again}, {"solve", solve}};
  for (const std::int64_t cells : sizes) {
    for (const auto& [part, body] : parts) {
      const std::string title =
          std::string(name) + (symmetric ? "/symmetric/" : "/general/") + part;
      benchmark::RegisterBenchmark(title.c_str(), body, name, symmetric)
          ->Arg(cells)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->UseRealTime();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  register_all("direct", true, {70, 173, 346});
  register_all("multigrid", true, {70, 173, 346, 693, 1000});
  register_all("cg", true, {70, 173, 346});
  register_all("direct", false, {70, 173, 346});
  register_all("gmres", false, {70, 173});
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
