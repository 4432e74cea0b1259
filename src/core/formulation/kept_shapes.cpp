#include "core/formulation/kept_shapes.h"

#include "core/mesh/polygon.h"
#include "core/mesh/polyhedron.h"

namespace winslow {

namespace {

constexpr double stretched_from = 4;  // aspect ratio from which weights grow

/// stretch: logarithm of the aspect ratio of the own shape.
double weight_by_stretch(double stretch) {
  constexpr double most = 300;
  return std::clamp(std::exp(stretch) / stretched_from, 1.0, most);
}
/// The same for shapes in space. Most are not stretched, which is quickly seen.
double weight_by_stretch(const Eigen::Matrix3d& regular, const Eigen::Matrix3d& own) {
  static const double limit = std::log(stretched_from) - stretch_error;
  if (quick_stretch(regular.llt().matrixL(), own) < limit) return 1;
  return weight_by_stretch(stretch_between(regular, own));
}

/// distortion: f of the own shape, from the regular one.
double guard_weight(double distortion) {
  constexpr double from = 1.5, power = 8, most = 100;
  return std::min(most, std::pow(std::max(1.0, distortion / from), power));
}

double inverse_limit(double distortion) {
  constexpr double least = 1.4;
  return 1 / std::max(least, distortion);
}

}  // namespace

KeptTerms<2> kept_terms(const ElementShape& shape, const TargetMetric& regular,
                        const TargetMetric& own, double weight) {
  const TargetMetric straight = with_lengths_of(own, regular);
  const double distortion = std::cosh(stretch_between(straight, own));
  weight *= regular_area(shape) * weight_by_stretch(stretch_between(regular, own));
  return {own.term(weight), straight.term(weight * guard_weight(distortion)),
          inverse_limit(distortion)};
}

KeptTerms<3> kept_terms(const ElementShape& shape, const Eigen::Matrix3d& regular,
                        const Eigen::Matrix3d& own, double weight) {
  const Eigen::Matrix3d straight = with_lengths_of(own, regular);
  const double distortion = (straight * own.inverse()).trace() / 3;
  weight *= regular_volume(shape) * weight_by_stretch(regular, own);
  return {volume_term(own, weight), volume_term(straight, weight * guard_weight(distortion)),
          inverse_limit(distortion)};
}

}  // namespace winslow
