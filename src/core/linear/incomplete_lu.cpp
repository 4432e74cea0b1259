#include "core/linear/incomplete_lu.h"

#include <Eigen/IterativeLinearSolvers>

#include "core/error.h"
#include "core/linear/eigen_matrix.h"

namespace winslow {

namespace {

class IncompleteLu final : public Preconditioner {
 public:
  IncompleteLu() {
    ilut_.setDroptol(1e-3);
    ilut_.setFillfactor(10);
  }

  std::string description() const override { return "incomplete LU (ILUT)"; }

  void build(const SparseMatrix& matrix) override {
    if (matrix_.assign(matrix)) {
      // Not analyzePattern: Eigen's ILUT would be asked for a status that it has not set yet.
      ilut_.compute(matrix_.matrix());
    } else {
      ilut_.factorize(matrix_.matrix());
    }
    if (ilut_.info() != Eigen::Success) {
      throw NumericError("the linear system is singular (incomplete LU failed)");
    }
  }

  void apply(std::span<const double> r, std::span<double> z) override {
    const auto n = static_cast<Eigen::Index>(r.size());
    Eigen::Map<Eigen::VectorXd>(z.data(), n) =
        ilut_.solve(Eigen::Map<const Eigen::VectorXd>(r.data(), n));
  }

 private:
  EigenMatrix matrix_{EigenMatrix::Part::all};
  Eigen::IncompleteLUT<double> ilut_;
};

}  // namespace

std::unique_ptr<Preconditioner> make_incomplete_lu() { return std::make_unique<IncompleteLu>(); }

}  // namespace winslow
