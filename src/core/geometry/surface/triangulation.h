#pragma once

#include <array>

#include "core/mesh/coordinates.h"
#include "core/search/box_tree.h"
#include "core/types.h"

namespace winslow {

/// Triangles of a part of a surface without features, seen from one side counter-clockwise.
struct Triangulation {
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;  ///< of points
};

/// The triangles of a quadrilateral of a surface, cut along its shorter diagonal, as numbers of its
/// corners.
std::array<std::array<std::size_t, 3>, 2> halves_of(const SpacePoints& x,
                                                    std::span<const Index> quadrilateral);

/// Neighbour k of a triangle lies across the edge from its corner k to the next; -1: none, or more
/// than one.
std::vector<std::array<Index, 3>> triangle_neighbours(const Triangulation& surface);

/// The normals at the points, of length 1. Inside, the mean of the triangles' normals with weights
/// that are exact for spheres (N. Max, "Weights for computing vertex normals from facet normals",
/// J. Graphics Tools 4(2), 1999); at the border, where that is of first order only, that of a
/// paraboloid through the points around. tangents: of the borders that are smooth there, to which
/// the normals are at right angles; zero elsewhere (#points).
std::vector<Vec3> point_normals(const Triangulation& surface, std::span<const Vec3> tangents);

/// A place in a triangle of a triangulation.
struct TrianglePlace {
  Index triangle = -1;
  Vec3 at{0, 0, 0};  ///< barycentric coordinates
};

/// Finds the places of a triangulation that are nearest to points.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(const Triangulation& surface);

  /// surface: the one that the tree was made of. Of equally near triangles the first.
  TrianglePlace nearest(const Triangulation& surface, const Vec3& point) const;

 private:
  BoxTree<3> tree_;
};

Vec3 point_at(const Triangulation& surface, const TrianglePlace& place);

}  // namespace winslow
