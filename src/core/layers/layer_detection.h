#pragma once

#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// Finds the layers that a mesh has at walls: going up from every wall edge, quadrilateral by
/// quadrilateral, columns run as long as those on both sides agree; over a corner with triangles at
/// the wall, a fan of them. They end at the first triangle, at a boundary, or after as many layers
/// as the wall's spacing says. Heights are those that the layers have (#layers of each column),
/// with `asked` their thickness. x: #nodes by 2. Throws UsageError: an unknown marker; no layers at
/// any of the walls.
LayerStack detect_layers(const Mesh& mesh, const LayerOptions& options);

/// Gives detected layers the heights that the options ask for, as many as there are layers; where
/// that takes more room than there is, as plan_layers() does.
void respace_layers(LayerStack& stack, const Mesh& mesh, const LayerOptions& options);

/// Layers found at some walls together with the known ones of all other walls, which stay as they
/// are. Both are of this topology, `known` perhaps of one with fewer elements, numbered alike.
LayerStack with_other_layers(LayerStack found, const LayerStack& known, const Topology& topology);

}  // namespace winslow
