#include "core/linear/linear_solver.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/linear/solver_kinds.h"

namespace winslow {

namespace {

struct Entry {
  std::string_view name;
  std::string_view summary;
  bool needs_symmetry;
  std::unique_ptr<LinearSolver> (*make)(const LinearOptions&, int threads);
};

constexpr std::array<Entry, 6> solvers{{
    {"automatic", "The fastest for the size and the symmetry of the matrix.", false,
     make_automatic_solver},
    {"direct",
     "Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.", false,
     make_direct_solver},
    {"cg", "Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.",
     true, make_cg_solver},
    {"multigrid", "Conjugate gradients with multigrid: for large meshes; symmetric systems only.",
     true, make_multigrid_solver},
    {"gmres", "Restarted GMRES with incomplete LU: less memory than direct on large meshes.", false,
     make_gmres_solver},
    {"point-implicit", "Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.",
     false, make_point_implicit_solver},
}};

const Entry& find(std::string_view name) {
  for (const Entry& entry : solvers) {
    if (entry.name == name) return entry;
  }
  std::string known;
  for (const Entry& entry : solvers) known += (known.empty() ? "" : ", ") + std::string(entry.name);
  throw UsageError("unknown linear solver '" + std::string(name) + "', expected one of: " + known);
}

}  // namespace

void LinearResult::worsen(const LinearResult& other) {
  iterations = std::max(iterations, other.iterations);
  if (!(other.relative_residual <= relative_residual)) relative_residual = other.relative_residual;
}

std::vector<std::string> linear_solver_names() {
  std::vector<std::string> names;
  for (const Entry& entry : solvers) names.emplace_back(entry.name);
  return names;
}

std::string_view linear_solver_summary(std::string_view name) { return find(name).summary; }

bool linear_solver_needs_symmetry(std::string_view name) { return find(name).needs_symmetry; }

std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options, int threads) {
  return find(options.solver).make(options, threads);
}

}  // namespace winslow
