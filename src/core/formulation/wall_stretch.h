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
    const Seen* seen = find_element(e);
    return seen ? &seen->map : nullptr;
  }
  /// Factor of the weight of an element: those with held heights are stiff.
  double stiffness_of(Index e) const {
    constexpr double held = 10;
    const Seen* seen = find_element(e);
    return seen && seen->held ? held : 1;
  }
  /// The elements with a map, ascending.
  const std::vector<Index>& elements() const { return elements_; }

 private:
  friend class WallLayers;
  friend class WallStretchDerivative;

  struct Seen {
    Eigen::Matrix3d map;
    bool held;
  };
  const Seen* find_element(Index e) const {
    const auto found = std::ranges::lower_bound(elements_, e);
    if (found == elements_.end() || *found != e) return nullptr;
    return &seen_[static_cast<std::size_t>(found - elements_.begin())];
  }
  void add(Index e, Seen seen) {
    elements_.push_back(e);
    seen_.push_back(std::move(seen));
  }

  std::vector<Index> elements_;
  std::vector<Seen> seen_;  // of elements_
};

/// The walls of a mesh, and the elements in layers over them. For the many motions of one mesh,
/// which stretch the same walls:
///
///     const WallLayers layers(classes, reference);
///     const auto stretch = layers.stretched(moved);  // as WallStretch::find(), each time
///
/// The elements are found when a wall is stretched for the first time. Copies have the same ones.
/// One call at a time.
class WallLayers {
 public:
  /// As WallStretch::find().
  WallLayers(std::shared_ptr<const NodeClasses> classes,
             std::shared_ptr<const Coordinates> reference);

  const NodeClasses& classes() const { return *classes_; }
  const Coordinates& reference() const { return *reference_; }
  /// Without the mesh.
  std::size_t bytes() const;
  /// As WallStretch::find().
  std::shared_ptr<const WallStretch> stretched(const Coordinates& moved,
                                               std::span<const double> factors = {}) const;

 private:
  friend class WallStretch;
  friend class WallStretchDerivative;
  class Elements;

  /// Those over faces that are not degenerate in a mesh.
  std::shared_ptr<const Elements> elements(const Coordinates& moved) const;

  std::shared_ptr<const NodeClasses> classes_;
  std::shared_ptr<const Coordinates> reference_;
  mutable std::shared_ptr<const Elements> elements_;  // over all faces; null: not needed yet
};

/// How the maps of a WallStretch depend on where the walls are: first through parameters of the
/// elements, t_i^T S t_j with the mean S of F^T F + n n^T over the faces under the element and the
/// tangents t_i of the wall there. An element has one such parameter in the plane and over an edge
/// of a wall in space, else three: (1, 1), (2, 2), (1, 2).
///
///     const winslow::WallLayers layers(classes, reference);
///     const winslow::WallStretchDerivative walls(layers, moved, {});
///     walls.add_rates(velocities, rates);                      // forward, element after element
///     const auto more = walls.changed(parameter, 1e-4);        // maps with one parameter changed
class WallStretchDerivative {
 public:
  /// moved, factors: as of WallStretch::find(). Elements count also over walls that are not
  /// stretched.
  WallStretchDerivative(const WallLayers& layers, const Coordinates& moved,
                        std::span<const double> factors);

  /// The elements whose maps depend on the walls, ascending.
  const std::vector<Index>& elements() const { return elements_; }
  /// Largest number of parameters of an element: 1 in the plane, 3 in space.
  int parameters() const { return dimension_ == 2 ? 1 : 3; }

  /// The maps if one parameter (0 to parameters() - 1) of all elements that have it increases by
  /// `change`; with a change of 0 those of WallStretch::find(). Null if all are the identity.
  std::shared_ptr<const WallStretch> changed(int parameter, double change) const;

  /// Adds the rates of the parameters (#elements() by parameters()) if the nodes of walls move at
  /// these velocities (#nodes by 2 or 3; others are not read).
  void add_rates(const Coordinates& velocities, std::span<double> rates) const;
  /// The transpose: adds the products of the multipliers of the rates to the nodes of walls.
  void add_transpose(std::span<const double> multipliers, Coordinates& out) const;

 private:
  friend class WallLayers;

  struct Below {
    Eigen::Matrix3d squares, along;
    std::vector<Vec3> tangents;
    std::vector<Index> faces;  // into faces_
    double share, height;
    bool held;
  };
  /// What a product of two stretched tangents depends on: the edges of a face.
  struct StretchedFace {
    Face nodes;
    Eigen::Matrix3d inverse;  // of the frame in the reference mesh
    Eigen::Matrix3d moved;    // frame after the motion
  };
  template <typename Visit>
  void for_each_part(const Visit& visit) const;

  int dimension_;
  std::vector<Index> elements_;
  std::vector<Below> below_;  // of elements_
  std::vector<StretchedFace> faces_;
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
