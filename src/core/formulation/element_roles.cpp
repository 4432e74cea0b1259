#include "core/formulation/element_roles.h"

#include "core/error.h"

namespace winslow {

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
  // Known layers are held by their roles, against which all else is to be soft.
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
