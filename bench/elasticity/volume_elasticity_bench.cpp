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
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "elasticity/linear_elasticity.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;
using namespace winslow::bench;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Case {
  std::string mesh;
  std::string marker;
  RigidMotion motion{.pivot = Vec3(0, 0, 0), .axis = Vec3(0, 0, 1)};
  ElasticityOptions elasticity;
};

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') throw UsageError("found \"" + text + "\", expected a number");
  return value;
}

int whole_number(const std::string& text) {
  const double value = number(text);
  if (!(value >= 1 && value < 1e6 && value == std::floor(value)))
    throw UsageError("found \"" + text + "\", expected a whole number of at least 1");
  return static_cast<int>(value);
}

Modulus modulus_of(const std::string& name) {
  if (name == "volume") return Modulus::volume;
  if (name == "distance") return Modulus::wall_distance;
  throw UsageError("found \"" + name + "\", expected volume or distance");
}

Case read_case(const std::vector<std::string>& arguments) {
  Case out;
  out.elasticity.modulus = Modulus::volume;
  out.elasticity.increments = 50;
  std::size_t i = 0;
  const auto next = [&]() -> const std::string& {
    if (++i >= arguments.size()) throw UsageError(arguments.back() + " needs more");
    return arguments[i];
  };
  const auto vector = [&] {
    Vec3 v;
    for (double& component : v) component = number(next());
    return v;
  };
  for (; i < arguments.size(); ++i) {
    const std::string& flag = arguments[i];
    if (flag == "--marker") {
      out.marker = next();
    } else if (flag == "--rotate") {
      out.motion.rotate = number(next());
    } else if (flag == "--axis") {
      out.motion.axis = vector();
    } else if (flag == "--pivot") {
      out.motion.pivot = vector();
    } else if (flag == "--translate") {
      out.motion.translate = vector();
    } else if (flag == "--increments") {
      out.elasticity.increments = whole_number(next());
    } else if (flag == "--modulus") {
      out.elasticity.modulus = modulus_of(next());
    } else if (flag == "--tolerance") {
      out.elasticity.tolerance = number(next());
    } else {
      out.mesh = flag;
    }
  }
  if (out.mesh.empty() || out.marker.empty())
    throw UsageError("usage: volume_elasticity_bench MESH --marker NAME ...");
  return out;
}

void print(const char* method, const Mesh& mesh, const std::string& note, double cpu) {
  const QualityReport quality = measure_quality(mesh);
  std::printf("%-28s %9.4f %8.3f %10.2f %9d %9.2f  %s\n", method,
              quality.of(Metric::normalized_jacobian).statistics.min,
              quality.of(Metric::aspect_ratio).statistics.avg,
              quality.of(Metric::aspect_ratio).statistics.max, static_cast<int>(quality.inverted),
              cpu, note.c_str());
  std::fflush(stdout);
}

double by_winslow(const Mesh& mesh, const Case& wanted) {
  MoveCommand move;
  move.bodies[0].markers = {wanted.marker};
  move.bodies[0].motion = wanted.motion;
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

double by_elasticity(const Mesh& mesh, const Case& wanted) {
  const std::vector<std::string> markers{wanted.marker};
  const auto motion = make_motion(*mesh.topology, mesh.coordinates, markers, wanted.motion);
  Mesh moved = mesh;
  std::string note;
  const double begin = cpu_seconds();
  ElasticSolid<3> solid(mesh.topology, mesh.topology->markers().nodes_of(markers),
                        wanted.elasticity);
  try {
    deform_in_increments(
        solid, [&](double share, Coordinates& x) { motion->apply(mesh.coordinates, share, x); },
        wanted.elasticity.increments, moved.coordinates);
  } catch (const Error& error) {
    note = std::string(", ended early: ") + error.what();
  }
  const double cpu = cpu_seconds() - begin;
  char method[64];
  std::snprintf(method, sizeof method, "elasticity, %s, %d steps",
                wanted.elasticity.modulus == Modulus::volume ? "1/volume" : "1/distance",
                wanted.elasticity.increments);
  print(method, moved, std::to_string(solid.linear_iterations()) + " linear iterations" + note,
        cpu);
  return cpu;
}

void compare(const Case& wanted) {
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
    compare(read_case({arguments + 1, arguments + count}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "volume_elasticity_bench: %s\n", error.what());
    return 1;
  }
}
