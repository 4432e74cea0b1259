#pragma once

#include "core/mesh/index_sets.h"
#include "core/mesh/mesh.h"
#include "core/mesh/node_stars.h"
#include "core/search/box_tree.h"
#include "core/types.h"

namespace winslow {

/// A plane in space. Its normal points to its front.
class Plane {
 public:
  /// normal: of any length except 0. Throws UsageError for a zero normal and for numbers that are
  /// not finite.
  Plane(const Vec3& point, const Vec3& normal);

  const Vec3& point() const { return point_; }
  const Vec3& normal() const { return normal_; }  ///< of length 1
  /// Positive in front of the plane.
  double distance(const Vec3& p) const { return normal_.dot(p - point_); }

 private:
  Vec3 point_, normal_;
};

/// Two unit vectors that are a right-handed orthonormal frame together with the normal.
std::array<Vec3, 2> directions_in(const Vec3& unit_normal);

/// An index of the elements of a volume mesh for many sections: blocks of neighbouring elements,
/// each with its bounding box. A section only looks at blocks near the plane.
class SectionIndex {
 public:
  /// Throws UsageError unless it is a volume mesh.
  explicit SectionIndex(const Mesh& mesh);
  /// An index for other positions of the same nodes, in the order of `before`.
  SectionIndex(const Mesh& mesh, const SectionIndex& before);

  const CurveOrder& order() const { return *order_; }
  /// Positions of the nodes, by their numbers in the order.
  const std::vector<Vec3>& places() const { return places_; }
  /// The elements of all blocks that a plane meets, with room for nodes that count as on it, by
  /// their numbers in the order.
  std::vector<Index> near(const Plane& plane) const;
  /// The box around all nodes that elements use.
  const Box<3>& extent() const { return extent_; }

 private:
  void measure(const Mesh& mesh);

  std::shared_ptr<const CurveOrder> order_;
  std::vector<Vec3> places_;
  std::vector<Box<3>> boxes_;  // of the blocks
  Box<3> extent_;
};

/// The section of a plane through the elements of a volume mesh: polygons that tile the section
/// without gaps.
///
/// A corner of a polygon is the intersection of the plane with an edge of the mesh, or the foot of
/// a node that counts as on the plane. A side lies in a face of the element, and the element beyond
/// that face has the same side. A quadrilateral face with its corners alternately in front and
/// behind has two sides: the sign of the bilinear distance at its saddle point decides which two,
/// and it is the same for both elements.
struct PlaneSection {
  std::vector<Vec3> points;     ///< each once
  CompressedRows polygons;      ///< indices into points, counter-clockwise seen from the front of
                                ///< the plane (perhaps clockwise for inverted elements)
  std::vector<Index> elements;  ///< of each polygon; an element may have several
};

/// Nodes nearer to the plane than 1e-10 of the extent of the mesh count as on the plane. So do the
/// nodes of a face that are all nearer than 1e-3 of their shortest edges: files with few digits and
/// meshers that snap leave nodes a little off. Nodes on the plane count as in front: if the plane
/// runs along faces, the section is that of the elements behind them. If that section is empty, as
/// at one end of the mesh, it is that of the elements in front. index: of this mesh; polygons and
/// points are then the same in another order. Throws UsageError unless it is a volume mesh.
PlaneSection plane_section(const Mesh& mesh, const Plane& plane,
                           const SectionIndex* index = nullptr);

/// 1 for each element of a crinkle cut (#elements): it has a node behind each of the planes.
std::vector<unsigned char> elements_behind(const Mesh& mesh, std::span<const Plane> planes);

/// Triangulates a polygon of n corners by ear clipping: n - 2 triangles of 3 indices into the
/// corners each. The polygon lies in a plane with this normal and is counter-clockwise about it;
/// for other polygons, or self-intersecting ones, the triangles are arbitrary.
std::vector<Index> cut_polygon(std::span<const Vec3> corners, const Vec3& normal);

}  // namespace winslow
