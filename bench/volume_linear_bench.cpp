// Solvers of the linear systems of volume meshes, one after the other: winslow's multigrid and
// incomplete Cholesky and, if the build found hypre (Debian: libhypre-dev), its BoomerAMG, all as
// preconditioners of conjugate gradients, to the same relative residual, from zero, with one
// random right-hand side.
//
//   bench/volume_linear_bench MESH [--tolerance RELATIVE_RESIDUAL] [--threads N]
//
// Two matrices: the Hessian of the mesh energy with regular targets at the mesh as it is (the exact
// one where it is positive definite, else the projected one) and the stiffness of an elastic solid
// of modulus 1/volume. hypre is called with its library's one process; threads are its own affair.
// CPU is of all threads.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/linear/linear_solver.h"
#include "elasticity/linear_elasticity.h"
#include "io/format/mesh_file.h"
#ifdef WINSLOW_HAS_HYPRE
#include "hypre/boomer_amg.h"
#endif

namespace {

using namespace winslow;
using namespace winslow::bench;

struct Request {
  std::string mesh;
  double tolerance = 1e-8;
  int threads = 1;
};

struct Clocks {
  double cpu = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  std::chrono::steady_clock::time_point wall = std::chrono::steady_clock::now();

  double cpu_since() const { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC - cpu; }
  double wall_since() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  }
};

Request read_request(const std::vector<std::string>& arguments) {
  Request out;
  const char* usage = "usage: volume_linear_bench MESH [--tolerance R] [--threads N]";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool valued = arguments[i] == "--tolerance" || arguments[i] == "--threads";
    if (!valued) {
      out.mesh = arguments[i];
      continue;
    }
    if (i + 1 == arguments.size()) throw UsageError(usage);
    const double value = std::strtod(arguments[i + 1].c_str(), nullptr);
    if (!(value >= 0)) throw UsageError(usage);
    if (arguments[i++] == "--tolerance")
      out.tolerance = value;
    else
      out.threads = static_cast<int>(value);
  }
  if (out.mesh.empty()) throw UsageError(usage);
  return out;
}

void print(const char* system, const std::string& method, const Clocks& set_up, double set_up_cpu,
           double set_up_wall, const LinearResult& result) {
  const double cpu = set_up.cpu_since() - set_up_cpu, wall = set_up.wall_since() - set_up_wall;
  std::printf("%-12s %-42s %6d %9.1e %9.2f %8.2f %9.2f %8.2f\n", system, method.c_str(),
              result.iterations, result.relative_residual, set_up_cpu, set_up_wall, cpu, wall);
  std::fflush(stdout);
}

void solve_by_winslow(const char* system, const char* name, const SparseMatrix& matrix,
                      const std::vector<double>& rhs, const Request& request) {
  LinearOptions options;
  options.solver = name;
  options.tolerance = request.tolerance;
  options.max_iterations = 1000;
  const auto solver = make_linear_solver(options, request.threads);
  std::vector<double> x(rhs.size(), 0.0);
  const Clocks clocks;
  solver->set_matrix(matrix);
  const double cpu = clocks.cpu_since(), wall = clocks.wall_since();
  const LinearResult result = solver->solve(rhs, 1, x);
  print(system, "winslow: " + solver->description(), clocks, cpu, wall, result);
}

void compare_on(const char* system, const SparseMatrix& matrix, const Request& request) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> rhs(static_cast<std::size_t>(matrix.rows()));
  for (double& v : rhs) v = uniform(random);
  solve_by_winslow(system, "multigrid", matrix, rhs, request);
  solve_by_winslow(system, "cg", matrix, rhs, request);
#ifdef WINSLOW_HAS_HYPRE
  for (const BoomerKind kind : {BoomerKind::unknown_wise, BoomerKind::nodal}) {
    std::vector<double> x(rhs.size(), 0.0);
    const Clocks clocks;
    BoomerAmg solver(matrix, kind, request.tolerance);
    const double cpu = clocks.cpu_since(), wall = clocks.wall_since();
    const LinearResult result = solver.solve(rhs, x);
    print(system, solver.description(), clocks, cpu, wall, result);
  }
#endif
}

/// The Hessian of the energy of regular targets.
SparseMatrix hessian_of(const Mesh& mesh, int threads) {
  const auto targets =
      volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), &mesh.coordinates, threads);
  const VolumeWinslow energy(std::make_shared<const NodeClasses>(mesh.topology), targets,
                             PenaltyOptions(), threads);
  std::vector<double> residual(energy.unknowns());
  for (const Curvature curvature : {Curvature::exact, Curvature::projected}) {
    SparseMatrix matrix;
    energy.linearise(mesh.coordinates, curvature, matrix, residual);
    if (curvature == Curvature::projected) return matrix;
    try {
      std::vector<double> x(residual.size(), 0.0);
      const auto solver = make_linear_solver({.solver = "multigrid"}, threads);
      solver->set_matrix(matrix);
      solver->solve(residual, 1, x);
      return matrix;
    } catch (const NotPositiveDefinite&) {
      std::printf("the exact Hessian is not positive definite: the projected one is taken\n");
    }
  }
  return {};
}

void compare(const Request& request) {
  const Mesh mesh = io::read_mesh(request.mesh).mesh;
  if (mesh.topology->cell_dimension() != 3) throw UsageError(request.mesh + " is no volume mesh");
  std::printf("%d nodes, %d elements, relative residual %.0e\n", mesh.coordinates.size(),
              mesh.topology->element_count(), request.tolerance);
  std::printf("%-12s %-42s %6s %9s %9s %8s %9s %8s\n", "matrix", "conjugate gradients with", "iter",
              "residual", "setup CPU", "wall", "solve CPU", "wall");
  compare_on("energy", hessian_of(mesh, request.threads), request);
  ElasticityOptions elastic;
  elastic.modulus = Modulus::volume;
  ElasticSolid<3> solid(mesh.topology, {}, elastic);
  compare_on("elasticity", solid.stiffness(mesh.coordinates), request);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    compare(read_request({arguments + 1, arguments + count}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "volume_linear_bench: %s\n", error.what());
    return 1;
  }
}
