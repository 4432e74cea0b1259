#include "core/linear/linear_solver.h"

#include <cmath>

#include "core/error.h"
#include "core/linear/blocks.h"
#include "core/linear/factorisation.h"
#include "core/linear/krylov.h"
#include "core/linear/multigrid.h"
#include "core/linear/preconditioner.h"
#include "core/linear/vector_operations.h"

namespace winslow {

namespace {

/// Sparse Cholesky for symmetric matrices, sparse LU for others. With the factor of an earlier
/// matrix (set_matrix with keep) it solves by conjugate gradients or GMRES preconditioned by that
/// factor, and factorises if that does not converge.
class DirectSolver final : public LinearSolver {
 public:
  DirectSolver(const LinearOptions& options, int threads)
      : krylov_{options.tolerance, options.max_iterations, options.restart, threads} {}

  std::string_view name() const override { return "direct"; }
  std::string description() const override {
    return factor_ ? factor_->description() : "sparse factorisation";
  }
  void count(MemoryUse& use) const override { use.factors += factor_ ? factor_->bytes() : 0; }
  void set_tolerance(double relative_residual) override { krylov_.tolerance = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    matrix_ = &matrix;
    if (keep && factorised_ && fits(matrix))
      outdated_ = true;
    else
      factorise();
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    if (matrix_->rows() == 0) return {1, 0};
    if (outdated_) {
      // A factorisation takes about as long as this number of iterations with the old factor.
      constexpr int worthwhile = 12;
      KrylovOptions few = krylov_;
      few.max_iterations = std::min(few.max_iterations, worthwhile);
      const std::vector<double> guess(x.begin(), x.end());
      const LinearResult corrected = krylov_solve(
          *matrix_,
          [&](std::span<const double> r, std::span<double> z) { factor_->solve(r, 1, z); }, few,
          rhs, columns, x);
      // The factor 2 allows for round-off in the updated residual.
      if (corrected.relative_residual <= 2 * krylov_.tolerance) return corrected;
      std::copy(guess.begin(), guess.end(), x.begin());
      factorise();
    }
    factor_->solve(rhs, columns, x);
    return {1, relative_residual(*matrix_, rhs, columns, x, krylov_.threads)};
  }

 private:
  /// Whether data that depend only on pattern, block size and symmetry can be reused for the
  /// matrix.
  bool fits(const SparseMatrix& matrix) const {
    return pattern_ == matrix.pattern && block_ == matrix.block && symmetric_ == matrix.symmetric;
  }
  void factorise() {
    factorised_ = false;
    outdated_ = false;
    if (!factor_ || !fits(*matrix_))
      factor_ = matrix_->symmetric ? make_cholesky() : make_lu(matrix_->rows());
    pattern_ = matrix_->pattern;
    block_ = matrix_->block;
    symmetric_ = matrix_->symmetric;
    if (matrix_->rows() > 0) factor_->factorise(*matrix_);
    factorised_ = true;
  }

  KrylovOptions krylov_;
  std::unique_ptr<Factorisation> factor_;
  std::shared_ptr<const SparsityPattern> pattern_;  // of the factor, like the next two
  int block_ = 0;
  bool symmetric_ = false;
  bool factorised_ = false;
  bool outdated_ = false;  // the factor is that of an earlier matrix
  const SparseMatrix* matrix_ = nullptr;
};

/// A Krylov method on a copy of the matrix in a cache-friendly order.
class KrylovSolver final : public LinearSolver {
 public:
  enum class Method { conjugate_gradients, gmres };

  KrylovSolver(Method method, std::unique_ptr<Preconditioner> preconditioner,
               const LinearOptions& options, int threads)
      : name_(options.solver),
        method_(method),
        preconditioner_(std::move(preconditioner)),
        krylov_{options.tolerance, options.max_iterations, options.restart, threads} {}

