#pragma once

#include "core/mesh/coordinates.h"
#include "core/search/box_tree.h"
#include "core/types.h"

namespace winslow {

/// Triangles of a part of a surface without features, counter-clockwise seen from one side.
struct Triangulation {
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;  ///< of points
};

/// Splits a face into triangles, as numbers of its corners: a triangle is its own, a quadrilateral
/// is cut along its shorter diagonal, or the other one if that leaves a triangle without area (its
/// corner is flat), and a face with more corners is cut as by cut_face(). face: nodes.
std::vector<std::array<Index, 3>> triangles_of(const SpacePoints& x, std::span<const Index> face);

/// Neighbour k of a triangle is beyond the edge from its corner k to the next one; -1: none, or
/// more than one.
std::vector<std::array<Index, 3>> triangle_neighbours(const Triangulation& surface);

/// Unit normals at the points. At an interior point it is the mean of the normals of the triangles
/// with weights that are exact for spheres (N. Max, "Weights for computing vertex normals from
/// facet normals", J. Graphics Tools 4(2), 1999). At the border this mean is of first order only,
/// so it is the normal of a paraboloid through the points around. tangents: of the borders that are
/// smooth there, at right angles to the normals; zero elsewhere (#points).
std::vector<Vec3> point_normals(const Triangulation& surface, std::span<const Vec3> tangents);

/// A place in a triangle of a triangulation.
struct TrianglePlace {
  Index triangle = -1;
  Vec3 barycentric{0, 0, 0};  ///< coordinates
};

/// Finds the nearest places of a triangulation to points.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(const Triangulation& surface);

  /// surface: the triangulation that was given to the constructor. Of several equally near
  /// triangles, returns the first.
  TrianglePlace nearest(const Triangulation& surface, const Vec3& point) const;

 private:
  BoxTree<3> tree_;
};

Vec3 point_at(const Triangulation& surface, const TrianglePlace& place);

}  // namespace winslow
