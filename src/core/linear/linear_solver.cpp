#include "core/linear/linear_solver.h"

#include <array>

#include "core/error.h"
#include "core/linear/direct_solver.h"
#include "core/linear/gmres_solver.h"
#include "core/linear/point_implicit_solver.h"

namespace winslow {

namespace {

struct Entry {
  std::string_view name;
  std::string_view summary;
  std::unique_ptr<LinearSolver> (*make)(const LinearOptions&);
};

constexpr std::array<Entry, 3> solvers{{
    {"direct", "Sparse LU, ordering reused: the fastest up to about 100,000 nodes in 2D.",
     [](const LinearOptions&) { return make_direct_solver(); }},
    {"gmres", "Restarted GMRES with incomplete LU: less memory than direct on large meshes.",
     make_gmres_solver},
    {"point-implicit", "Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.",
     make_point_implicit_solver},
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

std::vector<std::string> linear_solver_names() {
  std::vector<std::string> names;
  for (const Entry& entry : solvers) names.emplace_back(entry.name);
  return names;
}

std::string_view linear_solver_summary(std::string_view name) { return find(name).summary; }

std::unique_ptr<LinearSolver> make_linear_solver(const LinearOptions& options) {
  return find(options.solver).make(options);
}

}  // namespace winslow
