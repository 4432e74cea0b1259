// The variational solver as a whole: assembly against the machine's memory bandwidth, frames of a
// drag, Newton's method on growing meshes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/drag/drag_predictor.h"
#include "core/formulation/target_shapes.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"
#include "core/strategy/workspace.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

namespace {

using namespace winslow;

/// A square with a square hole, its nodes shaken.
MeshState perturbed(std::int64_t nodes) {
  // 5 by 5 fields of which the middle one is empty.
  const auto cells = static_cast<Index>(std::lround(std::sqrt(static_cast<double>(nodes) / 0.96)));
  Mesh mesh = make_mesh(test::square_with_hole(5 * (cells / 5), test::Cells::triangles));
  test::Random random(1);
  const double reach = 0.2 / static_cast<double>(cells);
  for (const Index node : mesh.topology->interior_nodes()) {
    mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + random.vector(-reach, reach));
  }
  return make_state(std::move(mesh));
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Energy, gradient and Hessian once, and a triad a = b + s c that moves as many bytes as the
/// assembly has to: coordinates, connectivity and targets in, gradient and Hessian out.
void assembly_against_triad(benchmark::State& run) {
  const MeshState state = perturbed(run.range(0));
  const int threads = static_cast<int>(run.range(1));
  SmoothOptions options;
  options.threads = threads;
  SmoothingWorkspace workspace;
  workspace.prepare(state, std::make_shared<NodeClasses>(state.mesh.topology), options);
  const auto form = std::dynamic_pointer_cast<const VariationalWinslow>(workspace.energy());
  const VariationalWinslow& energy = *form;
  SparseMatrix hessian;
  std::vector<double> residual(2 * state.mesh.topology->interior_nodes().size());
  const Coordinates& x = state.mesh.coordinates;
  energy.linearise(x, Curvature::exact, hessian, residual);
  const CellTargets<2>& shapes = energy.shapes();
  const std::size_t bytes =
      sizeof(double) * (x.values().size() + residual.size() + hessian.values.size()) +
      sizeof(shapes.cells[0]) * shapes.cells.size() + sizeof(shapes.terms[0]) * shapes.terms.size();
  const std::size_t n = bytes / (3 * sizeof(double));
  std::vector<double> a(n), b(n, 1.0), c(n, 2.0);
  std::vector<double> assembly, triad;
  for (auto _ : run) {
    assembly.push_back(seconds_of([&] {
      benchmark::DoNotOptimize(energy.linearise(x, Curvature::exact, hessian, residual));
    }));
    triad.push_back(seconds_of([&] {
      parallel_for(threads, static_cast<Index>(n), [&](Index begin, Index end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          a[i] = b[i] + 3.0 * c[i];
        }
      });
      benchmark::ClobberMemory();
    }));
  }
  run.counters["nodes"] = x.size();
  run.counters["assembly_ms"] = 1e3 * quantile(assembly, 0.5);
  run.counters["triad_ms"] = 1e3 * quantile(triad, 0.5);
  run.counters["ratio"] = quantile(assembly, 0.5) / quantile(triad, 0.5);
}

/// One frame under the mouse: combination of the tangent fields, boundary, exact validity.
/// motion: of the body named, as a function of the phase.
void time_frames(benchmark::State& run, MeshState state, const std::string& body,
                 const std::function<RigidMotion(double)>& motion) {
  state = execute(SmoothCommand{}, state).state;
  SmoothingWorkspace workspace;
  workspace.prepare(state, std::make_shared<NodeClasses>(state.mesh.topology), {});
  const Topology& topology = *state.mesh.topology;
  workspace.newton().start(state.mesh.coordinates);
  const DragPredictor predictor(workspace.newton(), state.mesh.coordinates,
                                topology.markers().nodes_of(std::vector<std::string>{body}));
  Coordinates frame;
  std::vector<double> times;
  int k = 0;
  for (auto _ : run) {
    const double phase = 0.1 * ++k;
    times.push_back(seconds_of([&] {
      predictor.evaluate(motion(phase), frame);
      benchmark::DoNotOptimize(check_validity(topology, frame));
    }));
  }
  run.counters["nodes"] = topology.node_count();
  run.counters["median_ms"] = 1e3 * quantile(times, 0.5);
  run.counters["p99_ms"] = 1e3 * quantile(times, 0.99);
}

void drag_frame(benchmark::State& run) {
  time_frames(run, perturbed(run.range(0)), "hole", [](double phase) {
    return RigidMotion{3 * std::sin(phase), Vec2(0.5, 0.5), Vec2(0.02 * std::cos(phase), 0)};
  });
}

/// A cube of so many cubes a side without the one in the middle, in tetrahedra.
void drag_frame_in_space(benchmark::State& run) {
  const auto side = static_cast<Index>(run.range(0));
  const double size = 0.1 / static_cast<double>(side);
  time_frames(run, make_state(test::box_with_body(side, test::Volumes::tetrahedra)), "body",
              [&](double phase) {
                return RigidMotion{3 * std::sin(phase), Vec3(0.5, 0.5, 0.5),
                                   size * Vec3(std::cos(phase), 0, std::sin(phase)), Vec3(1, 2, 3)};
              });
}

/// From a shaken, valid mesh to the solution.
void newton(benchmark::State& run) {
  const MeshState state = perturbed(run.range(0));
  SmoothResult result;
  for (auto _ : run) result = execute(SmoothCommand{}, state).smooth;
  run.counters["nodes"] = state.mesh.topology->node_count();
  run.counters["steps"] = result.outer_iterations;
  run.counters["solves"] = result.linear_solves;
  run.counters["residual"] = result.residual;
  run.SetLabel(result.linear_solver);
}

BENCHMARK(assembly_against_triad)
    ->ArgsProduct({{30'000, 480'000}, {1, 2}})
    ->Iterations(15)
    ->UseRealTime();
BENCHMARK(drag_frame)->Arg(15'000)->Arg(50'000)->Arg(100'000)->Iterations(500)->UseRealTime();
BENCHMARK(drag_frame_in_space)->Arg(19)->Arg(39)->Iterations(200)->UseRealTime();
BENCHMARK(newton)
    ->Arg(5'000)
    ->Arg(30'000)
    ->Arg(120'000)
    ->Arg(480'000)
    ->Arg(1'000'000)
    ->Iterations(1)
    ->UseRealTime()
    ->Unit(benchmark::kSecond);

}  // namespace

BENCHMARK_MAIN();
