#pragma once

#include "core/formulation/cell_targets.h"
#include "core/layers/layer_stack.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// VCVs that control the spacing of layers (AIAA 2009-1362: "the edge lengths of the corresponding
/// computational stencils were modified to reflect the new distribution").
///
/// The edges of the VCVs of nodes in layers have lengths in units of the mesh: along columns the
/// wanted height of the layer times its correction, across columns the distance between straight
/// columns. Corners of quadrilaterals have right angles. Two kinds of corners have the angles of
/// straight columns: those of triangles, and those where that angle differs from a right angle by
/// more than 10 degrees (where the wall turns, in fans). Columns that were found in the mesh keep
/// the angles and the lengths of their course. At the rim the elements outside share the rest of
/// the circle.
///
/// base: of this topology, or of the one before the layers were inserted; nodes outside the layers
/// keep its VCVs. x (#nodes by 2): determines the walls.
std::shared_ptr<const VirtualControlVolumes> layer_vcvs(
    const std::shared_ptr<const Topology>& topology, const LayerStack& stack,
    const VirtualControlVolumes& base, const Coordinates& x);

/// Roles of the elements: those in layers are stiff; elements outside that touch the rim, or a step
/// between found columns of different heights, keep their own targets.
std::shared_ptr<const ElementRoles> layer_roles(const Topology& topology, const LayerStack& stack);

/// Multiplies the corrections of all layers by the wanted height over the present height.
void correct_layers(LayerStack& stack, const Coordinates& x);

}  // namespace winslow
