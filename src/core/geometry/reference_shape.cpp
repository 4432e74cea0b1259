#include "core/geometry/reference_shape.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/search/segment_distance.h"

namespace winslow {

std::shared_ptr<const ReferenceSurface> moved_to(const ReferenceSurface& surface,
                                                 const Vec3& origin) {
  auto moved = std::make_shared<ReferenceSurface>(surface);
  for (Vec3& point : moved->points) point -= origin;
  return moved;
}

namespace {

/// Several surfaces as one: at each place the one whose triangles are nearest there. Planes,
/// cylinders and spheres end at their faces.
class JoinedSurface final : public Surface {
 public:
  JoinedSurface(Triangulation triangles, std::vector<std::shared_ptr<const Surface>> of_triangles,
                std::string description)
      : triangles_(std::move(triangles)),
        tree_(triangles_),
        of_triangles_(std::move(of_triangles)),
        description_(std::move(description)) {}

  SurfacePoint nearest(const Vec3& point) const override {
    return of_triangles_[at(tree_.nearest(triangles_, point).triangle)]->nearest(point);
  }
  std::string description() const override { return description_; }

 private:
  Triangulation triangles_;
  TriangleTree tree_;
  std::vector<std::shared_ptr<const Surface>> of_triangles_;
  std::string description_;
};

}  // namespace

ReferenceShape::ReferenceShape(const ReferenceSurface& given, double angle)
    : source_(given.source) {
  if (given.faces.empty()) throw UsageError(given.source + ": no faces to slide on");
  Coordinates coordinates(3, static_cast<Index>(given.points.size()));
  for (std::size_t i = 0; i < given.points.size(); ++i)
    coordinates.set_xyz(static_cast<Index>(i), given.points[i]);
  const SpacePoints x(coordinates);
  for (const Face& face : given.faces) faces_.push_back({face, -1, -1, -1});
  features_ = find_features(coordinates, faces_, angle);
  curves_ = curves_along(x, features_);
  for (Index k = 0; k < line_count(); ++k) add_line(k, features_.lines[at(k)], x);
  first_segment_.push_back(segments_.size());
  std::vector<Box<3>> boxes;
  for (const Segment& segment : segments_) {
    Box<3> box{segment.a, segment.a};
    box.add(segment.b);
    boxes.push_back(box);
  }
  segment_tree_ = BoxTree<3>(boxes);
  for (std::size_t i = 0; i < features_.nodes.size(); ++i)
    if (features_.nodes[i] == SurfaceNode::corner) corners_.push_back(given.points[i]);
  triangles_.points = given.points;
  const auto regions = faces_of_regions(features_);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    surfaces_.push_back(surface_over(x, faces_, regions[r], curves_));
    const std::vector<Index> nodes = nodes_of_faces(faces_, regions[r]);
    regions_.push_back(triangulated(x, faces_, regions[r], nodes));
    region_trees_.emplace_back(regions_.back());
    for (const auto& [a, b, c] : regions_.back().triangles) {
      triangles_.triangles.push_back({nodes[at(a)], nodes[at(b)], nodes[at(c)]});
      region_of_triangle_.push_back(static_cast<Index>(r));
    }
  }
  tree_ = TriangleTree(triangles_);
}

void ReferenceShape::add_line(Index line, const Chain& chain, const SpacePoints& x) {
  first_segment_.push_back(segments_.size());
  double length = 0;
  const std::size_t count = chain.nodes.size();
  for (std::size_t i = 0; i + (chain.closed ? 0 : 1) < count; ++i) {
    segments_.push_back({x[chain.nodes[i]], x[chain.nodes[(i + 1) % count]], line});
    length += (segments_.back().b - segments_.back().a).norm();
  }
  lengths_.push_back(length);
}

std::optional<ReferenceShape::LinePlace> ReferenceShape::nearest_line(const Vec3& point,
                                                                      double reach) const {
  const auto distance = [&](Index k) {
    return segment_distance<3>(point, segments_[at(k)].a, segments_[at(k)].b);
  };
  const auto found = segment_tree_.nearest(point, reach, distance);
  if (!found) return std::nullopt;
  const Segment& segment = segments_[at(found->item)];
  return LinePlace{segment.line, found->distance, (segment.b - segment.a).normalized()};
}

double ReferenceShape::distance_to_line(Index line, const Vec3& point) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = first_segment_[at(line)]; k < first_segment_[at(line) + 1]; ++k)
    least = std::min(least, segment_distance<3>(point, segments_[k].a, segments_[k].b));
  return least;
}

ReferenceShape::SurfacePlace ReferenceShape::nearest_region(const Vec3& point) const {
  const TrianglePlace place = tree_.nearest(triangles_, point);
  return {region_of_triangle_[at(place.triangle)], (point_at(triangles_, place) - point).norm()};
}

double ReferenceShape::distance_to_region(Index region, const Vec3& point) const {
  const Triangulation& triangles = regions_[at(region)];
  return (point_at(triangles, region_trees_[at(region)].nearest(triangles, point)) - point).norm();
}

std::shared_ptr<const Surface> ReferenceShape::surface(const std::vector<Index>& regions) const {
  if (regions.size() == 1) return surfaces_[at(regions.front())];
  Triangulation part;
  part.points = triangles_.points;
  std::vector<std::shared_ptr<const Surface>> of_triangles;
  for (std::size_t t = 0; t < triangles_.triangles.size(); ++t) {
    const Index region = region_of_triangle_[t];
    if (!std::ranges::binary_search(regions, region)) continue;
    part.triangles.push_back(triangles_.triangles[t]);
    of_triangles.push_back(surfaces_[at(region)]);
  }
  return std::make_shared<JoinedSurface>(std::move(part), std::move(of_triangles),
                                         std::to_string(regions.size()) + " surfaces");
}

}  // namespace winslow
