#include "core/formulation/cell_targets.h"

#include <cmath>

#include "core/error.h"

namespace winslow {

TargetBlend normalized(const TargetBlend& blend) {
  const double sum = blend.automatic + blend.element + blend.vcv + blend.rest;
  if (!(blend.automatic >= 0 && blend.element >= 0 && blend.vcv >= 0 && blend.rest >= 0) ||
      !(sum > 0) || !std::isfinite(sum)) {
    throw UsageError("the shares of the target shapes must not be negative, nor all zero");
  }
  return {blend.automatic / sum, blend.element / sum, blend.vcv / sum, blend.rest / sum};
}

}  // namespace winslow
