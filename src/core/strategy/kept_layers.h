#pragma once

#include "core/layers/layer_spacing.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/strategy/keep_outside.h"

namespace winslow {

/// Layers of a mesh in which a command keeps some nodes where they are (`kept`, ascending): those
/// outside the region of SmoothOptions::keep_outside.

/// The nodes that layers which are made or spaced at these walls leave where they are. A circle
/// without a centre stands about the walls. Throws as nodes_kept_outside(); not where walls lie
/// outside.
std::vector<Index> nodes_kept_by_layers(const KeepOutside& keep, const Mesh& mesh,
                                        std::span<const LayerWall> walls);

/// Throws UsageError naming the first wall that lies outside the region, or whose layers, as long
/// as the columns are to be or as they run in the mesh, reach out of it.
void require_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                           std::span<const LayerWall> walls);

/// The same of the columns that stand on the nodes of a motion.
void require_moved_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                                 std::span<const Index> moving);

/// Columns with a node that is kept are again as in `before`: no run can meet other heights there.
void restore_kept_columns(LayerStack& stack, const LayerStack& before, std::span<const Index> kept);

/// measure_layers() without the columns that have a node that is kept.
LayerMeasures measure_movable_layers(LayerStack stack, const Coordinates& x,
                                     std::span<const Index> kept);

}  // namespace winslow
