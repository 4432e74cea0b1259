#pragma once

#include "core/command/command.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/strategy/run.h"

/// Markers select whole bodies:
///
///     winslow::DragGrip grip;
///     grip.markers = {"flap"};
namespace winslow {

/// What the mouse holds: whole bodies, which move rigidly, or a part of their boundary, where each
/// node moves by a share of the translation (shape editing).
struct DragGrip {
  std::vector<std::string> markers;  ///< that may move; all other boundary nodes are fixed
  std::vector<Index> nodes;          ///< held nodes, on the markers; empty: all, as a rigid body
  std::vector<double> shares;        ///< of the translation, in [0, 1], one per node of `nodes`

  bool rigid() const { return nodes.empty(); }
};

/// The motion of a grip from a state's rest coordinates. Throws UsageError for unknown markers,
/// nodes of other markers, a wrong number or range of shares, a rotation of a part that is not
/// rigid, or a motion that a mesh of this dimension does not have.
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const DragGrip& grip, const RigidMotion& motion);

/// The command that applies the result of a drag to the mesh. motion: resolved.
Command drag_command(const DragGrip& grip, const RigidMotion& motion, const MotionOptions& how,
                     const SmoothOptions& smooth);

/// The motion from `from` to `to`: compose(inverse(from), to) for a body, the difference of the
/// translations for a part.
RigidMotion motion_between(const DragGrip& grip, const RigidMotion& from, const RigidMotion& to);

/// The motion that maps `nodes` as near as possible to their positions in `x` (least squares).
/// shares: as of the grip; empty: rigid.
RigidMotion fit_motion(std::span<const Index> nodes, std::span<const double> shares,
                       const Coordinates& rest, const Coordinates& x);

/// The nodes of the bodies of a grip; those with a share stand on what lies under them.
BodyNodes body_nodes(const Topology& topology, const DragGrip& grip);

/// The motion of a grip nearest to `motion` that keeps its nodes on what they stand on: without the
/// part of the translation across it, without the rotation if that is not enough, and none at all
/// if that is not enough either. footholds: straight lines, circles, planes, cylinders and spheres.
/// motion: resolved.
RigidMotion along_footholds(const Mesh& mesh, const DragGrip& grip,
                            std::span<const Foothold> footholds, const RigidMotion& motion);

/// 1 - t^2 (3 - 2t) with t = distance / radius: from 1 to 0, with continuous slope; 0 beyond the
/// radius.
double faded_share(double distance, double radius);

/// Shares that fade from 1 on the arc `first` .. `last` of a closed boundary loop to 0 at
/// `radius` beyond its ends, measured along the loop, as faded_share().
/// loop: nodes in order. first, last: positions in it; the arc goes forward from first to last.
/// radius >= 0, in units of the mesh. Nodes without a share are left out.
struct FadedArc {
  std::vector<Index> nodes;
  std::vector<double> shares;
};
FadedArc faded_arc(const std::vector<Index>& loop, const Coordinates& x, std::size_t first,
                   std::size_t last, double radius);

/// A dragged part of a surface: its nodes, ascending, and each node's share of the translation.
struct FadedPatch {
  std::vector<Index> nodes;
  std::vector<double> shares;
};

/// Shares that fade from 1 at the held nodes to 0 at `radius` from them, as faded_share().
/// Distances are measured along the surface, so the opposite side of a thin body is as far away as
/// the path around its edge. They are computed by fast marching over the triangles (R. Kimmel and
/// J. A. Sethian, PNAS 95, 1998), each unfolded into the plane; a quadrilateral has four corner
/// triangles, and a face with more corners those about each of them. faces: of the surface. held:
/// nodes off the surface are left out. radius >= 0, in units of the mesh. Nodes without a share are
/// left out.
FadedPatch faded_patch(std::span<const Face> faces, const Coordinates& x,
                       std::span<const Index> held, double radius);

}  // namespace winslow
