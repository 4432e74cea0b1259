// The innermost loops of a run on a volume mesh, one line for each, beside what the machine can do:
// its triad (a = b + s c over arrays larger than the caches) and its peak of additions and
// multiplications in registers, both measured first.
//
//   bench/volume_kernels_bench MESH [--threads N] [--repeat K]
//
// A line has the least time of K tries, the bytes that the kernel moves and the operations
// that it does for each second of it, and both as shares of triad and peak. Times are CPU times of
// all threads, divided by their number: what a machine takes that does nothing else. Bytes are
// counted from the data structures, each array once for each sweep; operations in the sources. Data
// that a cache holds from one sweep to the next makes a share of the triad larger than one. Where
// both shares are small, neither memory nor arithmetic limits the loop, but chains of operations
// that wait for each other.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/linear/multigrid.h"
#include "core/linear/vector_operations.h"
#include "core/outer/energy_descent.h"
#include "core/parallel/parallel_for.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;

struct Request {
  std::string mesh;
  int threads = 1, repeat = 5;
};

Request read_request(const std::vector<std::string>& arguments) {
  Request out;
  const char* usage = "usage: volume_kernels_bench MESH [--threads N] [--repeat K]";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& key = arguments[i];
    if (key != "--threads" && key != "--repeat") {
      out.mesh = key;
      continue;
    }
    if (++i == arguments.size()) throw UsageError(usage);
    (key == "--threads" ? out.threads : out.repeat) = std::atoi(arguments[i].c_str());
  }
  if (out.mesh.empty() || out.threads < 0 || out.repeat < 1) throw UsageError(usage);
  return out;
}

/// The least CPU time of several calls, in seconds, divided by the number of threads.
double least_time(const Request& request, const std::function<void()>& part) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < request.repeat; ++i) {
    const std::clock_t begin = std::clock();
    part();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return std::max(least, 1.0 / CLOCKS_PER_SEC) / thread_count(request.threads);
}

/// What the machine can do with some threads, for each second.
struct Machine {
  double triad_bytes, peak_flops;
};

double measure_triad(const Request& request) {
  constexpr Index size = 1 << 24;  // 128 MB an array
  std::vector<double> a(at(size), 0.0), b(a.size(), 1.0), c(a.size(), 2.0);
  const double time = least_time(request, [&] {
    parallel_for(request.threads, size, [&](Index begin, Index end) {
      for (auto i = at(begin); i < at(end); ++i) a[i] = b[i] + 3.0 * c[i];
    });
  });
  if (a[1] != 7) throw NumericError("the triad is wrong");
  return 3.0 * sizeof(double) * size / time;
}

typedef double TwoDoubles __attribute__((vector_size(16)));
typedef double FourDoubles __attribute__((vector_size(32)));

constexpr int chains = 6;  // of each kind; all of them and two constants are in 16 registers

/// Chains of operations in registers, half of them multiplications, half additions. None waits for
/// another, and there are enough for two units of each kind that take three cycles. Returns
/// the sum of all numbers.
template <typename Pack>
[[gnu::always_inline]] inline double run_chains(Index rounds) {
  Pack products[chains], sums[chains];
  for (int k = 0; k < chains; ++k) {
    products[k] = Pack{} + (1.0 + k);
    sums[k] = products[k];
  }
  const Pack factor = Pack{} + 0.9999999, step = Pack{} + 1e-6;
  for (Index i = 0; i < rounds; ++i) {
    for (int k = 0; k < chains; ++k) {
      products[k] *= factor;
      sums[k] += step;
    }
  }
  Pack total{};
  for (int k = 0; k < chains; ++k) total += products[k] + sums[k];
  double sum = 0;
  for (std::size_t k = 0; k < sizeof total / sizeof sum; ++k) sum += total[k];
  return sum;
}

// The kernels have AVX2 versions for processors that run them.
#if defined(__x86_64__)
[[gnu::target("avx2")]] double wide_chains(Index rounds) { return run_chains<FourDoubles>(rounds); }
bool is_wide() { return __builtin_cpu_supports("avx2") != 0; }
#else
double wide_chains(Index rounds) { return run_chains<TwoDoubles>(rounds); }
bool is_wide() { return false; }
#endif
double plain_chains(Index rounds) { return run_chains<TwoDoubles>(rounds); }

