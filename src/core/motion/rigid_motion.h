#pragma once

#include "core/mesh/mesh.h"
#include "core/options/given_vector.h"

/// Rigid motions of the plane and of space: application, composition, inversion, fitting.
///
///   RigidMotion asked{.rotate = -40, .pivot = Vec2(0.8, 0)};             // of a plane mesh
///   const RigidMotion motion = resolve_motion(asked, 2, Vec3(0, 0, 0));  // checked
///   const Vec3 there = transform(motion, Vec3(1, 0, 0));
///   const RigidMotion back = inverse(motion);
///
/// Points and vectors have three components; in the plane z = 0, and rotations are about z. Only
/// motions of space have an axis, which distinguishes them from motions of the plane.
namespace winslow {

/// x -> pivot + R(rotate) (x - pivot) + translate.
struct RigidMotion {
  /// Degrees, counter-clockwise positive; in space seen from the tip of the axis.
  double rotate = 0;
  /// In units of the mesh. None: the centre of the moving nodes, see body_centre().
  std::optional<GivenVector> pivot = {};
  GivenVector translate{0, 0};  ///< in units of the mesh
  /// In space: the axis of rotation, of any length but zero.
  std::optional<Vec3> axis = {};

  bool operator==(const RigidMotion&) const = default;
};

/// Checks and completes a motion for a mesh of this dimension (2 or 3): the pivot defaults to
/// `centre`, in space the motion gets an axis, and vectors no longer record how many numbers were
/// given. Throws UsageError for an axis or a third component in the plane, a rotation in space
/// without an axis, an axis of zero length, and numbers that are not finite.
RigidMotion resolve_motion(RigidMotion motion, int dimension, const Vec3& centre);

/// The pivot; the origin if the motion has none.
Vec3 pivot_of(const RigidMotion& motion);
/// The axis; the z axis if the motion has none.
Vec3 axis_of(const RigidMotion& motion);
bool moves(const RigidMotion& motion);

/// The image of a point under a motion.
Vec3 transform(const RigidMotion& motion, const Vec3& point);
Vec2 transform(const RigidMotion& motion, const Vec2& point);
/// The preimage of a point under a motion.
Vec3 transform_back(const RigidMotion& motion, const Vec3& point);
Vec2 transform_back(const RigidMotion& motion, const Vec2& point);
/// The image of a vector under a motion: only rotated.
Vec3 rotated(const RigidMotion& motion, const Vec3& vector);

/// The composition: `first`, then `second`. Rotations about parallel axes keep their full turns;
/// for other axes the angle is at most 180 degrees. The composition of translations keeps rotate
/// exactly 0.
RigidMotion compose(const RigidMotion& first, const RigidMotion& second);
/// The inverse motion.
RigidMotion inverse(const RigidMotion& motion);
/// The motion that maps `nodes` in `from` as near as possible to their positions in `to` (least
/// squares; in space W. Kabsch, Acta Cryst. A32, 1976). Rotation in (-180, 180] in the plane and in
/// [0, 180] in space. The identity if there are no nodes.
RigidMotion fit_rigid_motion(std::span<const Index> nodes, const Coordinates& from,
                             const Coordinates& to);
/// The fitted motion about the axis of `other`, if the axes are parallel, plus the full turns that
/// bring its angle nearest to `degrees`.
RigidMotion with_turns(RigidMotion fitted, const RigidMotion& other, double degrees);
/// True for the same rotation, pivot and translation; without a rotation the axis is ignored.
bool same_motion(const RigidMotion& a, const RigidMotion& b);

/// The default pivot of bodies: the centre of the bounding box of the moving nodes. A component
/// that consists only of rounding errors is set to 0.
Vec3 body_centre(const Box<3>& box);
/// The bounding box of nodes; for plane coordinates in the plane z = 0.
Box<3> body_box(const Coordinates& x, std::span<const Index> nodes);

}  // namespace winslow
