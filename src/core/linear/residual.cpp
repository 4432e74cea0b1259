#include "core/linear/residual.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/linear/columns.h"
#include "core/linear/vector_operations.h"

namespace winslow {

double relative_residual(const SparseMatrix& matrix, std::span<const double> rhs, int columns,
                         std::span<const double> x, int threads) {
  std::vector<double> solution(x.begin(), x.end()), r(static_cast<std::size_t>(matrix.rows()));
  double worst = 0;
  bool finite = true;
  for_each_column(rhs, columns, solution, [&](std::span<const double> b, std::span<double> y) {
    const double defect2 = defect(matrix, b, y, r, threads);
    const double rhs2 = dot(b, b, threads);
    const double relative = std::sqrt(rhs2 > 0 ? defect2 / rhs2 : defect2);
    // A solution that is not finite must not pass for an exact one.
    finite = finite && std::isfinite(relative);
    worst = std::max(worst, relative);
  });
  return finite ? worst : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace winslow
