#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/geometry/boundary_kinds.h"
#include "core/geometry/curve.h"
#include "core/geometry/surface/recognised_surface.h"
#include "core/geometry/surface_features.h"

namespace winslow {

namespace {

/// Surfaces and curves of space, and which of them each node slides on.
class SpaceGeometry final : public SlidingGeometry {
 public:
  Foot foot(Index node, const Vec3& point) const override {
    const Piece& piece = pieces_[at(parts_.of(node))];
    return piece.surface ? on_surface(*piece.surface, directions_.at(node), point)
                         : on_curve(*piece.curve, point);
  }

  void add(std::unique_ptr<const Surface> surface, std::span<const Index> nodes,
           const SpacePoints& x) {
    for (const Index node : nodes) {
      parts_.set(node, static_cast<Index>(pieces_.size()));
      const Vec3 first = surface->nearest(x[node]).normal.unitOrthogonal();
      directions_[node] = first;
    }
    pieces_.push_back({std::move(surface), nullptr});
  }
  void add(std::unique_ptr<const SpaceCurve> curve, std::span<const Index> nodes) {
    for (const Index node : nodes) parts_.set(node, static_cast<Index>(pieces_.size()));
    pieces_.push_back({nullptr, std::move(curve)});
  }

 private:
  struct Piece {
    std::unique_ptr<const Surface> surface;
    std::unique_ptr<const SpaceCurve> curve;
  };

  static Foot on_curve(const SpaceCurve& curve, const Vec3& point) {
    const CurvePoint<3> place = curve.nearest(point);
    Foot foot;
    foot.point = place.point;
    foot.frame.add(place.tangent);
    foot.bend[0] = place.curvature;
    return foot;
  }

  /// direction: along which the first of the frame points, as far as the surface lets it, so that
  /// frames of places near one another are near one another.
  static Foot on_surface(const Surface& surface, const Vec3& direction, const Vec3& point) {
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

  std::vector<Piece> pieces_;
  NodeParts parts_;
  std::map<Index, Vec3> directions_;
};

/// The faces of sliding markers, and what their nodes slide on.
class SurfaceFinder {
 public:
  SurfaceFinder(const Topology& topology, const Coordinates& x, std::span<const Index> markers,
                double feature_angle)
      : topology_(topology), x_(x), stays_(at(topology.node_count()), 0) {
    const bool surface = topology.cell_dimension() == 2;
    for (const SurfaceFace& face : boundary_faces(topology)) {
      if (surface || std::ranges::find(markers, face.marker) != markers.end())
        faces_.push_back(face);
      else
        for (const Index node : face.nodes) stays_[at(node)] = 1;
    }
    features_ = find_features(x, faces_, feature_angle);
  }

  SlidingBoundary boundary(bool features) {
    find_curves();
    find_surfaces();
    if (features) add_curves();
    out_.geometry = geometry_;
    return std::move(out_);
  }

 private:
  std::string name_of(Index marker) const {
    return marker < 0 ? std::string("surface") : topology_.markers()[at(marker)].name;
  }

  void find_curves() {
    tangents_.assign(at(topology_.node_count()), Vec3(0, 0, 0));
    for (const Chain& line : features_.lines) {
      std::vector<Vec3> points;
      for (const Index node : line.nodes) points.push_back(x_[node]);
      constexpr std::size_t least_of_a_loop = 4;
      if (points.size() < 2 || (line.loop() && points.size() < least_of_a_loop)) {
        curves_.push_back(nullptr);
        continue;
      }
      curves_.push_back(curve_through(points, line.closed));
      for (const Index node : line.nodes)
        if (features_.nodes[at(node)] == SurfaceNode::line)
          tangents_[at(node)] = curves_.back()->nearest(x_[node]).tangent;
    }
  }

  /// A marker of a face at each line.
  void add_curves() {
    std::map<Index, Index> marker_at;
    for (const SurfaceFace& face : faces_)
      for (const Index node : face.nodes) {
        const auto [place, is_new] = marker_at.try_emplace(node, face.marker);
        if (!is_new) place->second = std::min(place->second, face.marker);
      }
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      if (!curves_[k]) continue;
      std::vector<Index> nodes;
      for (const Index node : features_.lines[k].nodes)
        if (features_.nodes[at(node)] == SurfaceNode::line && stays_[at(node)] == 0)
          nodes.push_back(node);
      if (nodes.empty()) continue;
      std::string what = curves_[k]->description();
      what = what == "straight line" ? "straight edge" : "edge, " + what;
      geometry_->add(std::move(curves_[k]), nodes);
      out_.parts.push_back({name_of(marker_at.at(nodes.front())), what, nodes});
    }
  }

  void find_surfaces() {
    std::vector<std::vector<Index>> regions(at(features_.regions));
    for (std::size_t f = 0; f < faces_.size(); ++f)
      regions[at(features_.region[f])].push_back(static_cast<Index>(f));
    for (const std::vector<Index>& region : regions) add_region(region);
  }

  void add_region(std::span<const Index> region) {
    std::vector<Index> nodes;
    for (const Index f : region)
      nodes.insert(nodes.end(), faces_[at(f)].nodes.begin(), faces_[at(f)].nodes.end());
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::vector<Index> inside;
    for (const Index node : nodes)
      if (features_.nodes[at(node)] == SurfaceNode::inside && stays_[at(node)] == 0)
        inside.push_back(node);
    if (inside.empty()) return;

    Triangulation surface;
    std::vector<Vec3> tangents;
    for (const Index node : nodes) {
      surface.points.push_back(x_[node]);
      tangents.push_back(tangents_[at(node)]);
    }
    const auto number = [&](Index node) {
      return static_cast<Index>(std::ranges::lower_bound(nodes, node) - nodes.begin());
    };
    for (const Index f : region) {
      std::vector<Index> corners;
      for (const Index node : faces_[at(f)].nodes) corners.push_back(number(node));
      add_triangles(corners, surface);
    }
    auto through = surface_through(std::move(surface), tangents);
    out_.parts.push_back(
        {name_of(faces_[at(region.front())].marker), through->description(), inside});
    geometry_->add(std::move(through), inside, x_);
  }

  /// Quadrilaterals are cut along their shorter diagonal.
  static void add_triangles(std::span<const Index> corners, Triangulation& surface) {
    const Index a = corners[0], b = corners[1], c = corners[2];
    if (corners.size() == 3) {
      surface.triangles.push_back({a, b, c});
      return;
    }
    const Index d = corners[3];
    const auto& p = surface.points;
    if ((p[at(c)] - p[at(a)]).squaredNorm() <= (p[at(d)] - p[at(b)]).squaredNorm()) {
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    } else {
      surface.triangles.push_back({a, b, d});
      surface.triangles.push_back({b, c, d});
    }
  }

  const Topology& topology_;
  SpacePoints x_;
  std::vector<SurfaceFace> faces_;
  std::vector<unsigned char> stays_;  // nodes of the boundary that does not slide
  SurfaceFeatures features_;
  std::vector<std::unique_ptr<const SpaceCurve>> curves_;  // one per feature line; null: none
  std::vector<Vec3> tangents_;                             // of the lines, at their nodes
  std::shared_ptr<SpaceGeometry> geometry_ = std::make_shared<SpaceGeometry>();
  SlidingBoundary out_;
};

}  // namespace

SlidingBoundary sliding_on_surfaces(const Topology& topology, const Coordinates& x,
                                    std::span<const Index> markers, double feature_angle,
                                    bool features) {
  return SurfaceFinder(topology, x, markers, feature_angle).boundary(features);
}

}  // namespace winslow
