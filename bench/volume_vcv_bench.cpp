// Virtual control volumes of a volume mesh: microseconds for a star, at one and at two threads, by
// the fit of solid angles and by the paper's random perturbation, on cubes cut into tetrahedra.
#include <benchmark/benchmark.h>

#include "core/formulation/pointwise_winslow.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "support/space_meshes.h"

namespace {

using namespace winslow;

/// n by n by n cubes, each cut into tetrahedra or, mixed, into every kind of element; the interior
/// nodes moved by up to a quarter of a cube.
const Mesh& box(Index n, test::Volumes volumes) {
  static std::map<std::pair<Index, test::Volumes>, Mesh> made;
  const auto found = made.find({n, volumes});
  if (found != made.end()) return found->second;
  Mesh mesh = make_mesh(test::cube(n, volumes));
  test::Random random(1);
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec2 a = random.vector();
    const Vec3 move(a.x(), a.y(), random.uniform(-1, 1));
    mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + 0.25 / n * move);
  }
  return made.emplace(std::pair(n, volumes), std::move(mesh)).first->second;
}

/// range: cubes along a side, threads.
void build_vcvs(benchmark::State& run, VcvAngles angles, VcvConstruction construction) {
  const Mesh& mesh = box(static_cast<Index>(run.range(0)), test::Volumes::tetrahedra);
  VolumeVcvOptions options;
  options.angles = angles;
  options.construction = construction;
  options.threads = static_cast<int>(run.range(1));
  VolumeVcvStatistics statistics;
  for (auto _ : run) {
    const VolumeVcvs vcvs(mesh.topology, mesh.coordinates, options);
    run.PauseTiming();
    statistics = measure_vcvs(vcvs);
    run.ResumeTiming();
  }
  using benchmark::Counter;
  run.counters["stars"] = statistics.stars;
  run.counters["per_star"] =
      Counter(static_cast<double>(statistics.stars) * static_cast<double>(run.iterations()),
              Counter::kIsRate | Counter::kInvert);
  run.counters["mean_error"] = statistics.mean_error;
  run.counters["off"] = statistics.off;
}

void evaluate_residual(benchmark::State& run) {
  const Mesh& mesh = box(static_cast<Index>(run.range(0)), test::Volumes::tetrahedra);
  const VolumePointwise problem(VolumeVcvs(mesh.topology),
                                std::make_shared<NodeClasses>(mesh.topology),
                                static_cast<int>(run.range(1)));
  std::vector<double> residual(problem.unknowns());
  for (auto _ : run) benchmark::DoNotOptimize(problem.residual(mesh.coordinates, residual));
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(residual.size() / 3));
}

}  // namespace

BENCHMARK_CAPTURE(build_vcvs, equal, VcvAngles::equal, VcvConstruction::fit)
    ->ArgsProduct({{24}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(build_vcvs, existing, VcvAngles::existing, VcvConstruction::fit)
    ->ArgsProduct({{24}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(build_vcvs, adjusted, VcvAngles::adjusted, VcvConstruction::fit)
    ->ArgsProduct({{24}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(build_vcvs, perturbation, VcvAngles::equal, VcvConstruction::perturbation)
    ->ArgsProduct({{12}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(evaluate_residual)
    ->ArgsProduct({{24}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

BENCHMARK_MAIN();