/// Without fused operations, which the kernels do not use.
double measure_peak(const Request& request) {
  constexpr Index rounds = 1 << 22;
  const auto run = is_wide() ? wide_chains : plain_chains;
  const double flops_of_a_round = 2.0 * chains * (is_wide() ? 4 : 2);
  const Index workers = thread_count(request.threads);
  std::vector<double> results(at(workers));
  const double time = least_time(request, [&] {
    parallel_for(
        request.threads, workers, [&](Index begin, Index) { results[at(begin)] = run(rounds); }, 1);
  });
  for (const double v : results)
    if (!std::isfinite(v)) throw NumericError("the loop of the peak is wrong");
  return flops_of_a_round * rounds * workers / time;
}

class Table {
 public:
  Table(const Request& request)
      : request_(request), machine_{measure_triad(request), measure_peak(request)} {
    std::printf("triad %.1f GB/s, peak %.1f Gflop/s without fused operations, %d threads\n",
                1e-9 * machine_.triad_bytes, 1e-9 * machine_.peak_flops,
                thread_count(request.threads));
    std::printf("%-34s %10s %8s %8s %9s %8s\n", "", "ms", "GB/s", "of triad", "Gflop/s", "of peak");
  }

  void line(const std::string& name, const Work& work, const std::function<void()>& part) const {
    const double time = least_time(request_, part);
    std::printf("%-34s %10.2f %8.1f %7.0f%% %9.2f %7.1f%%\n", name.c_str(), 1e3 * time,
                1e-9 * work.bytes / time, 100 * work.bytes / time / machine_.triad_bytes,
                1e-9 * work.flops / time, 100 * work.flops / time / machine_.peak_flops);
    std::fflush(stdout);
  }

 private:
  Request request_;
  Machine machine_;
};

std::vector<double> random_vector(std::size_t size) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> out(size);
  for (double& v : out) v = uniform(random);
  return out;
}

/// Bytes and operations of loops over vectors of doubles.
Work of_vectors(double size, double read_and_written, double flops) {
  return {size * read_and_written * sizeof(double), size * flops};
}

double count(const std::vector<Index>& list) { return static_cast<double>(list.size()); }

// Operations for each tetrahedron with one target and an integer exponent of 8, counted in
// tetrahedron_kernel.inc and tetrahedron_gradient.inc; roots and quotients count as one.
constexpr double corner_flops = 51, root_flops = 30, pull_flops = 138, scale_flops = 400,
                 scalar_flops = 330, hessian_flops = 950;

/// Of all cells: their targets, places and corners, and once the positions of the nodes.
double bytes_of_cells(const VolumeWinslow& form, const Mesh& mesh) {
  const auto& shapes = form.shapes();
  return static_cast<double>(shapes.terms.size() * sizeof(VolumeTerm) +
                             shapes.cells.size() * (4 + 1) * sizeof(Index)) +
         3.0 * sizeof(double) * mesh.coordinates.size();
}

void time_loops_over_cells(const Table& table, const Mesh& mesh, const VolumeWinslow& form,
                           const FirstOrderForm& first_order) {
  const double cells = static_cast<double>(form.shapes().cells.size()), rows = first_order.rows();
  const double input = bytes_of_cells(form, mesh);
  const Coordinates& x = mesh.coordinates;
  std::vector<double> gradient(3 * at(first_order.rows())), scales(at(first_order.rows()));
  table.line("energy and gradient",
             {input + 3 * rows * sizeof(double), cells * (corner_flops + root_flops + pull_flops)},
             [&] { first_order.gradient(x, gradient); });
  table.line("scales of the residual", {input + 3 * rows * sizeof(double), cells * scale_flops},
             [&] { first_order.scales(x, scales); });
  SparseMatrix laplacian, hessian;
  first_order.laplacian(x, laplacian);
  table.line("scalar operator",
             {input + count(laplacian.pattern->columns) * (sizeof(double) + sizeof(Index)),
              cells * scalar_flops},
             [&] { first_order.laplacian(x, laplacian); });
  std::vector<double> residual(form.unknowns());
  form.linearise(x, Curvature::exact, hessian, residual);
  table.line("exact Hessian",
             {input + count(hessian.pattern->columns) * 9 * sizeof(double), cells * hessian_flops},
             [&] { form.linearise(x, Curvature::exact, hessian, residual); });
}

