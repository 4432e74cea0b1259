#pragma once

#include "core/mesh/mesh.h"
#include "core/problem/node_classes.h"

namespace winslow {

/// How a motion stretches walls along themselves, as the elements in layers over the walls see it.
/// Targets `keep` take it into account, so that the heights of layers do not depend on it:
///
///     const auto stretch = winslow::WallStretch::find(classes, reference, moved);
///     if (const Eigen::Matrix3d* map = stretch ? stretch->map_of(e) : nullptr) edge = *map * edge;
///
/// A wall is made of faces whose nodes do not move while the mesh is smoothed: faces of the
/// boundary, of markers, and of solids that are moved as a whole. A face with the normal n has the
/// surface deformation gradient F from the reference mesh to its position after the motion. The
/// map of an element in layers over the face is
///
///   U^s,  U = (F^T F + n n^T)^(1/2),  s = step(log r; 0.3, 0.7),
///
/// where step is the cubic that rises from 0 to 1. The element's own shape becomes as long along
/// the wall as the wall became, and keeps its height. r is how long the element is along the wall,
/// over its height (root mean squares of its nodes' distances from their mean). So isotropic
/// elements keep their shape, and their heights grow with the wall. The face of an element is that
/// with most of the wall nodes to which the shortest ways along edges lead from the element's
/// nodes. Where several faces have as many, the means of F^T F and n n^T are taken. Where these
/// faces turn by more than 37 degrees, an element whose ways all lead to one wall node, as in a
/// fan, has no map; in space, one whose ways lead to two wall nodes stretches along their edge
/// only.
///
/// The map depends only on the reference mesh and on where the walls are.
class WallStretch {
 public:
  /// classes: which nodes do not move. reference: the mesh whose shapes are kept. moved: a mesh in
  /// which all nodes that do not move have their final positions; others are not read. factors:
  /// of the heights that are held, by the upper node of their LayerEdge (#nodes; 0: not held);
  /// empty: none is held. An element's height is multiplied by the geometric mean over its held
  /// edges. Returns null if no wall is stretched and no height is held.
  static std::shared_ptr<const WallStretch> find(const NodeClasses& classes,
                                                 const Coordinates& reference,
                                                 const Coordinates& moved,
                                                 std::span<const double> factors = {});

  /// The map of the edges of an element in the reference mesh; null: the identity. In the plane the
  /// third direction stays as it is.
  const Eigen::Matrix3d* map_of(Index e) const {
    const auto found = elements_.find(e);
    return found == elements_.end() ? nullptr : &found->second.map;
  }
  /// Factor of the weight of an element: those with held heights are stiff.
  double stiffness_of(Index e) const {
    constexpr double held = 10;
    const auto found = elements_.find(e);
    return found != elements_.end() && found->second.held ? held : 1;
  }

 private:
  struct Seen {
    Eigen::Matrix3d map;
    bool held;
  };
  std::map<Index, Seen> elements_;
};

/// An edge up a column of layers: the height of one layer there.
struct LayerEdge {
  Index lower, upper;  ///< lower: nearer to the wall
};

/// The edges up the columns of the layers over some nodes of the boundary, in ascending order of
/// their upper nodes: the last edges on the shortest ways from the wall in elements of which all
/// nodes stand on these nodes, and which are at least 1.65 times as long along the wall as high.
std::vector<LayerEdge> layer_edges(const Mesh& mesh, std::span<const Index> wall_nodes);

}  // namespace winslow
