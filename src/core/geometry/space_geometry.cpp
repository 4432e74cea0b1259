#include "core/geometry/space_geometry.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/parallel/parallel_for.h"

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
  const Slider& slider = sliders_[at(numbers_.of(node))];
  const Piece& piece = pieces_[at(slider.piece)];
  return piece.surface ? on_surface(*piece.surface, slider.direction, point)
                       : on_curve(*piece.curve, point);
}

void SpaceGeometry::add(std::shared_ptr<const Surface> surface, std::span<const Index> nodes,
                        const SpacePoints& x) {
  constexpr Index block = 512;  // a search in a triangulation each
  const std::size_t first = sliders_.size();
  sliders_.resize(first + nodes.size(), {static_cast<Index>(pieces_.size()), Vec3::Zero()});
  const auto find = [&](Index begin, Index end) {
    for (std::size_t i = at(begin); i < at(end); ++i)
      sliders_[first + i].direction = surface->nearest(x[nodes[i]]).normal.unitOrthogonal();
  };
  parallel_for(0, static_cast<Index>(nodes.size()), find, block);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    numbers_.set(nodes[i], static_cast<Index>(first + i));
  pieces_.push_back({std::move(surface), nullptr});
}

void SpaceGeometry::add(std::shared_ptr<const SpaceCurve> curve, std::span<const Index> nodes) {
  for (const Index node : nodes) {
    numbers_.set(node, static_cast<Index>(sliders_.size()));
    sliders_.push_back({static_cast<Index>(pieces_.size()), Vec3::Zero()});
  }
  pieces_.push_back({nullptr, std::move(curve)});
}

}  // namespace winslow
