#include "core/geometry/space_geometry.h"

#include <Eigen/Geometry>
#include <utility>

namespace winslow {

namespace {

Foot on_curve(const SpaceCurve& curve, const Vec3& point) {
  const CurvePoint<3> place = curve.nearest(point);
  Foot foot;
  foot.point = place.point;
  foot.frame.add(place.tangent);
  foot.bend[0] = place.curvature;
  return foot;
}

/// direction: along which the first of the frame points, as far as the surface lets it, so that
/// frames of places near one another are near one another.
Foot on_surface(const Surface& surface, const Vec3& direction, const Vec3& point) {
  const SurfacePoint place = surface.nearest(point);
  const Vec3& n = place.normal;
  Vec3 first = direction - direction.dot(n) * n;
  constexpr double least = 0.1;
  first = first.norm() > least ? Vec3(first.normalized()) : n.unitOrthogonal();
  const Vec3 second = n.cross(first);
  Foot foot;
  foot.point = place.point;
  foot.frame.add(first);
  foot.frame.add(second);
  foot.bend = {first.dot(place.form * first) * n, first.dot(place.form * second) * n,
               second.dot(place.form * second) * n};
  return foot;
}

}  // namespace

Foot SpaceGeometry::foot(Index node, const Vec3& point) const {
  const Piece& piece = pieces_[at(parts_.of(node))];
  return piece.surface ? on_surface(*piece.surface, directions_.at(node), point)
                       : on_curve(*piece.curve, point);
}

void SpaceGeometry::add(std::shared_ptr<const Surface> surface, std::span<const Index> nodes,
                        const SpacePoints& x) {
  for (const Index node : nodes) {
    parts_.set(node, static_cast<Index>(pieces_.size()));
    directions_[node] = surface->nearest(x[node]).normal.unitOrthogonal();
  }
  pieces_.push_back({std::move(surface), nullptr});
}

void SpaceGeometry::add(std::shared_ptr<const SpaceCurve> curve, std::span<const Index> nodes) {
  for (const Index node : nodes) parts_.set(node, static_cast<Index>(pieces_.size()));
  pieces_.push_back({nullptr, std::move(curve)});
}

}  // namespace winslow