  std::string_view name() const override { return name_; }
  std::string description() const override {
    return (method_ == Method::gmres ? "GMRES, " : "CG, ") + preconditioner_->description();
  }
  void count(MemoryUse& use) const override {
    use.preconditioner += matrix_.bytes() + preconditioner_->bytes();
  }
  void set_tolerance(double relative_residual) override { krylov_.tolerance = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    if (method_ == Method::conjugate_gradients && !matrix.symmetric) {
      throw UsageError("the linear solver '" + name_ +
                       "' takes symmetric matrices only; use automatic, direct, gmres or "
                       "point-implicit for this one");
    }
    keep = keep && built_ && pattern_ == matrix.pattern && block_ == matrix.block;
    if (!keep) built_ = false;
    pattern_ = matrix.pattern;
    block_ = matrix.block;
    if (matrix.rows() > 0) {
      matrix_.assign(matrix, krylov_.threads);
      if (!keep) preconditioner_->build(matrix_.matrix());
    }
    built_ = true;
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    LinearResult result;
    if (rhs.empty()) return result;
    const std::size_t n = rhs.size() / static_cast<std::size_t>(columns);
    std::vector<double> b(n), y(n);
    const auto solve_one = method_ == Method::gmres ? gmres : conjugate_gradients;
    for (int c = 0; c < columns; ++c) {
      matrix_.gather(rhs, columns, c, b);
      matrix_.gather(x, columns, c, y);
      const LinearResult one = solve_one(
          matrix_.matrix(),
          [&](std::span<const double> r, std::span<double> z) { preconditioner_->apply(r, z); },
          krylov_, b, y);
      matrix_.scatter(y, columns, c, x);
      result.worsen(one);
    }
    return result;
  }

 private:
  std::string name_;
  Method method_;
  std::unique_ptr<Preconditioner> preconditioner_;
  KrylovOptions krylov_;
  ReorderedMatrix matrix_;
  std::shared_ptr<const SparsityPattern> pattern_;  // of the preconditioner
  int block_ = 0;
  bool built_ = false;
};

/// Inverses of the blocks on the diagonal, one after the other.
template <int B>
std::vector<double> inverse_diagonal(const SparseMatrix& matrix) {
  std::vector<double> inverse(at(matrix.pattern->rows()) * B * B);
  for (std::size_t i = 0; i < at(matrix.pattern->rows()); ++i) {
    const Eigen::Map<const Block<double, B>> d(
        &matrix.values[at(matrix.pattern->diagonal[i]) * B * B]);
    if (d.determinant() == 0) throw NumericError("the linear system has a zero on its diagonal");
    Eigen::Map<Block<double, B>> target(&inverse[i * B * B]);
    target = d.inverse();
  }
  return inverse;
}

/// Gauss-Seidel sweeps over the rows of blocks, alternately forward and backward: the simple solver
/// that AIAA 2009-1362 mentions first. It has no data to keep from an earlier matrix.
class PointImplicitSolver final : public LinearSolver {
 public:
  PointImplicitSolver(const LinearOptions& options, int threads)
      : tolerance_(options.tolerance), max_iterations_(options.max_iterations), threads_(threads) {}

  std::string_view name() const override { return "point-implicit"; }
  std::string description() const override { return "Gauss-Seidel sweeps"; }
  void count(MemoryUse& use) const override { use.preconditioner += bytes_of(inverse_); }
  void set_tolerance(double relative_residual) override { tolerance_ = relative_residual; }

  void set_matrix(const SparseMatrix& matrix, bool) override {
    matrix_ = &matrix;
    inverse_.clear();
    if (matrix.rows() == 0) return;
    inverse_ =
        with_block(matrix.block, [&](auto size) { return inverse_diagonal<size()>(matrix); });
  }

  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    LinearResult result;
    if (matrix_->rows() == 0) return result;
    const auto residual = [&] { return relative_residual(*matrix_, rhs, columns, x, threads_); };
    result.relative_residual = residual();
    while (result.iterations < max_iterations_ && result.relative_residual > tolerance_) {
      LinearCheckpoint::pass();
      const bool forward = result.iterations % 2 == 0;
      with_block(matrix_->block, [&](auto size) { sweep<size()>(rhs, columns, x, forward); });
      ++result.iterations;
      // The check costs as much as a sweep.
      if (result.iterations % check_every == 0 || result.iterations == max_iterations_) {
        result.relative_residual = residual();
      }
    }
    return result;
  }

