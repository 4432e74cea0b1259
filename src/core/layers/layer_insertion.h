#pragma once

#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// A mesh with the connectivity of layers.
struct LayerInsertion {
  /// Nodes 0 .. n-1 are those of the mesh before, where they were: the wall keeps its nodes, and
  /// the elements that stood on it now stand on the rim of the layers. Nodes of layers follow, laid
  /// out straight at their wanted distances: elements outside may be inverted until they have made
  /// room. Elements 0 .. m-1 are those of the mesh before.
  Mesh mesh;
  LayerStack stack;  ///< the plan, with its nodes and elements
  /// What lies outside the layers, over the same nodes; the rims are part of its boundary.
  std::shared_ptr<const Topology> outside;
};

/// Inserts planned layers: quadrilaterals between neighbouring columns; triangles where one of them
/// has fewer layers, or none, and at the wall under a fan. Above a fan the old wall node's star is
/// split along its edges, one more triangle for each column. Throws UsageError for a plan without
/// layers.
LayerInsertion insert_layers(const Mesh& mesh, LayerStack plan);

}  // namespace winslow
