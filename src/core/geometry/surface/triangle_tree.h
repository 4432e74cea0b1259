#pragma once

#include "core/geometry/surface/triangulation.h"
#include "core/search/box_tree.h"

namespace winslow {

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
