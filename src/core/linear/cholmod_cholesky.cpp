#if defined(WINSLOW_HAS_CHOLMOD)
#include <cholmod.h>
#include <dlfcn.h>

#include <new>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/linear/factorisation.h"

namespace winslow {

namespace {

#if defined(WINSLOW_HAS_CHOLMOD_SUPERNODAL)
constexpr bool supernodal = true;
#else
constexpr bool supernodal = false;
#endif

/// Number of block rows above which METIS gives less fill-in than AMD, in the plane.
constexpr Index metis_limit = 20'000;

/// CHOLMOD's settings, memory statistics and last error.
class Common {
 public:
  Common() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.try_catch = 1;
    // Always L L^T: L D L^T would accept an indefinite matrix.
    common_.final_ll = 1;
    common_.supernodal = supernodal ? CHOLMOD_AUTO : CHOLMOD_SIMPLICIAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
  }
  ~Common() { cholmod_finish(&common_); }
  Common(const Common&) = delete;
  Common& operator=(const Common&) = delete;

  cholmod_common* get() { return &common_; }
  int status() const { return common_.status; }

  /// Throws the error of the last call. Ignores warnings.
  void check() const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status < CHOLMOD_OK) {
      throw NumericError("sparse Cholesky failed (CHOLMOD status " +
                         std::to_string(common_.status) + ")");
    }
  }

 private:
  cholmod_common common_;
};

/// Restricts CHOLMOD in the calling thread to one thread while this object exists. CHOLMOD requests
/// four OpenMP threads for every supernode, regardless of OMP_NUM_THREADS: on two cores the motion
/// of a small mesh took twice as long, mostly waiting. Uses CHOLMOD's OpenMP runtime, if it was
/// built with one.
class WithoutOpenMP {
 public:
  WithoutOpenMP() {
    if (set()) set()(0);
  }
  ~WithoutOpenMP() {
    if (set()) set()(levels_);
  }
  WithoutOpenMP(const WithoutOpenMP&) = delete;
  WithoutOpenMP& operator=(const WithoutOpenMP&) = delete;

 private:
  using Get = int (*)();
  using Set = void (*)(int);

  static int most_levels() {
    static const auto get = reinterpret_cast<Get>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
    return get ? get() : 1;
  }
  static Set set() {
    static const auto set = reinterpret_cast<Set>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
    return set;
  }

  int levels_ = most_levels();
};

/// A view of compressed columns as the lower triangle of a symmetric matrix. values: null for the
/// pattern alone.
cholmod_sparse lower_view(Index rows, const Index* outer, const Index* inner, const double* values,
                          std::size_t entries) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(rows);
  view.nzmax = entries;
  view.p = const_cast<Index*>(outer);
  view.i = const_cast<Index*>(inner);
  view.x = const_cast<double*>(values);
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

class CholmodCholesky final : public Factorisation {
 public:
  CholmodCholesky() = default;
  ~CholmodCholesky() override {
    cholmod_free_dense(&solution_, common_.get());
    cholmod_free_dense(&work_y_, common_.get());
    cholmod_free_dense(&work_e_, common_.get());
    cholmod_free_factor(&factor_, common_.get());
  }
  CholmodCholesky(const CholmodCholesky&) = delete;
  CholmodCholesky& operator=(const CholmodCholesky&) = delete;

  std::string description() const override {
    std::string kind = factor_ && factor_->is_super ? "supernodal" : "simplicial";
    return "CHOLMOD " + kind + " Cholesky (" + ordering_ + " ordering)";
  }

  std::size_t bytes() const override {
    if (!factor_) return matrix_.bytes();
    const std::size_t values = factor_->is_super ? factor_->xsize : factor_->nzmax;
    const std::size_t indices = factor_->is_super ? factor_->ssize : factor_->nzmax;
    return matrix_.bytes() + values * sizeof(double) + indices * sizeof(int);
  }

  void factorise(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix) || !factor_) analyse(matrix);
    cholmod_sparse a = view();
    const WithoutOpenMP alone;
    const BlasTurn turn(factor_->is_super != 0);
    cholmod_factorize(&a, factor_, common_.get());
    common_.check();
    if (common_.status() == CHOLMOD_NOT_POSDEF || factor_->minor < factor_->n) {
      throw NotPositiveDefinite("the matrix is not positive definite (sparse Cholesky)");
    }
  }

  void solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto n = static_cast<Eigen::Index>(factor_->n);
    Eigen::MatrixXd b = Eigen::Map<const RowMajor>(rhs.data(), n, columns);
    cholmod_dense view{};
    view.nrow = view.d = factor_->n;
    view.ncol = static_cast<std::size_t>(columns);
    view.nzmax = rhs.size();
    view.x = b.data();
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    const WithoutOpenMP alone;
    const BlasTurn turn(factor_->is_super != 0);
    cholmod_solve2(CHOLMOD_A, factor_, &view, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                   common_.get());
    common_.check();
    const Eigen::Map<const Eigen::MatrixXd> result(static_cast<const double*>(solution_->x), n,
                                                   columns);
    if (!result.allFinite()) {
      throw NumericError("the linear system is singular to working precision");
    }
    Eigen::Map<RowMajor>(x.data(), n, columns) = result;
  }

 private:
  cholmod_sparse view() const {
    const auto& m = matrix_.matrix();
    return lower_view(static_cast<Index>(m.rows()), m.outerIndexPtr(), m.innerIndexPtr(),
                      m.valuePtr(), static_cast<std::size_t>(m.nonZeros()));
  }

  /// Orders the graph of the blocks, which is block^2 times smaller than that of the scalars and
  /// keeps the unknowns of a row together.
  std::vector<Index> order(const SparseMatrix& matrix) {
    const SparsityPattern& p = *matrix.pattern;
    cholmod_sparse graph =
        lower_view(p.rows(), p.offsets.data(), p.columns.data(), nullptr, p.columns.size());
    std::vector<Index> blocks(static_cast<std::size_t>(p.rows()));
    bool done = false;
#if !defined(NPARTITION)
    if (p.rows() >= metis_limit) {
      done = cholmod_metis(&graph, nullptr, 0, 1, blocks.data(), common_.get()) != 0;
      ordering_ = "METIS";
    }
#endif
    if (!done) {
      done = cholmod_amd(&graph, nullptr, 0, blocks.data(), common_.get()) != 0;
      ordering_ = "AMD";
    }
    common_.check();
    std::vector<Index> scalars;
    scalars.reserve(blocks.size() * static_cast<std::size_t>(matrix.block));
    for (const Index b : blocks) {
      for (Index r = 0; r < matrix.block; ++r) scalars.push_back(b * matrix.block + r);
    }
    return scalars;
  }

  void analyse(const SparseMatrix& matrix) {
    cholmod_free_factor(&factor_, common_.get());
    // Supernodal factorisation calls BLAS.
    if (supernodal && !blas_has_memory()) common_.get()->supernodal = CHOLMOD_SIMPLICIAL;
    std::vector<Index> permutation = order(matrix);
    cholmod_sparse a = view();
    factor_ = cholmod_analyze_p(&a, permutation.data(), nullptr, 0, common_.get());
    common_.check();
  }

  Common common_;
  EigenMatrix matrix_{EigenMatrix::Part::lower};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;  // reused by later solves, like the next two
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
  std::string ordering_ = "AMD";
};

}  // namespace

std::unique_ptr<Factorisation> make_cholesky() { return std::make_unique<CholmodCholesky>(); }

}  // namespace winslow
#endif
