#include "core/formulation/tetrahedron_distortion.h"

#include <Eigen/LU>
#include <cmath>

namespace winslow::distortion {

Corner3::Corner3(const std::array<Vec3, 4>& p) {
  for (int k = 0; k < 3; ++k) edges.col(k) = p[static_cast<std::size_t>(k + 1)] - p[0];
  d = edges.determinant();
}

double Corner3::distortion(const VolumeTerm& term) const {
  const double s = (edges.transpose() * edges).cwiseProduct(metric_of(term)).sum();
  return d > 0 ? s / (3 * std::cbrt(d) * std::cbrt(d)) : -1;
}

}  // namespace winslow::distortion
