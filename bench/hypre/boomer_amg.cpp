#include "hypre/boomer_amg.h"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <numeric>
#include <vector>

#include "core/error.h"

namespace winslow::bench {

namespace {

/// MPI and hypre, for as long as the program runs.
struct Library {
  Library() {
    MPI_Init(nullptr, nullptr);
    HYPRE_Init();
  }
  ~Library() {
    HYPRE_Finalize();
    MPI_Finalize();
  }
};

void require_library() { static const Library library; }

void check(HYPRE_Int code) {
  if (code != 0) throw NumericError("hypre reports error " + std::to_string(code));
}

HYPRE_IJVector make_vector(std::span<const double> values) {
  const auto n = static_cast<HYPRE_Int>(values.size());
  std::vector<HYPRE_BigInt> rows(values.size());
  std::iota(rows.begin(), rows.end(), 0);
  HYPRE_IJVector v = nullptr;
  check(HYPRE_IJVectorCreate(MPI_COMM_WORLD, 0, n - 1, &v));
  check(HYPRE_IJVectorSetObjectType(v, HYPRE_PARCSR));
  check(HYPRE_IJVectorInitialize(v));
  check(HYPRE_IJVectorSetValues(v, n, rows.data(), values.data()));
  check(HYPRE_IJVectorAssemble(v));
  return v;
}

HYPRE_ParVector object_of(HYPRE_IJVector v) {
  void* object = nullptr;
  check(HYPRE_IJVectorGetObject(v, &object));
  return static_cast<HYPRE_ParVector>(object);
}

/// The same matrix, scalar row by scalar row.
HYPRE_IJMatrix make_matrix(const SparseMatrix& matrix) {
  const SparsityPattern& p = *matrix.pattern;
  const auto block = static_cast<std::size_t>(matrix.block);
  const HYPRE_BigInt last = matrix.rows() - 1;
  HYPRE_IJMatrix out = nullptr;
  check(HYPRE_IJMatrixCreate(MPI_COMM_WORLD, 0, last, 0, last, &out));
  check(HYPRE_IJMatrixSetObjectType(out, HYPRE_PARCSR));
  check(HYPRE_IJMatrixInitialize(out));
  std::vector<HYPRE_BigInt> columns;
  std::vector<double> values;
  for (HYPRE_BigInt row = 0; row <= last; ++row) {
    const auto i = static_cast<std::size_t>(row) / block, r = static_cast<std::size_t>(row) % block;
    columns.clear();
    values.clear();
    for (auto e = static_cast<std::size_t>(p.offsets[i]);
         e < static_cast<std::size_t>(p.offsets[i + 1]); ++e) {
      for (std::size_t c = 0; c < block; ++c) {
        columns.push_back(p.columns[e] * static_cast<HYPRE_BigInt>(block) +
                          static_cast<HYPRE_BigInt>(c));
        values.push_back(matrix.values[(e * block + r) * block + c]);
      }
    }
    auto count = static_cast<HYPRE_Int>(columns.size());
    check(HYPRE_IJMatrixSetValues(out, 1, &count, &row, columns.data(), values.data()));
  }
  check(HYPRE_IJMatrixAssemble(out));
  return out;
}

}  // namespace

struct BoomerAmg::Impl {
  BoomerKind kind = BoomerKind::unknown_wise;
  HYPRE_IJMatrix ij = nullptr;
  HYPRE_ParCSRMatrix matrix = nullptr;
  HYPRE_Solver amg = nullptr, cg = nullptr;

  ~Impl() {
    if (cg) HYPRE_ParCSRPCGDestroy(cg);
    if (amg) HYPRE_BoomerAMGDestroy(amg);
    if (ij) HYPRE_IJMatrixDestroy(ij);
  }
};

BoomerAmg::BoomerAmg(const SparseMatrix& matrix, BoomerKind kind, double tolerance)
    : impl_(std::make_unique<Impl>()) {
  require_library();
  impl_->kind = kind;
  impl_->ij = make_matrix(matrix);
  void* object = nullptr;
  check(HYPRE_IJMatrixGetObject(impl_->ij, &object));
  impl_->matrix = static_cast<HYPRE_ParCSRMatrix>(object);

  constexpr HYPRE_Int hmis = 10, extended = 6, symmetric_sweep = 6;
  check(HYPRE_BoomerAMGCreate(&impl_->amg));
  HYPRE_Solver amg = impl_->amg;
  check(HYPRE_BoomerAMGSetNumFunctions(amg, matrix.block));
  check(HYPRE_BoomerAMGSetStrongThreshold(amg, 0.5));  // as the manual advises in space
  check(HYPRE_BoomerAMGSetCoarsenType(amg, hmis));
  check(HYPRE_BoomerAMGSetInterpType(amg, extended));
  check(HYPRE_BoomerAMGSetPMaxElmts(amg, 4));
  check(HYPRE_BoomerAMGSetRelaxType(amg, symmetric_sweep));
  if (kind == BoomerKind::nodal) {
    constexpr HYPRE_Int frobenius = 1;
    check(HYPRE_BoomerAMGSetNodal(amg, frobenius));
  }
  check(HYPRE_BoomerAMGSetTol(amg, 0));
  check(HYPRE_BoomerAMGSetMaxIter(amg, 1));

  check(HYPRE_ParCSRPCGCreate(MPI_COMM_WORLD, &impl_->cg));
  HYPRE_Solver cg = impl_->cg;
  check(HYPRE_PCGSetTol(cg, tolerance));
  check(HYPRE_PCGSetTwoNorm(cg, 1));
  check(HYPRE_PCGSetMaxIter(cg, 1000));
  check(HYPRE_ParCSRPCGSetPrecond(cg, HYPRE_BoomerAMGSolve, HYPRE_BoomerAMGSetup, amg));
  const std::vector<double> zero(static_cast<std::size_t>(matrix.rows()), 0.0);
  HYPRE_IJVector b = make_vector(zero), x = make_vector(zero);
  check(HYPRE_ParCSRPCGSetup(cg, impl_->matrix, object_of(b), object_of(x)));
  HYPRE_IJVectorDestroy(b);
  HYPRE_IJVectorDestroy(x);
}

BoomerAmg::~BoomerAmg() = default;

std::string BoomerAmg::description() const {
  return impl_->kind == BoomerKind::nodal ? "hypre: BoomerAMG, nodal"
                                          : "hypre: BoomerAMG, by unknowns";
}

LinearResult BoomerAmg::solve(std::span<const double> rhs, std::span<double> x) {
  HYPRE_IJVector b = make_vector(rhs), y = make_vector(x);
  // That the iteration ends at its limit is reported as an error; the residual says it as well.
  HYPRE_ParCSRPCGSolve(impl_->cg, impl_->matrix, object_of(b), object_of(y));
  HYPRE_ClearAllErrors();
  LinearResult result;
  HYPRE_Int iterations = 0;
  check(HYPRE_PCGGetNumIterations(impl_->cg, &iterations));
  check(HYPRE_PCGGetFinalRelativeResidualNorm(impl_->cg, &result.relative_residual));
  result.iterations = iterations;
  std::vector<HYPRE_BigInt> rows(x.size());
  std::iota(rows.begin(), rows.end(), 0);
  check(HYPRE_IJVectorGetValues(y, static_cast<HYPRE_Int>(x.size()), rows.data(), x.data()));
  HYPRE_IJVectorDestroy(b);
  HYPRE_IJVectorDestroy(y);
  return result;
}

}  // namespace winslow::bench
