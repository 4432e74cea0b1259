// The cost of derivatives by the boundary, and of the steps of a session, beside linear solves.
//
//   bench/sensitivity_bench MESH --marker NAME [--threads N] [--steps K] [--periods P] [--tolerance
//   T]
//
// The marker oscillates: up and down by a tenth of its size, and it bends by as much. First at one
// mesh on the way: a tight linear solve (factors or hierarchy, and one right-hand side to 1e-12) as
// MeshSensitivity makes it, and products with the derivative and its transpose. Then P periods of K
// steps by a Deformer, with the tolerance T a step: CPU time and linear solves of a step, how far
// the mesh of a quarter of the period is from that of the first one, and the steps' slowest. At the
// end the mesh of that quarter, solved to 1e-10, beside the one of a new Deformer. All times are
// CPU times of all threads.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/command/local_command.h"
#include "core/error.h"
#include "core/formulation/variational_form.h"
#include "core/linear/linear_solver.h"
#include "core/motion/node_table.h"
#include "core/session/deformer.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;

struct Request {
  std::string mesh, marker;
  int threads = 1, steps = 20, periods = 2;
  double tolerance = 1e-4;  // of a step
};

Request read_request(const std::vector<std::string>& arguments) {
  Request out;
  const char* usage =
      "usage: sensitivity_bench MESH --marker NAME [--threads N] [--steps K] [--periods P] "
      "[--tolerance T]";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& key = arguments[i];
    if (!key.starts_with("--")) {
      out.mesh = key;
      continue;
    }
    if (++i == arguments.size()) throw UsageError(usage);
    const int number = std::atoi(arguments[i].c_str());
    if (key == "--marker")
      out.marker = arguments[i];
    else if (key == "--threads")
      out.threads = number;
    else if (key == "--steps")
      out.steps = number;
    else if (key == "--periods")
      out.periods = number;
    else if (key == "--tolerance")
      out.tolerance = std::atof(arguments[i].c_str());
    else
      throw UsageError(usage);
  }
  if (out.mesh.empty() || out.marker.empty()) throw UsageError(usage);
  return out;
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The body at one phase of its oscillation.
DeformCommand command_at(const Request& request, const Mesh& mesh, double phase) {
  const std::vector<Index> nodes = mesh.topology->markers().nodes_of(std::span(&request.marker, 1));
  Box<3> box = Box<3>::empty();
  for (const Index node : nodes) box.add(place_of(mesh.coordinates, node));
  const double size = box.size().norm() / std::sqrt(3.0);
  PositionTable table;
  for (const Index node : nodes) {
    const Vec3 p = place_of(mesh.coordinates, node);
    const double s = (p.x() - box.min.x()) / size;
    PositionEntry entry;
    entry.node = node;
    entry.position =
        GivenVector::of(mesh.coordinates.dimension(),
                        Vec3(p + 0.1 * size * std::sin(phase) * Vec3(0, 1 + std::sin(2 * s), 0)));
    table.entries.push_back(entry);
  }
  DeformCommand command;
  command.markers = {request.marker};
  command.shape = table;
  command.smooth.threads = request.threads;
  return command;
}

/// A linear solve with the Hessian at the mesh: factors or hierarchy, and one right-hand side.
double seconds_of_solve(const Request& request, const DeformCommand& command,
                        const MeshState& state, const Coordinates& moved) {
  const MotionEquations equations = equations_of(command, state, moved, {});
  LinearOptions options;
  options.tolerance = 1e-12;
  options.max_iterations = 1000;
  const auto solver = make_linear_solver(options, request.threads);
  SparseMatrix hessian;
  std::vector<double> residual(equations.form->unknowns()), out(residual.size());
  equations.form->linearise(equations.solution, Curvature::exact, hessian, residual);
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = std::sin(static_cast<double>(i));
  solver->set_matrix(hessian);  // orderings are made once
  const double begin = cpu_seconds();
  solver->set_matrix(hessian);
  solver->solve(residual, 1, out);
  return cpu_seconds() - begin;
}

