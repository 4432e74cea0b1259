#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

/// The clearance at boundary nodes of a volume mesh, as winslow::Clearance in the plane: the radius
/// of the largest ball that touches the boundary at a node and contains no part of the boundary
/// that faces the node. In a gap it is half the width, inside a sphere its radius.
///
///     const winslow::BallClearance clearance(mesh);
///     const double gap = 2 * clearance.radius(node, direction, reach);
class BallClearance {
 public:
  /// mesh: must outlive it.
  explicit BallClearance(const Mesh& mesh);

  /// Radius, at most `reach` (units of the mesh), of the ball at `node` with its centre in the unit
  /// direction `inward`. Faces at the node itself do not count, nor do those that do not face the
  /// direction: a boundary along the column limits no layers. Both sides of faces of markers inside
  /// the mesh count.
  ///
  /// The ball shrinks until it is empty: its nearest face gives the next radius
  /// r = |q - p|^2 / (2 n.(q - p)) (J. Ma, S. W. Bae, S. Choi, "3D medial axis point approximation
  /// using nearest neighbors and the normal field", Vis. Comput. 28, 2012).
  double radius(Index node, const Vec3& inward, double reach) const;

 private:
  struct Triangle {
    std::array<Index, 3> nodes;
    std::array<Vec3, 3> corners;
    Vec3 normal;  // unit vector into the mesh
    bool inside;  // the mesh is on both sides
  };

  const Coordinates& x_;
  std::vector<Triangle> triangles_;
  BoxTree<3> tree_;  // of triangles_
};

/// The point of a triangle nearest to p (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vec3 nearest_of_triangle(const Vec3& p, const std::array<Vec3, 3>& corners);

}  // namespace winslow
