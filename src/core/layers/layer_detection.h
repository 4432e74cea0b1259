#pragma once

#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

/// The layers that a mesh was read with:
///
///     winslow::LayerOptions options;
///     options.walls = {{{"wing"}, {}}};
///     const winslow::LayerStack found = winslow::detect_layers(mesh, options);
namespace winslow {

/// Which elements at a wall are its layers.
enum class LayerExtent {
  connected,  ///< whole rows of quadrilaterals along all of a wall
  /// In each strip quadrilaterals or pairs of triangles that are stretched along the wall and whose
  /// heights grow steadily away from it. docs/layers.md has the rules.
  stretched
};

/// Finds the columns of the layers that a mesh has at walls, with their nodes and the reasons why
/// they end. Also finds the pairs of columns and the layer of each element, but no heights or
/// directions. Columns may have no layer. Throws UsageError as find_wall_chains() does.
LayerStack climb_layers(const Mesh& mesh, const LayerOptions& options, LayerExtent extent);

/// Finds the layers that a mesh has at walls. Wanted heights are the present ones (#layers of each
/// column), and `asked` is their sum. Columns of extent `stretched` keep their course
/// (LayerColumn::bends), others become straight. Throws UsageError for an unknown marker, and, with
/// the reason, if there are no layers at any of the walls.
LayerStack detect_layers(const Mesh& mesh, const LayerOptions& options,
                         LayerExtent extent = LayerExtent::stretched);

/// Gives detected layers the wanted heights of the options; their number stays. Where there is not
/// enough room for them, heights are those of plan_layers().
void respace_layers(LayerStack& stack, const Mesh& mesh, const LayerOptions& options);

/// Adds the known layers of other walls, unchanged, to layers found at some walls. Both are of this
/// topology; `known` may be of one with fewer elements that have the same numbers.
LayerStack with_other_layers(LayerStack found, const LayerStack& known, const Topology& topology);

}  // namespace winslow
