#include "core/formulation/cell_targets.h"

#include <cmath>

#include "core/error.h"

namespace winslow {

TargetBlend normalized(const TargetBlend& blend) {
  const double others = blend.automatic + blend.element + blend.vcv + blend.rest;
  const double sum = others + blend.keep;
  if (!(blend.automatic >= 0 && blend.element >= 0 && blend.vcv >= 0 && blend.rest >= 0 &&
        blend.keep >= 0) ||
      !(sum > 0) || !std::isfinite(sum)) {
    throw UsageError("the shares of the target shapes must not be negative, nor all zero");
  }
  if (blend.keep > 0 && others > 0)
    throw UsageError(
        "targets: keep cannot be blended with other shapes: give it alone, or blend rest instead");
  return {blend.automatic / sum, blend.element / sum, blend.vcv / sum, blend.rest / sum,
          blend.keep / sum};
}

double role_weight(ElementRole role) {
  switch (role) {
    case ElementRole::layer:
      return 1e4;
    case ElementRole::found_layer:
      return 1e3;
    case ElementRole::ordinary:
    case ElementRole::beside_layers:
      break;
  }
  return 1;
}

double element_weight(Index element, const TargetBlend& blend, const StretchField& stretch,
                      const ElementRoles* roles) {
  double held = 1;
  // The roles of known layers hold them; all other elements must be softer.
  if (blend.automatic > 0)
    held = stretch.weight[at(element)] * (roles ? 1 : stretch.stiffness[at(element)]);
  return role_weight(role_of(roles, element)) * (blend.automatic * held + 1 - blend.automatic);
}

void require_role_of_each(const ElementRoles* roles, const Topology& topology) {
  if (!roles || std::ssize(*roles) == topology.element_count()) return;
  throw UsageError("roles of elements: found " + std::to_string(roles->size()) + ", expected " +
                   std::to_string(topology.element_count()) + ", one for each element");
}

}  // namespace winslow
