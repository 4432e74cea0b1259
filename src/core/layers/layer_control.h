#pragma once

#include "core/formulation/cell_targets.h"
#include "core/layers/layer_stack.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// VCVs that control the spacing of layers (AIAA 2009-1362: "the edge lengths of the corresponding
/// computational stencils were modified to reflect the new distribution").
///
/// All edges of the VCVs of nodes in layers are lengths in the mesh, in one unit: along columns the
/// wanted height of the layer times its correction, sideways the distance that straight columns
/// have there. Corners of quadrilaterals have right angles; where those of straight columns are
/// further than 10 degrees from that (where the wall turns, in fans), and in triangles, the angles
/// are those of straight columns. Columns that were found keep the angles and the lengths that they
/// have on their own course. At the rim the elements outside share what is left of the circle.
///
/// base: of this topology, or of the one before the layers were inserted; nodes outside the layers
/// keep its VCVs. x (#nodes by 2): gives the walls on which the columns stand.
std::shared_ptr<const VirtualControlVolumes> layer_vcvs(
    const std::shared_ptr<const Topology>& topology, const LayerStack& stack,
    const VirtualControlVolumes& base, const Coordinates& x);

/// What the elements of a mesh are to layers in it: those of layers are stiff; those outside that
/// touch the rim, or a step of layers that were found, keep their own targets.
std::shared_ptr<const ElementRoles> layer_roles(const Topology& topology, const LayerStack& stack);

/// Multiplies the corrections of all layers by their wanted height over the one that they have.
void correct_layers(LayerStack& stack, const Coordinates& x);

}  // namespace winslow
