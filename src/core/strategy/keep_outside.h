#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "core/options/option.h"

/// Nothing moves farther than 2 from what a command moves:
///
///     winslow::MoveCommand move;
///     move.smooth.keep_outside.radius = 2;
namespace winslow {

/// A circle (in space a sphere), a box, or both, outside which nothing moves but the boundary that
/// a motion takes. Places are those of the mesh that a command is given, before anything moves; in
/// space they have a third component.
struct KeepOutside {
  /// Of the circle, in units of the mesh. None: no circle.
  std::optional<double> radius = std::nullopt;
  /// Of the circle. None: the centre of the bounding box of all that moves, or of the walls that
  /// get layers.
  std::optional<GivenVector> centre = std::nullopt;
  /// Opposite corners of the box, in any order. Both or none.
  std::optional<GivenVector> corner = std::nullopt;
  std::optional<GivenVector> opposite = std::nullopt;

  bool given() const { return radius || corner || opposite; }
  bool operator==(const KeepOutside&) const = default;
};

OptionTable option_table(KeepOutside& keep);

/// Throws UsageError for a box with one corner, or a centre without a radius.
void validate(const KeepOutside& keep);
/// The same, and for places that have not as many components as points of the mesh (2 or 3).
void validate(const KeepOutside& keep, int dimension);

/// The same region, of a mesh in that frame.
KeepOutside to_local(KeepOutside keep, const LocalFrame& frame);

/// The region itself: both the circle and the box, where both are given; everything, where neither
/// is.
class FreeRegion {
 public:
  /// x: the mesh that the region is about, in the plane or in space. about: nodes in the middle of
  /// whose bounding box a circle without a centre stands. Throws as validate(), and for such a
  /// circle about no nodes.
  FreeRegion(const KeepOutside& keep, const Coordinates& x, std::span<const Index> about);

  bool holds(const Vec3& point) const;
  bool holds(const Vec2& point) const { return holds(Vec3(point.x(), point.y(), 0)); }

 private:
  std::optional<double> radius_;
  Vec3 centre_{0, 0, 0};
  bool box_ = false;
  Vec3 low_{0, 0, 0}, high_{0, 0, 0};
};

/// The interior nodes outside a region, ascending: those that a command keeps where they are.
/// Throws UsageError where no interior node lies inside.
std::vector<Index> nodes_outside(const FreeRegion& region, const Topology& topology,
                                 const Coordinates& x);

/// Of a motion of these nodes, or of smoothing in place (none); no nodes if no region is given.
/// Throws UsageError also where nodes of the motion lie outside.
std::vector<Index> nodes_kept_outside(const KeepOutside& keep, const Topology& topology,
                                      const Coordinates& x, std::span<const Index> moving);

}  // namespace winslow
