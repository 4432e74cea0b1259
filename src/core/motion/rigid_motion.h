#pragma once

#include "core/mesh/mesh.h"
#include "core/options/given_vector.h"

/// Rigid motions of the plane and of space, and their algebra.
///
///   RigidMotion asked{.rotate = -40, .pivot = Vec2(0.8, 0)};             // of a plane mesh
///   const RigidMotion motion = resolve_motion(asked, 2, Vec3(0, 0, 0));  // checked
///   const Vec3 there = transform(motion, Vec3(1, 0, 0));
///   const RigidMotion back = inverse(motion);
///
/// Points and vectors have three components; those of the plane have z = 0 and turn about z. A
/// motion of space has an axis, one of the plane has none: that is what tells them apart.
namespace winslow {

/// x -> pivot + R(rotate) (x - pivot) + translate.
struct RigidMotion {
  /// Degrees, counter-clockwise positive; in space as seen from where the axis points to.
  double rotate = 0;
  /// In units of the mesh. None: the centre of what moves, see body_centre().
  std::optional<GivenVector> pivot = {};
  GivenVector translate{0, 0};  ///< in units of the mesh
  /// In space: the direction about which it turns, of any length but zero.
  std::optional<Vec3> axis = {};

  bool operator==(const RigidMotion&) const = default;
};

/// The motion as a mesh of this dimension (2 or 3) makes it: about `centre` unless it names a
/// pivot, in space with an axis, and by how many numbers it was given is forgotten. This is where
/// it is checked: throws UsageError for an axis or a third component in the plane, for a rotation
/// in space without an axis, for an axis of no length, and for numbers that are not finite.
RigidMotion resolve_motion(RigidMotion motion, int dimension, const Vec3& centre);

/// The pivot, the origin if it names none.
Vec3 pivot_of(const RigidMotion& motion);
/// The axis, that of z if it has none.
Vec3 axis_of(const RigidMotion& motion);
bool moves(const RigidMotion& motion);

/// Where a motion takes a point.
Vec3 transform(const RigidMotion& motion, const Vec3& point);
Vec2 transform(const RigidMotion& motion, const Vec2& point);
/// Where a point was before a motion.
Vec3 transform_back(const RigidMotion& motion, const Vec3& point);
Vec2 transform_back(const RigidMotion& motion, const Vec2& point);
/// What a motion makes of a vector, which only turns.
Vec3 rotated(const RigidMotion& motion, const Vec3& vector);

/// The motion that is `first`, then `second`. Rotations about parallel axes keep their full turns;
/// of others the shorter way round is taken, by 180 degrees at most. A translation alone keeps
/// rotate exactly 0.
RigidMotion compose(const RigidMotion& first, const RigidMotion& second);
/// The motion that takes everything back.
RigidMotion inverse(const RigidMotion& motion);
/// The motion that brings `nodes` of `from` nearest to where they are in `to` (least squares; in
/// space W. Kabsch, Acta Cryst. A32, 1976). Rotation in (-180, 180] in the plane and in [0, 180] in
/// space. No motion for no nodes.
RigidMotion fit_rigid_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to);
/// A fitted motion about the axis of another, if its own is parallel, with as many full turns as
/// bring it nearest to `degrees`.
RigidMotion with_turns(RigidMotion fitted, const RigidMotion& other, double degrees);
/// The same rotation, pivot and translation; where nothing turns the axis does not count.
bool same_motion(const RigidMotion& a, const RigidMotion& b);

/// The point about which bodies turn unless another is named: the centre of the bounding box of
/// all that moves. A component that is nothing but rounding errors is 0.
Vec3 body_centre(const Box<3>& box);
/// The bounding box of nodes; that of plane coordinates lies in the plane z = 0.
Box<3> body_box(const Coordinates& x, std::span<const Index> nodes);

}  // namespace winslow
