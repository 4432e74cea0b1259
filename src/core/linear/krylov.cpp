#include "core/linear/krylov.h"

#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/linear/vector_operations.h"

namespace winslow {

namespace {

thread_local const LinearCheckpoint* innermost = nullptr;

}  // namespace

LinearCheckpoint::LinearCheckpoint(std::function<void()> ask)
    : ask_(std::move(ask)), outer_(std::exchange(innermost, this)) {}

LinearCheckpoint::~LinearCheckpoint() { innermost = outer_; }

void LinearCheckpoint::pass() {
  if (innermost != nullptr && innermost->ask_) innermost->ask_();
}

namespace {

using Vector = std::vector<double>;

/// The least-squares problem of GMRES, min |beta e1 - H y|. Givens rotations keep H triangular as
/// columns are added.
class HessenbergLeastSquares {
 public:
  HessenbergLeastSquares(std::size_t size, double beta)
      : size_(size), h_(size * (size + 1), 0.0), cosine_(size), sine_(size), g_(size + 1, 0.0) {
    g_[0] = beta;
  }

  /// Adds a column of length k + 1 plus the subdiagonal entry. Returns the norm of the residual.
  double add_column(std::span<const double> column) {
    const std::size_t k = count_++;
    double* h = &h_[k * (size_ + 1)];
    std::copy(column.begin(), column.end(), h);
    for (std::size_t i = 0; i < k; ++i) rotate(i, h[i], h[i + 1]);
    const double length = std::hypot(h[k], h[k + 1]);
    cosine_[k] = length > 0 ? h[k] / length : 1;
    sine_[k] = length > 0 ? h[k + 1] / length : 0;
    rotate(k, h[k], h[k + 1]);
    rotate(k, g_[k], g_[k + 1]);
    return std::abs(g_[k + 1]);
  }

  Vector solution() const {
    Vector y(count_);
    for (std::size_t i = count_; i-- > 0;) {
      double sum = g_[i];
      for (std::size_t j = i + 1; j < count_; ++j) sum -= h_[j * (size_ + 1) + i] * y[j];
      const double pivot = h_[i * (size_ + 1) + i];
      y[i] = pivot != 0 ? sum / pivot : 0;
    }
    return y;
  }

 private:
  void rotate(std::size_t i, double& a, double& b) const {
    const double t = cosine_[i] * a + sine_[i] * b;
    b = cosine_[i] * b - sine_[i] * a;
    a = t;
  }

  std::size_t size_, count_ = 0;
  Vector h_, cosine_, sine_, g_;
};

/// One cycle of GMRES from the residual in basis[0], of norm beta. Returns the iterations made.
int gmres_cycle(const SparseMatrix& matrix, const ApplyPreconditioner& precondition, double beta,
                double goal, int limit, int threads, std::vector<Vector>& basis,
                std::span<double> x) {
  const std::size_t n = x.size();
  Vector z(n), column;
  HessenbergLeastSquares least_squares(static_cast<std::size_t>(limit), beta);
  for (double& v : basis[0]) v /= beta;
  int done = 0;
  for (bool more = true; more && done < limit;) {
    LinearCheckpoint::pass();
    const auto k = static_cast<std::size_t>(done++);
    if (basis.size() <= k + 1) basis.emplace_back(n);
    Vector& w = basis[k + 1];
    precondition(basis[k], z);
    multiply(matrix, z, w, threads);
    column.clear();
    for (std::size_t i = 0; i <= k; ++i) {
      column.push_back(dot(w, basis[i], threads));
      add_scaled(-column.back(), basis[i], w, threads);
    }
    const double norm = std::sqrt(dot(w, w, threads));
    if (!std::isfinite(norm)) throw NumericError("GMRES broke down");
    column.push_back(norm);
    more = least_squares.add_column(column) > goal && norm > 0;
    if (norm > 0) {
      for (double& v : w) v /= norm;
    }
  }
  const Vector y = least_squares.solution();
  Vector combination(n, 0.0);
  for (std::size_t i = 0; i < y.size(); ++i) add_scaled(y[i], basis[i], combination, threads);
  precondition(combination, z);
  add_scaled(1, z, x, threads);
  return done;
}

/// True if the right-hand side is zero; x is the solution then.
bool trivial(std::span<const double> b, std::span<double> x) {
  if (std::any_of(b.begin(), b.end(), [](double v) { return v != 0; })) return false;
  std::fill(x.begin(), x.end(), 0.0);
  return true;
}

}  // namespace

LinearResult conjugate_gradients(const SparseMatrix& matrix,
                                 const ApplyPreconditioner& precondition,
                                 const KrylovOptions& options, std::span<const double> b,
                                 std::span<double> x) {
  if (trivial(b, x)) return {};
  const int threads = options.threads;
  Vector r(b.size()), z(b.size()), q(b.size());
  const double b2 = dot(b, b, threads);
  const double goal2 = options.tolerance * options.tolerance * b2;
  double r2 = defect(matrix, b, x, r, threads);
  if (r2 <= goal2) return {0, std::sqrt(r2 / b2)};
  precondition(r, z);
  Vector p = z;
  double rz = dot(r, z, threads);
  for (int k = 1;; ++k) {
    LinearCheckpoint::pass();
    const double curvature = multiply(matrix, p, q, threads);
    if (!std::isfinite(curvature) || !std::isfinite(rz)) {
      throw NumericError("conjugate gradients broke down");
    }
    if (!(curvature > 0) || !(rz > 0)) {
      throw NotPositiveDefinite("the matrix is not positive definite (conjugate gradients)");
    }
    r2 = advance(rz / curvature, p, q, x, r, threads);
    if (r2 <= goal2 || k == options.max_iterations) {
      // The true residual: round-off makes the updated one drift from it.
      return {k, std::sqrt(defect(matrix, b, x, r, threads) / b2)};
    }
    precondition(r, z);
    const double next = dot(r, z, threads);
    scale_and_add(next / rz, z, p, threads);
    rz = next;
  }
}

LinearResult gmres(const SparseMatrix& matrix, const ApplyPreconditioner& precondition,
                   const KrylovOptions& options, std::span<const double> b, std::span<double> x) {
  if (trivial(b, x)) return {};
  const double b_norm = std::sqrt(dot(b, b, options.threads));
  const double goal = options.tolerance * b_norm;
  std::vector<Vector> basis(1, Vector(b.size()));
  int done = 0;
  for (;;) {
    const double beta = std::sqrt(defect(matrix, b, x, basis[0], options.threads));
    if (!std::isfinite(beta)) throw NumericError("GMRES broke down");
    if (beta <= goal || done == options.max_iterations) return {done, beta / b_norm};
    done += gmres_cycle(matrix, precondition, beta, goal,
                        std::min(options.restart, options.max_iterations - done), options.threads,
                        basis, x);
  }
}

LinearResult krylov_solve(const SparseMatrix& matrix, const ApplyPreconditioner& precondition,
                          const KrylovOptions& options, std::span<const double> rhs, int columns,
                          std::span<double> x) {
  LinearResult result;
  const auto solve_one = matrix.symmetric ? conjugate_gradients : gmres;
  for_each_column(rhs, columns, x, [&](std::span<const double> b, std::span<double> y) {
    result.worsen(solve_one(matrix, precondition, options, b, y));
  });
  return result;
}

}  // namespace winslow
