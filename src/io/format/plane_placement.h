#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.h"

namespace winslow::io {

/// Where in space a plane mesh lies whose plane is not z = constant.
///
/// In-plane coordinates are (u . p, v . p) of a point p, with unit vectors u and v at right angles.
/// They depend on the plane alone, so that numbers that a user types mean the same for every mesh
/// in it: (x, z) for y = constant, (y, z) for x = constant. For a tilted plane the first axis is
/// the projection of the x-axis (of the y-axis, where the plane is steepest against x), and the
/// normal n = u x v has a positive component along z, a negative one along y, or a positive one
/// along x, whichever is the largest.
class PlanePlacement {
 public:
  /// The plane of points: x, y, z of one after the other, all finite. None if one of them is
  /// farther from it than 1e-9 of the extent.
  static std::optional<PlanePlacement> find(const std::vector<double>& xyz);

  const Vec3& u() const { return u_; }
  const Vec3& v() const { return v_; }
  Vec3 normal() const { return u_.cross(v_); }

  /// Number of points.
  Index size() const { return static_cast<Index>(xyz_.size() / 3); }
  /// In-plane coordinates of a point that it was found by.
  Vec2 in_plane(Index point) const;
  /// A point of in-plane coordinates p. One of those that the plane was found by, where p are its
  /// coordinates: bit by bit as it was; elsewhere it keeps its distance from the plane (round-off),
  /// and others have that of the first point.
  Vec3 in_space(Index point, const Vec2& p) const;

  /// "(x, z)" or "along (0.6, 0.8, 0) and (0, 0, 1)": what in-plane coordinates are.
  std::string axes_text() const;
  /// "the plane y = 0.5", "the plane 0.6 x + 0.8 z = 2".
  std::string plane_text() const;

  /// Elements of the file go round the other way than seen against n: they are turned in memory,
  /// and back when the mesh is written.
  bool from_behind = false;

 private:
  PlanePlacement(std::vector<double> xyz, const Vec3& u, const Vec3& v)
      : xyz_(std::move(xyz)), u_(u), v_(v) {}
  Vec3 point(Index i) const;

  std::vector<double> xyz_;
  Vec3 u_, v_;
};

/// Largest distance of points (as above, at least one) from the plane that fits them best.
double distance_from_plane(const std::vector<double>& xyz);

}  // namespace winslow::io
