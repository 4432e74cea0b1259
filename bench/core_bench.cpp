// The parts of one outer iteration, on triangulated squares of growing size.
#include <benchmark/benchmark.h>

#include "core/command/command.h"
#include "core/formulation/pointwise_winslow.h"
#include "core/layers/layer_control.h"
#include "core/layers/layer_insertion.h"
#include "core/layers/layer_plan.h"
#include "core/linear/linear_solver.h"
#include "core/mesh/half_edge.h"
#include "core/quality/quality.h"
#include "core/vcv/stencil_functionals.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/random.h"

namespace {

using namespace winslow;

MeshState perturbed_square(std::int64_t cells) {
  Mesh mesh = make_mesh(test::square(static_cast<Index>(cells), test::Cells::triangles));
  test::Random random(1);
  const double reach = 0.2 / static_cast<double>(cells);  // of a cell of the unit square
  for (const Index node : mesh.topology->interior_nodes()) {
    mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + random.vector(-reach, reach));
  }
  return make_state(std::move(mesh));
}

void set_nodes(benchmark::State& run, const MeshState& state) {
  const auto nodes = state.mesh.topology->node_count();
  run.counters["nodes"] = static_cast<double>(nodes);
  run.SetItemsProcessed(run.iterations() * nodes);
}

/// Nodes and elements in the order of a structured grid, or in none: what lies in memory side by
/// side is then as far apart in the mesh as can be.
MeshData numbered(MeshData data, bool in_order) {
  if (in_order) return data;
  test::Random random(1);
  const std::vector<Index> node = random.permutation(data.node_count());
  MeshData shuffled;
  shuffled.coordinates = data.coordinates;
  for (Index i = 0; i < data.node_count(); ++i)
    shuffled.coordinates.set_xy(node[at(i)], data.coordinates.xy(i));
  for (const Index e : random.permutation(data.element_count())) {
    std::vector<Index> corners;
    for (const Index i : data.element(e)) corners.push_back(node[at(i)]);
    shuffled.add_element(data.types[at(e)], corners);
  }
  return shuffled;
}

/// From the arrays of a file: checks, orientation, edges, half-edges, stars, loops.
void build_mesh(benchmark::State& run, test::Cells cells, bool in_order) {
  const MeshData data = numbered(test::square(static_cast<Index>(run.range(0)), cells), in_order);
  for (auto _ : run) benchmark::DoNotOptimize(make_mesh(data));
  run.counters["nodes"] = static_cast<double>(data.node_count());
  run.SetItemsProcessed(run.iterations() * data.node_count());
}

/// What the first walk on a mesh pays.
void make_half_edges(benchmark::State& run) {
  const MeshData data = test::square(static_cast<Index>(run.range(0)), test::Cells::triangles);
  for (auto _ : run) {
    run.PauseTiming();
    const auto topology = Topology::build(data);
    run.ResumeTiming();
    benchmark::DoNotOptimize(topology->half_edges());
  }
  run.SetItemsProcessed(run.iterations() * data.node_count());
}

/// Thirty layers at the inner wall of an annulus of `rings` rings of 1000 nodes: planning, new
/// connectivity, and the VCVs that hold the heights.
void insert_thirty_layers(benchmark::State& run) {
  const Mesh mesh = make_mesh(
      test::annulus(1000, static_cast<Index>(run.range(0)), 1.006, test::Cells::triangles));
  LayerOptions options;
  options.walls.push_back({{"inner"}, {30, 1e-5, 1.2, 1.0, {}, false}});
  const VirtualControlVolumes none(mesh.topology);
  for (auto _ : run) {
    const LayerInsertion layers = insert_layers(mesh, plan_layers(mesh, options));
    benchmark::DoNotOptimize(
        layer_vcvs(layers.mesh.topology, layers.stack, none, layers.mesh.coordinates));
  }
  run.counters["nodes"] = static_cast<double>(mesh.topology->node_count());
  run.SetItemsProcessed(run.iterations() * mesh.topology->node_count());
}

void build_functionals(benchmark::State& run) {
  const MeshState state = perturbed_square(run.range(0));
  for (auto _ : run) benchmark::DoNotOptimize(StencilFunctionals(*state.vcvs.plane()));
  set_nodes(run, state);
}

void freeze(benchmark::State& run) {
  const MeshState state = perturbed_square(run.range(0));
  const auto formulation = std::make_unique<PointwiseWinslow>(
      test::pointwise(*state.vcvs.plane(), static_cast<int>(run.range(1))));
  SparseSystem system;
  for (auto _ : run) {
    benchmark::DoNotOptimize(formulation->clipped(true).freeze(state.mesh.coordinates, system));
  }
  set_nodes(run, state);
}

void residual(benchmark::State& run) {
  const MeshState state = perturbed_square(run.range(0));
  const auto formulation = std::make_unique<PointwiseWinslow>(
      test::pointwise(*state.vcvs.plane(), static_cast<int>(run.range(1))));
  for (auto _ : run) {
    benchmark::DoNotOptimize(formulation->clipped(true).residual(state.mesh.coordinates, {}));
  }
  set_nodes(run, state);
}

void validity(benchmark::State& run) {
  const MeshState state = perturbed_square(run.range(0));
  for (auto _ : run) {
    benchmark::DoNotOptimize(check_validity(*state.mesh.topology, state.mesh.coordinates,
                                            static_cast<int>(run.range(1))));
  }
  set_nodes(run, state);
}

void solve(benchmark::State& run, const char* name) {
  const MeshState state = perturbed_square(run.range(0));
  const auto formulation =
      std::make_unique<PointwiseWinslow>(test::pointwise(*state.vcvs.plane(), 0));
  SparseSystem system;
  formulation->clipped(true).freeze(state.mesh.coordinates, system);
  LinearOptions options;
  options.solver = name;
  const auto solver = make_linear_solver(options);
  std::vector<double> x(system.rhs.size(), 0.0);
  solver->set_matrix(system.matrix);  // the symbolic factorisation is not what is measured
  for (auto _ : run) {
    std::fill(x.begin(), x.end(), 0.0);
    solver->set_matrix(system.matrix);
    benchmark::DoNotOptimize(solver->solve(system.rhs, system.columns, x));
  }
  set_nodes(run, state);
}

BENCHMARK_CAPTURE(build_mesh, triangles, test::Cells::triangles, true)
    ->Arg(70)
    ->Arg(700)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_mesh, quads, test::Cells::quads, true)
    ->Arg(70)
    ->Arg(700)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(build_mesh, shuffled_triangles, test::Cells::triangles, false)
    ->Arg(700)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(make_half_edges)->Arg(70)->Arg(700)->Unit(benchmark::kMillisecond);
BENCHMARK(insert_thirty_layers)->Arg(25)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(build_functionals)->Arg(70)->Arg(300)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(freeze)->ArgsProduct({{70, 300}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(residual)->ArgsProduct({{70, 300}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(validity)->ArgsProduct({{70, 300}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(solve, direct, "direct")
    ->Arg(70)
    ->Arg(150)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(solve, gmres, "gmres")
    ->Arg(70)
    ->Arg(150)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(solve, point_implicit, "point-implicit")
    ->Arg(70)
    ->Arg(150)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
