#pragma once

#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// How far layers are followed from a wall.
enum class LayerExtent {
  connected,  ///< whole rows of quadrilaterals, as long as all along a wall there is one more
  /// Strip by strip, quadrilaterals or pairs of triangles, as long as cells are stretched along the
  /// wall and heights grow steadily away from it: the rules are in docs/layers.md.
  stretched
};

/// The columns of a mesh's layers at walls (their nodes, and why they end), neighbours, and the
/// layer of each element; without heights and directions. Columns may have no layer.
/// Throws UsageError as find_wall_chains() does.
LayerStack climb_layers(const Mesh& mesh, const LayerOptions& options, LayerExtent extent);

}  // namespace winslow
