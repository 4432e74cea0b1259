#pragma once

#include "core/layers/layer_climb.h"
#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

/// The layers that a mesh was read with:
///
///     winslow::LayerOptions options;
///     options.walls = {{{"wing"}, {}}};
///     const winslow::LayerStack found = winslow::detect_layers(mesh, options);
namespace winslow {

/// Finds the layers that a mesh has at walls (climb_layers says which elements count). Heights are
/// those that the layers have (#layers of each column), with `asked` their thickness. Those of
/// extent `stretched` keep the course of their columns (LayerColumn::bends); the others are to be
/// straight. x: #nodes by 2. Throws UsageError: an unknown marker; no layers at any of the walls,
/// and why.
LayerStack detect_layers(const Mesh& mesh, const LayerOptions& options,
                         LayerExtent extent = LayerExtent::stretched);

/// Gives detected layers the heights that the options ask for, as many as there are layers; where
/// that takes more room than there is, as plan_layers() does.
void respace_layers(LayerStack& stack, const Mesh& mesh, const LayerOptions& options);

/// Layers found at some walls together with the known ones of all other walls, which stay as they
/// are. Both are of this topology, `known` perhaps of one with fewer elements, numbered alike.
LayerStack with_other_layers(LayerStack found, const LayerStack& known, const Topology& topology);

}  // namespace winslow