void measure_products(const Request& request, const MeshState& state) {
  const DeformCommand command = command_at(request, state.mesh, 1);
  double begin = cpu_seconds();
  const Coordinates moved = execute(command, state).state.mesh.coordinates;
  std::printf("motion from the mesh as given           %8.3f s\n", cpu_seconds() - begin);
  begin = cpu_seconds();
  const MeshSensitivity sensitivity(state, command, moved);
  const double prepared = cpu_seconds() - begin;
  std::printf("solved to 1e-10 and prepared            %8.3f s (%s)\n", prepared,
              sensitivity.solver().c_str());
  Coordinates field(moved.dimension(), moved.size());
  for (std::size_t i = 0; i < field.values().size(); ++i)
    field.values()[i] = std::sin(static_cast<double>(i));
  // The first one makes whatever is made once.
  static_cast<void>(sensitivity.transpose(field));
  constexpr int products = 5;
  begin = cpu_seconds();
  for (int k = 0; k < products; ++k) static_cast<void>(sensitivity.transpose(field));
  const double transposed = (cpu_seconds() - begin) / products;
  begin = cpu_seconds();
  for (int k = 0; k < products; ++k) static_cast<void>(sensitivity.forward(field));
  const double forward = (cpu_seconds() - begin) / products;
  const double solve = seconds_of_solve(request, command, state, moved);
  std::printf("tight solve: factors and one right side %8.3f s\n", solve);
  std::printf("product, transposed                     %8.3f s, %.2f tight solves\n", transposed,
              transposed / solve);
  std::printf("product, forward                        %8.3f s, %.2f tight solves\n", forward,
              forward / solve);
}

double apart(const Coordinates& a, const Coordinates& b) {
  double off = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    off = std::max(off, std::abs(a.values()[i] - b.values()[i]));
  return off;
}

/// A step of a session, to the phase.
CommandResult step_to(const Request& request, Deformer& deformer, double phase, double tolerance) {
  DeformCommand command = command_at(request, deformer.given().mesh, phase);
  deformer.set_shape({request.marker}, std::move(command.shape));
  return deformer.step(tolerance);
}

void measure_session(const Request& request, const MeshState& state) {
  DeformerOptions options;
  options.smooth.threads = request.threads;
  Deformer deformer(state, options);
  Coordinates first;
  for (int period = 0; period < request.periods; ++period) {
    double seconds = 0, slowest = 0;
    int solves = 0;
    Index inverted = 0;
    Coordinates last;
    for (int step = 1; step <= request.steps; ++step) {
      const double begin = cpu_seconds();
      const CommandResult result =
          step_to(request, deformer, 2 * pi * step / request.steps, request.tolerance);
      const double took = cpu_seconds() - begin;
      seconds += took;
      slowest = std::max(slowest, took);
      solves += result.smooth.linear_solves;
      inverted += result.smooth.inverted;
      if (step == request.steps / 4) last = result.state.mesh.coordinates;
    }
    if (period == 0) first = last;
    std::printf(
        "period %d: %.3f s (at most %.3f) and %.2f linear solves a step, %d inverted, off by "
        "%.1e\n",
        period + 1, seconds / request.steps, slowest, static_cast<double>(solves) / request.steps,
        static_cast<int>(inverted), apart(first, last));
  }
  Deformer anew(state, options);
  std::printf("drift: %.1e\n",
              apart(step_to(request, deformer, 0.5 * pi, 1e-10).state.mesh.coordinates,
                    step_to(request, anew, 0.5 * pi, 1e-10).state.mesh.coordinates));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Request request = read_request({argv + 1, argv + argc});
    const MeshState state = make_state(io::read_mesh(request.mesh).mesh);
    std::printf("%s: %d nodes, %d elements, %d threads\n", request.mesh.c_str(),
                static_cast<int>(state.mesh.topology->node_count()),
                static_cast<int>(state.mesh.topology->element_count()), request.threads);
    measure_products(request, state);
    measure_session(request, state);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sensitivity_bench: %s\n", error.what());
    return 1;
  }
}
