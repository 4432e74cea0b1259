#pragma once

#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"

/// A volume mesh with layers, still close to the wall:
///
///     const winslow::LayerStack plan = winslow::plan_volume_layers(mesh, options);
///     const auto layers = winslow::insert_volume_layers(mesh, plan);
///     std::printf("%d elements, from %g of the thickness\n",
///                 layers.mesh.topology->element_count(), layers.share);
namespace winslow {

/// A volume mesh with inserted layers: prisms on triangles, hexahedra on quadrilaterals.
struct VolumeLayerInsertion {
  /// Valid. Nodes 0 .. n-1 are those of the mesh before at their positions. The wall keeps its
  /// nodes, and the elements that were on it are on the rim of the layers. Nodes of layers follow,
  /// column by column from the wall on, at `share` of their wanted distances along straight
  /// columns. Elements 0 .. m-1 are those of the mesh before; those of layers follow, face by face
  /// from the wall on.
  ///
  /// Markers of walls keep their faces at the wall. Other markers that meet a wall get the
  /// quadrilaterals of the layers there, after their own faces.
  Mesh mesh;
  LayerStack stack;  ///< the plan with its nodes; layer_of_element filled
  /// #nodes by 3: straight columns at the wanted heights; other nodes as in `mesh`. Elements
  /// outside may be inverted.
  Coordinates ideal;
  /// The elements outside the layers, with the same nodes. Its markers have the names of the mesh;
  /// those of walls are on the rim. Faces of markers inside the mesh that touch a wall are left
  /// out, since their nodes have to move.
  std::shared_ptr<const Topology> outside;
  /// The largest of 1, 1/2, 1/4, ... at which no element is inverted and the elements outside have
  /// at least half of the smallest scaled Jacobian (Validity::min_sine) that they had.
  double share = 1;
};

/// Inserts the layers of plan_volume_layers(). Throws UsageError for a mesh with inverted elements,
/// for columns of different numbers of layers at one face, and where layers have no room even if
/// they are almost without thickness, naming the element and its place.
VolumeLayerInsertion insert_volume_layers(const Mesh& mesh, LayerStack plan);

}  // namespace winslow
