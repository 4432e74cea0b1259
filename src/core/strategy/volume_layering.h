#pragma once

#include "core/layers/space/volume_insertion.h"
#include "core/strategy/layering.h"

/// Opens the layers that were inserted in a volume mesh:
///
///     const winslow::VolumeLayerInsertion layers = winslow::insert_volume_layers(mesh, plan);
///     winslow::MeshState state = winslow::make_state(mesh);
///     const auto result = winslow::open_volume_layers(layers, request, state, {});
///     const auto heights = winslow::measure_layers(*state.layers, state.mesh.coordinates);
namespace winslow {

/// Moves the columns of layers from their collapsed start to the wanted heights, through valid
/// meshes, by Newton's method on the variational form. The targets of the elements in layers are
/// their shapes in `layers.ideal`, with the weight role_weight() of layers: it decides where the
/// nodes of columns are, and the elements outside, whose targets are those of the options (`auto`
/// by default, which refers to the start), share what is left.
///
/// What error the heights still have is corrected: the targets get c_k times the wanted heights,
/// with c_k multiplied by the wanted over the realised height, normal to the wall
/// (volume_measures.h), in at most three further runs, until no height is off by more than
/// `request.tolerance`. A correction that leads away from the heights, or turns columns, is not
/// kept.
///
/// Wall nodes stay. Columns that stand on other parts of the boundary slide there, together with
/// all nodes of those markers. Markers of the options slide as well. Interior nodes outside the
/// region of SmoothOptions::keep_outside stay.
///
/// request: its smoothing options, tolerance, most_corrections, and `control`: without it the
/// heights are opened and then left to the smoothing. state: the mesh before the insertion on
/// entry; on return it has the mesh with layers and the stack with its corrections, and motions
/// hold the heights at the walls of the request if `control` is set. It is unchanged if this
/// throws: UsageError for options that do not open layers, for layers outside that region, and for
/// columns that stand where nothing slides; NumericError, with the place, if the wanted layers
/// cross one another, if the start has inverted elements, or if no valid mesh with these layers is
/// found; Cancelled.
SmoothResult open_volume_layers(const VolumeLayerInsertion& layers, const LayerRequest& request,
                                MeshState& state, const RunOptions& run);

/// Inserts layers in a volume mesh, as run_layers() does in the plane: plans the layers of the
/// request, inserts their elements, and opens them. state as above. Throws UsageError for a mesh
/// with inverted elements, and what the three throw.
SmoothResult insert_layers_in_space(const LayerRequest& request, MeshState& state,
                                    const RunOptions& run);

}  // namespace winslow
