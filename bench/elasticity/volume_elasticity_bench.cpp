// winslow with its default options against incremental linear elasticity (linear_elasticity.h) on a
// mesh of tetrahedra from a file, one body moved rigidly. Both methods have the same boundary; CPU,
// of all threads, is without reading and measuring. The linear systems of elasticity are solved by
// conjugate gradients with the multigrid that winslow has.
//
//   bench/volume_elasticity_bench MESH --marker NAME [--rotate DEG --axis X Y Z] [--pivot X Y Z]
//                                 [--translate X Y Z] [--increments N] [--modulus volume|distance]
//                                 [--tolerance RELATIVE_RESIDUAL]
//
// default: 50 increments, stiffness 1/volume, linear systems to 1e-6.
#include <cstdio>
#include <ctime>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "elasticity/elasticity_case.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;
using namespace winslow::bench;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void print(const char* method, const Mesh& mesh, const std::string& note, double cpu) {
  const QualityReport quality = measure_quality(mesh);
  std::printf("%-28s %9.4f %8.3f %10.2f %9d %9.2f  %s\n", method,
              quality.of(Metric::normalized_jacobian).statistics.min,
              quality.of(Metric::aspect_ratio).statistics.avg,
              quality.of(Metric::aspect_ratio).statistics.max, static_cast<int>(quality.inverted),
              cpu, note.c_str());
  std::fflush(stdout);
}

double by_winslow(const Mesh& mesh, const ElasticityCase& wanted) {
  MoveCommand move;
  move.bodies[0].markers = wanted.markers;
  move.bodies[0].motion = for_mesh(wanted, mesh);
  const MeshState state = make_state(mesh);
  const double begin = cpu_seconds();
  const CommandResult result = execute(move, state);
  const double cpu = cpu_seconds() - begin;
  const bool done = result.smooth.converged && result.smooth.fraction_reached == 1;
  print("winslow", result.state.mesh,
        std::to_string(result.smooth.linear_solves) + " linear solves" +
            (done ? "" : ", not to the end"),
        cpu);
  return cpu;
}

double by_elasticity(const Mesh& mesh, const ElasticityCase& wanted) {
  Mesh moved = mesh;
  const double begin = cpu_seconds();
  const ElasticityResult result = move_elastically(wanted, moved);
  const double cpu = cpu_seconds() - begin;
  char method[64];
  std::snprintf(method, sizeof method, "elasticity, %s, %d steps",
                wanted.elasticity.modulus == Modulus::volume ? "1/volume" : "1/distance",
                wanted.elasticity.increments);
  print(method, moved,
        std::to_string(result.linear_iterations) + " linear iterations" +
            (result.fault.empty() ? "" : ", ended early: " + result.fault),
        cpu);
  return cpu;
}

void compare(const ElasticityCase& wanted) {
  if (!wanted.output.empty()) throw UsageError("-o is an option of elastic_move");
  const Mesh mesh = io::read_mesh(wanted.mesh).mesh;
  std::printf("%-28s %9s %8s %10s %9s %9s\n", "method", "sJ min", "R/3r", "R/3r max", "inverted",
              "CPU s");
  print("as given", mesh, std::to_string(mesh.coordinates.size()) + " nodes", 0);
  const double ours = by_winslow(mesh, wanted);
  const double theirs = by_elasticity(mesh, wanted);
  std::printf("elasticity takes %.1f times the CPU\n", theirs / ours);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    compare(read_case({arguments + 1, arguments + count},
                      "usage: volume_elasticity_bench MESH --marker NAME ..."));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "volume_elasticity_bench: %s\n", error.what());
    return 1;
  }
}
