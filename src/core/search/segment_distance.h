#pragma once

#include <algorithm>

#include "core/types.h"

namespace winslow {

/// From a point to the segment between two others, which may be one place.
template <int D>
double segment_distance(const Vec<D>& p, const Vec<D>& a, const Vec<D>& b) {
  const Vec<D> along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - (a + t * along)).norm();
}

}  // namespace winslow
