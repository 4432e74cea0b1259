#pragma once

#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

namespace winslow {

/// A mesh with inserted layers.
struct LayerInsertion {
  /// Nodes 0 .. n-1 are those of the mesh before at their positions. The wall keeps its nodes, and
  /// the elements that were on it are on the rim of the layers. Nodes of layers follow, at their
  /// wanted distances along straight columns, so that elements outside may be inverted before they
  /// are smoothed. Elements 0 .. m-1 are those of the mesh before.
  Mesh mesh;
  LayerStack stack;  ///< the plan, with its nodes and elements
  /// The elements outside the layers, with the same nodes; the rims are part of the boundary.
  std::shared_ptr<const Topology> outside;
};

/// Inserts planned layers: quadrilaterals between neighbouring columns; triangles where one column
/// has fewer layers or none, and at the wall in a fan. Above a fan the star of the wall node is
/// split along its edges, and each sector adds a triangle. Throws UsageError for a plan without
/// layers.
LayerInsertion insert_layers(const Mesh& mesh, LayerStack plan);

}  // namespace winslow