void time_multigrid(const Table& table, const std::string& name, Preconditioner& multigrid,
                    const SparseMatrix& matrix, std::size_t numbers) {
  const auto r = random_vector(numbers);
  std::vector<double> z(numbers);
  multigrid.build(matrix);
  multigrid.apply(r, z);
  table.line(name + " W-cycle", multigrid.work(), [&] { multigrid.apply(r, z); });
  const double entries = count(matrix.pattern->columns);
  table.line(name + " hierarchy, values only",
             {entries * matrix.block * matrix.block * (sizeof(double) + sizeof(Real)), 0},
             [&] { multigrid.build(matrix); });
}

void time_conjugate_gradients(const Table& table, const SparseMatrix& hessian, int threads) {
  const auto size = static_cast<std::size_t>(hessian.rows());
  const double n = static_cast<double>(size), entries = count(hessian.pattern->columns);
  const auto p = random_vector(size);
  std::vector<double> q(size), x(size), r(p), z(p);
  table.line("product with the Hessian",
             {entries * (9 * sizeof(double) + sizeof(Index)) + 2 * n * sizeof(double),
              entries * 18 + 2 * n},
             [&] { multiply(hessian, p, q, threads); });
  table.line("vectors of conjugate gradients", of_vectors(n, 6 + 2 + 3, 6 + 2 + 2), [&] {
    advance(1e-3, p, q, x, r, threads);
    z[0] = dot(r, z, threads);
    scale_and_add(0.5, r, z, threads);
  });
}

void time_curvature_memory(const Table& table, std::size_t size, int threads) {
  constexpr std::size_t depth = 8;
  CurvatureMemory memory(depth, threads);
  const auto s = random_vector(size);
  std::vector<double> zero(size, 0.0), out(size);
  for (std::size_t i = 0; i <= depth; ++i) memory.add(s, zero, zero, s, s);
  // Adding reads s, z and four gradients, writes a pair in single precision, and takes its products
  // and those of the others with the gradient; the direction reads all pairs.
  const double n = static_cast<double>(size), pairs = 2.0 * depth;
  const double floats = n * sizeof(float);
  table.line("vectors of L-BFGS",
             {(5 + 1) * n * sizeof(double) + (2 + pairs) * floats + pairs * floats +
                  2 * n * sizeof(double),
              2 * n * (pairs + 4) + 2 * n * pairs},
             [&] {
               memory.add(s, zero, zero, s, s);
               memory.direction(s, out);
             });
}

void time_kernels(const Request& request) {
  const Mesh mesh = io::read_mesh(request.mesh).mesh;
  if (mesh.topology->kind() != MeshKind::volume)
    throw UsageError(request.mesh + " is no volume mesh");
  const auto targets = volume_targets(*mesh.topology, nullptr, TargetBlend::regular(),
                                      &mesh.coordinates, request.threads);
  const VolumeWinslow form(std::make_shared<const NodeClasses>(mesh.topology), targets,
                           PenaltyOptions(), request.threads);
  const auto first_order = form.first_order();
  if (!first_order) throw UsageError(request.mesh + " has periodic pairs or rows along curves");
  std::printf("%d nodes, %d elements\n", mesh.coordinates.size(), mesh.topology->element_count());
  const Table table(request);
  time_loops_over_cells(table, mesh, form, *first_order);
  SparseMatrix laplacian, hessian;
  first_order->laplacian(mesh.coordinates, laplacian);
  const auto scalar = make_multigrid_of_components(request.threads);
  time_multigrid(table, "scalar", *scalar, laplacian, 3 * at(first_order->rows()));
  time_curvature_memory(table, 3 * at(first_order->rows()), request.threads);
  std::vector<double> residual(form.unknowns());
  form.linearise(mesh.coordinates, Curvature::projected, hessian, residual);
  ReorderedMatrix ordered;  // as conjugate gradients do
  ordered.assign(hessian, request.threads);
  const auto blocks = make_multigrid(request.threads);
  time_multigrid(table, "block", *blocks, ordered.matrix(), residual.size());
  time_conjugate_gradients(table, ordered.matrix(), request.threads);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    time_kernels(read_request({arguments + 1, arguments + count}));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "volume_kernels_bench: %s\n", error.what());
    return 1;
  }
}
