#pragma once

#include "core/mesh/curve_order.h"
#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"
#include "core/types.h"

namespace winslow {

/// A plane in space with a front: the side that its normal points to.
class Plane {
 public:
  /// normal: of any length but 0. Throws UsageError for one that is 0 and for what is not finite.
  Plane(const Vec3& point, const Vec3& normal);

  const Vec3& point() const { return point_; }
  const Vec3& normal() const { return normal_; }  ///< of length 1
  /// Positive in front of the plane.
  double distance(const Vec3& p) const { return normal_.dot(p - point_); }

 private:
  Vec3 point_, normal_;
};

/// Two directions of length 1 that span a plane; with its normal, to which they are at right
/// angles, they make up a right-handed frame.
std::array<Vec3, 2> directions_in(const Vec3& unit_normal);

/// Where the elements of a volume mesh are, in blocks of such as lie near one another: what a plane
/// meets is found without a look at the others. For many sections of one mesh.
class SectionIndex {
 public:
  /// Throws UsageError unless it is a volume mesh.
  explicit SectionIndex(const Mesh& mesh);
  /// Of other positions of the same nodes.
  SectionIndex(const Mesh& mesh, const SectionIndex& before);

  const CurveOrder& order() const { return *order_; }
  /// Where nodes are, by their numbers in the order.
  const std::vector<Vec3>& places() const { return places_; }
  /// Elements, by their numbers in the order, of all blocks that come nearer to a plane than
  /// `slack`: among them all elements that do.
  std::vector<Index> near(const Plane& plane, double slack) const;
  /// Around all nodes that elements use.
  const Box<3>& extent() const { return extent_; }

 private:
  void measure(const Mesh& mesh);

  std::shared_ptr<const CurveOrder> order_;
  std::vector<Vec3> places_;
  std::vector<Box<3>> boxes_;  // of the blocks
  Box<3> extent_;
};

}  // namespace winslow
