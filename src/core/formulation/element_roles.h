#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/stretch_field.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// What is known of an element that its targets should heed.
enum class ElementRole : std::uint8_t {
  ordinary,      ///< nothing
  layer,         ///< it is in a layer that was inserted: its shape counts far more than others'
  found_layer,   ///< it is in a layer that was found in the mesh: the same, by less
  beside_layers  ///< it touches the rim or a step of layers from outside: it keeps its own target
};
/// #elements
using ElementRoles = std::vector<ElementRole>;

/// The role of an element; ordinary where roles is null.
inline ElementRole role_of(const ElementRoles* roles, Index element) {
  return roles ? (*roles)[at(element)] : ElementRole::ordinary;
}

/// How much more than that of an ordinary element the shape of one counts.
///
/// All count relative to their size, so the elements outside, pressed together to make room, would
/// otherwise press the layers by about as much and turn the columns of fans; 1e4 leaves a
/// ten-thousandth of it to the corrections. Layers that were found keep the shapes that they have,
/// which costs less: there 1e3 do, and the linear systems are easier to solve.
double role_weight(ElementRole role);
/// Whether the VCVs that nodes of an element were given do not count in it: those of a rim are made
/// for the layers.
inline bool ignores_vcvs(ElementRole role) { return role == ElementRole::beside_layers; }

/// Weight of an element in the energy, all of its targets together. stretch: of the mesh as given;
/// counts where the blend has a share for `automatic`.
double element_weight(Index element, const TargetBlend& blend, const StretchField& stretch,
                      const ElementRoles* roles);

/// Throws UsageError unless there is one role for each element, or none at all (null).
void require_role_of_each(const ElementRoles* roles, const Topology& topology);

}  // namespace winslow
