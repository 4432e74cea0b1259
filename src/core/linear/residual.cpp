#include "core/linear/residual.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace winslow {

double relative_residual(const SparseSystem& system, std::span<const double> x) {
  const SparsityPattern& p = *system.pattern;
  const auto columns = static_cast<std::size_t>(system.columns);
  std::vector<double> defect2(columns, 0.0), rhs2(columns, 0.0);
  for (std::size_t row = 0; row + 1 < p.offsets.size(); ++row) {
    for (std::size_t c = 0; c < columns; ++c) {
      const double b = system.rhs[row * columns + c];
      double defect = b;
      for (auto e = static_cast<std::size_t>(p.offsets[row]);
           e < static_cast<std::size_t>(p.offsets[row + 1]); ++e) {
        defect -= system.values[e] * x[static_cast<std::size_t>(p.columns[e]) * columns + c];
      }
      defect2[c] += defect * defect;
      rhs2[c] += b * b;
    }
  }
  double worst = 0;
  for (std::size_t c = 0; c < columns; ++c) {
    const double relative = std::sqrt(rhs2[c] > 0 ? defect2[c] / rhs2[c] : defect2[c]);
    // A solution that is not finite must not pass for an exact one.
    if (std::isnan(relative)) return relative;
    worst = std::max(worst, relative);
  }
  return worst;
}

}  // namespace winslow