 private:
  template <int B>
  void sweep(std::span<const double> rhs, int columns, std::span<double> x, bool forward) {
    const auto rows = at(matrix_->pattern->rows());
    for (std::size_t i = 0; i < rows; ++i) {
      relax<B>(rhs, at(columns), x, forward ? i : rows - 1 - i);
    }
  }

  /// Solves one row of blocks for all right-hand sides.
  template <int B>
  void relax(std::span<const double> rhs, std::size_t columns, std::span<double> x,
             std::size_t row) {
    const SparsityPattern& p = *matrix_->pattern;
    for (std::size_t k = 0; k < columns; ++k) {
      double sum[B];
      for (std::size_t r = 0; r < B; ++r) sum[r] = rhs[(row * B + r) * columns + k];
      for (auto e = at(p.offsets[row]); e < at(p.offsets[row + 1]); ++e) {
        if (e == at(p.diagonal[row])) continue;
        double other[B];
        for (std::size_t c = 0; c < B; ++c) other[c] = x[(at(p.columns[e]) * B + c) * columns + k];
        multiply_subtract<B>(&matrix_->values[e * B * B], other, sum);
      }
      double solution[B];
      multiply<B>(&inverse_[row * B * B], sum, solution);
      for (std::size_t r = 0; r < B; ++r) x[(row * B + r) * columns + k] = solution[r];
    }
  }

  static constexpr int check_every = 10;
  double tolerance_;
  int max_iterations_;
  int threads_;
  const SparseMatrix* matrix_ = nullptr;
  std::vector<double> inverse_;
};

/// Chooses a solver for a matrix by its size, symmetry and number of unknowns per row.
std::string_view suitable_solver(const SparseMatrix& matrix) {
  // Number of unknowns up to which a factorisation is faster, as measured by bench/linear_bench.
  // Three unknowns per row indicate a mesh in space, where factors have much more fill-in.
  constexpr Index cholesky_limit = 10'000, cholesky_limit_in_space = 5'000;
  constexpr Index lu_limit = 400'000, lu_limit_in_space = 1'000;
  if (!matrix.symmetric)
    return matrix.rows() <= (matrix.in_space ? lu_limit_in_space : lu_limit) ? "direct" : "gmres";
  const Index limit = matrix.block < 3 ? cholesky_limit : cholesky_limit_in_space;
  return matrix.rows() <= limit ? "direct" : "multigrid";
}

/// Uses a suitable solver for every matrix.
class AutomaticSolver final : public LinearSolver {
 public:
  AutomaticSolver(const LinearOptions& options, int threads)
      : options_(options), threads_(threads) {}

  std::string_view name() const override { return "automatic"; }
  std::string description() const override {
    return chosen_ ? chosen_->description() : "chosen by the matrix";
  }
  void count(MemoryUse& use) const override {
    if (chosen_) chosen_->count(use);
    if (fallback_) fallback_->count(use);
  }
  void set_tolerance(double relative_residual) override {
    options_.tolerance = relative_residual;
    if (chosen_) chosen_->set_tolerance(relative_residual);
  }

  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    if (hard_ != matrix.pattern) hard_.reset();
    const std::string_view suitable = hard_ ? direct : suitable_solver(matrix);
    if (!chosen_ || chosen_->name() != suitable) {
      options_.solver = suitable;
      chosen_ = make_linear_solver(options_, threads_);
    }
    matrix_ = &matrix;
    factorised_ = false;
    chosen_->set_matrix(matrix, keep);
  }

