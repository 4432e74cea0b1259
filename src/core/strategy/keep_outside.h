#pragma once

#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "core/options/option.h"

/// Nothing moves outside a circle of radius 2 around the moving nodes:
///
///     winslow::MoveCommand move;
///     move.smooth.keep_outside.radius = 2;
namespace winslow {

/// A circle (in space a sphere), a box, or both. Outside, only the boundary nodes of a motion move.
/// Positions refer to the mesh as given to the command; in space they have a third component.
struct KeepOutside {
  /// Radius of the circle, in units of the mesh. None: no circle.
  std::optional<double> radius = std::nullopt;
  /// Centre of the circle. None: the centre of the bounding box of the moving nodes, or of the
  /// walls that get layers.
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
/// The same; also throws for positions with another number of components than `dimension` (2 or 3).
void validate(const KeepOutside& keep, int dimension);

/// The same region in the coordinates of the frame.
KeepOutside to_local(KeepOutside keep, const LocalFrame& frame);

/// The region in which nodes may move: the intersection of circle and box if both are given;
/// everything if neither is.
class FreeRegion {
 public:
  /// x: the mesh, in the plane or in space. about: nodes; a circle without a centre is centred on
  /// their bounding box. Throws as validate(), and for such a circle without nodes.
  FreeRegion(const KeepOutside& keep, const Coordinates& x, std::span<const Index> about);

  bool holds(const Vec3& point) const;
  bool holds(const Vec2& point) const { return holds(Vec3(point.x(), point.y(), 0)); }

 private:
  std::optional<double> radius_;
  Vec3 centre_{0, 0, 0};
  bool box_ = false;
  Vec3 low_{0, 0, 0}, high_{0, 0, 0};
};

/// The interior nodes outside a region, ascending: a command fixes them. Throws UsageError if no
/// interior node lies inside.
std::vector<Index> nodes_outside(const FreeRegion& region, const Topology& topology,
                                 const Coordinates& x);

/// The same for a motion of the nodes `moving`, or for smoothing in place (no nodes); empty if no
/// region is given. Throws UsageError also if nodes of the motion lie outside.
std::vector<Index> nodes_kept_outside(const KeepOutside& keep, const Topology& topology,
                                      const Coordinates& x, std::span<const Index> moving);

}  // namespace winslow
