#include "core/outer/line_search.h"

#include <algorithm>
#include <cmath>

namespace winslow {

double first_valid_step(const SmoothingProblem& problem, std::span<const double> direction,
                        double longest, const Coordinates& x) {
  constexpr double margin = 0.9;
  Coordinates full = x;
  problem.advance(direction, 1, full);
  return std::min(longest, margin * problem.largest_valid_step(x, full, longest / margin));
}

double shorter_step(double t, double slope, double rise) {
  const double shorter = std::isfinite(rise) && rise > 0 ? 0.5 * slope * t * t / rise : 0;
  return std::clamp(shorter, 0.1 * t, 0.5 * t);
}

double longer_step(double slope, double change) {
  const double curvature = change + slope;  // half of it
  return curvature > 0 ? slope / (2 * curvature) : 1;
}

}  // namespace winslow