  /// If an iteration fails, a factorisation either solves the system or identifies the matrix as
  /// singular or indefinite. For large meshes in space it would take minutes and all memory: there
  /// the result of the iteration is final.
  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    if (factorised_) return fallback_->solve(rhs, columns, x);
    if (chosen_->name() == direct) return chosen_->solve(rhs, columns, x);
    constexpr double usable = 10;  // tolerances
    try {
      const LinearResult result = chosen_->solve(rhs, columns, x);
      remember_if_hard(result);
      if (result.relative_residual <= usable * options_.tolerance || !can_factorise())
        return result;
    } catch (const NumericError&) {
      // Breakdown, or the matrix is not positive definite.
      if (!can_factorise()) throw;
    }
    if (!fallback_) {
      LinearOptions options = options_;
      options.solver = direct;
      fallback_ = make_linear_solver(options, threads_);
    }
    fallback_->set_matrix(*matrix_, false);
    factorised_ = true;
    return fallback_->solve(rhs, columns, x);
  }

 private:
  static constexpr std::string_view direct = "direct";

  /// Limits at which a factorisation replaces an iteration. In the plane and on surfaces its work
  /// grows with the power 3/2 of the size, that of an iteration linearly.
  struct Limits {
    Index factorise;   ///< largest matrix that is worth the memory of a factorisation
    Index hard;        ///< largest matrix with faster factorisation if an iteration is slow
    double many;       ///< number of iterations that counts as slow,
    double many_rows;  ///< times sqrt(rows / many_rows); 0: for any size
  };
  const Limits& limits() const {
    static constexpr Limits plane{std::numeric_limits<Index>::max(), 300'000, 100, 1e5};
    static constexpr Limits space{30'000, 15'000, 50, 0};
    return matrix_->block == 3 || matrix_->in_space ? space : plane;
  }
  bool can_factorise() const { return matrix_->rows() <= limits().factorise; }

  /// On stretched meshes multigrid needs many iterations, and a factorisation is faster up to much
  /// larger meshes; above that it needs too much memory.
  void remember_if_hard(const LinearResult& result) {
    const auto& [factorise, hard, many, many_rows] = limits();
    const double growth = many_rows > 0 ? std::sqrt(matrix_->rows() / many_rows) : 1;
    if (result.iterations > many * growth && matrix_->symmetric && matrix_->rows() <= hard)
      hard_ = matrix_->pattern;
  }

  LinearOptions options_;
  int threads_;
  const SparseMatrix* matrix_ = nullptr;
  std::shared_ptr<const SparsityPattern> hard_;  // pattern on which multigrid is slow, if any
  std::unique_ptr<LinearSolver> fallback_;       // made when first needed
  bool factorised_ = false;                      // the fallback holds the present matrix
  std::unique_ptr<LinearSolver> chosen_;
};

template <class Kind>
std::unique_ptr<LinearSolver> make(const LinearOptions& options, int threads) {
  return std::make_unique<Kind>(options, threads);
}

using Method = KrylovSolver::Method;

template <Method method, std::unique_ptr<Preconditioner> (*make_preconditioner)(int threads)>
std::unique_ptr<LinearSolver> make_krylov(const LinearOptions& options, int threads) {
  return std::make_unique<KrylovSolver>(method, make_preconditioner(threads), options, threads);
}
std::unique_ptr<Preconditioner> make_incomplete_lu_alone(int /*threads*/) {
  return make_incomplete_lu();
}

struct Entry {
  std::string_view name;
  std::string_view summary;
  bool needs_symmetry;
  std::unique_ptr<LinearSolver> (*make)(const LinearOptions&, int threads);
};

constexpr std::array<Entry, 6> solvers{{
    {"automatic", "The fastest for the size and the symmetry of the matrix.", false,
     make<AutomaticSolver>},
    {"direct",
     "Sparse Cholesky or LU, ordering reused: the fastest up to some 100,000 nodes in 2D.", false,
     make<DirectSolver>},
    {"cg", "Conjugate gradients with incomplete Cholesky: little memory; symmetric systems only.",
     true, make_krylov<Method::conjugate_gradients, make_incomplete_cholesky>},
    {"multigrid", "Conjugate gradients with multigrid: for large meshes; symmetric systems only.",
     true, make_krylov<Method::conjugate_gradients, make_multigrid>},
    {"gmres", "Restarted GMRES with incomplete LU: less memory than direct on large meshes.", false,
     make_krylov<Method::gmres, make_incomplete_lu_alone>},
    {"point-implicit", "Gauss-Seidel sweeps: the paper's simple solver; slow on large meshes.",
     false, make<PointImplicitSolver>},
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
