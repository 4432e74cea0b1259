#include "core/geometry/reference_shape.h"

#include <utility>

#include "core/error.h"
#include "core/search/box_tree.h"

namespace winslow {

std::shared_ptr<const ReferenceSurface> moved_to(const ReferenceSurface& surface,
                                                 const Vec3& origin) {
  auto moved = std::make_shared<ReferenceSurface>(surface);
  for (Vec3& point : moved->points) point -= origin;
  return moved;
}

namespace {

/// Several surfaces as one: for each point the surface with the nearest triangle.
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

/// A curve with straight continuations at ends where its feature line fades out.
class FadingCurve final : public SpaceCurve {
 public:
  FadingCurve(std::shared_ptr<const SpaceCurve> curve,
              const std::array<ReferenceShape::LineEnd, 2>& ends)
      : curve_(std::move(curve)),
        begin_(curve_->nearest(ends[0].point)),
        end_(curve_->nearest(ends[1].point)),
        length_(curve_->arc_of(ends[1].point)),
        goes_on_{ends[0].fades_out, ends[1].fades_out} {}

  CurvePoint<3> nearest(const Vec3& point) const override {
    const double arc = beyond(point);
    return arc == 0 ? curve_->nearest(point) : at_arc(arc < 0 ? arc : length_ + arc);
  }
  double arc_of(const Vec3& point) const override {
    const double arc = beyond(point);
    return arc < 0 ? arc : arc > 0 ? length_ + arc : curve_->arc_of(point);
  }
  CurvePoint<3> at_arc(double arc) const override {
    if (arc < 0 && goes_on_[0])
      return {begin_.point + arc * begin_.tangent, begin_.tangent, Vec3::Zero()};
    if (arc > length_ && goes_on_[1])
      return {end_.point + (arc - length_) * end_.tangent, end_.tangent, Vec3::Zero()};
    return curve_->at_arc(arc);
  }
  double period() const override { return 0; }
  std::string description() const override { return curve_->description(); }

 private:
  /// Length along a continuation to the foot of a point: negative before the start, positive behind
  /// the end, 0 if the foot is on the curve.
  double beyond(const Vec3& point) const {
    const double before = (point - begin_.point).dot(begin_.tangent);
    const double behind = (point - end_.point).dot(end_.tangent);
    const double on_curve = (curve_->nearest(point).point - point).squaredNorm();
    const auto nearer = [&](const CurvePoint<3>& from, double arc) {
      return (from.point + arc * from.tangent - point).squaredNorm() < on_curve;
    };
    if (goes_on_[0] && before < 0 && nearer(begin_, before)) return before;
    if (goes_on_[1] && behind > 0 && nearer(end_, behind)) return behind;
    return 0;
  }

  std::shared_ptr<const SpaceCurve> curve_;
  CurvePoint<3> begin_, end_;
  double length_;
  std::array<bool, 2> goes_on_;
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
  for (const Chain& line : features_.lines)
    if (!line.closed)
      for (const Index end : {line.nodes.front(), line.nodes.back()}) ++lines_at_[end];
  for (std::size_t i = 0; i < features_.nodes.size(); ++i) {
    const auto lines = lines_at_.find(static_cast<Index>(i));
    const bool fades_out = lines != lines_at_.end() && lines->second == 1;
    if (features_.nodes[i] == SurfaceNode::corner && !fades_out)
      corners_.push_back(given.points[i]);
  }
  triangles_.points = given.points;
  for (Index k = 0; k < line_count(); ++k) let_fade(k);
  const auto& regions = features_.regions;
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

void ReferenceShape::let_fade(Index line) {
  auto& curve = curves_.curves[at(line)];
  if (!curve || closed(line)) return;
  const std::array<LineEnd, 2> ends = this->ends(line);
  if (ends[0].fades_out || ends[1].fades_out) curve = std::make_shared<FadingCurve>(curve, ends);
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

std::vector<Index> ReferenceShape::lines_about(const Vec3& point, double reach) const {
  std::vector<Index> lines;
  const Vec3 around = Vec3::Constant(reach);
  segment_tree_.overlapping({point - around, point + around},
                            [&](Index k) { lines.push_back(segments_[at(k)].line); });
  sort_unique(lines);
  return lines;
}

ReferenceShape::LineFoot ReferenceShape::foot_on_line(Index line, const Vec3& point) const {
  LineFoot nearest{point, std::numeric_limits<double>::infinity(), 0};
  double arc = 0;
  for (std::size_t k = first_segment_[at(line)]; k < first_segment_[at(line) + 1]; ++k) {
    const Vec3 along = segments_[k].b - segments_[k].a;
    const double length = along.norm();
    const double t =
        length > 0 ? std::clamp((point - segments_[k].a).dot(along) / length, 0.0, length) : 0.0;
    const Vec3 foot = length > 0 ? Vec3(segments_[k].a + t / length * along) : segments_[k].a;
    const double distance = (point - foot).norm();
    if (distance < nearest.distance) nearest = {foot, distance, arc + t};
    arc += length;
  }
  return nearest;
}

std::array<ReferenceShape::LineEnd, 2> ReferenceShape::ends(Index line) const {
  const Chain& chain = features_.lines[at(line)];
  const auto end = [&](Index node) {
    return LineEnd{triangles_.points[at(node)], lines_at_.at(node) == 1};
  };
  return {end(chain.nodes.front()), end(chain.nodes.back())};
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

ReferenceLines::ReferenceLines(const SpacePoints& x, std::span<const SurfaceFace> faces,
                               const SurfaceEdges& edges, Index node_count,
                               const ReferenceShape& shape, double angle)
    : x_(x),
      edges_(edges),
      shape_(shape),
      shortest_(at(node_count), std::numeric_limits<double>::infinity()),
      edges_at_(at(node_count)),
      lines_(edges.nodes.size(), -1),
      found_(at(shape.line_count()), 0.0) {
  const auto sharp = feature_edges(x_, faces, edges, angle);
  const auto less_sharp = feature_edges(x_, faces, edges, angle / 2);
  for (std::size_t k = 0; k < edges.nodes.size(); ++k) {
    turns_.push_back(sharp[k] != 0 ? 1.0 : less_sharp[k] != 0 ? 0.5 : 0.0);
    for (const Index node : edges.nodes[k]) {
      edges_at_[at(node)].push_back(static_cast<Index>(k));
      double& shortest = shortest_[at(node)];
      shortest = std::min(shortest, length(static_cast<Index>(k)));
    }
  }
  find_edges();
  find_chains();
  find_corners();
}

double ReferenceLines::length(Index edge) const {
  const auto [a, b] = edges_.nodes[at(edge)];
  return (x_[b] - x_[a]).norm();
}

Index ReferenceLines::line_along(Index edge, double share) const {
  const auto [a, b] = edges_.nodes[at(edge)];
  const double reach = share * std::min(shortest_[at(a)], shortest_[at(b)]);
  const auto place = shape_.nearest_line(0.5 * (x_[a] + x_[b]), reach);
  constexpr double along = 0.8;
  if (!place || std::abs(place->tangent.dot((x_[b] - x_[a]).normalized())) < along) return -1;
  for (const Index node : {a, b})
    if (shape_.foot_on_line(place->line, x_[node]).distance > reach) return -1;
  return place->line;
}

void ReferenceLines::find_edges() {
  constexpr double near = 0.3, less_near = 0.7, most = 0.5;
  const auto count = static_cast<Index>(lines_.size());
  for (Index k = 0; k < count; ++k) {
    lines_[at(k)] = line_along(k, near);
    if (lines_[at(k)] >= 0) found_[at(lines_[at(k)])] += length(k);
  }
  std::vector<double> also(found_.size(), 0.0);
  for (Index k = 0; k < count; ++k) {
    if (lines_[at(k)] >= 0 || turns_[at(k)] < 1) continue;
    const Index line = line_along(k, less_near);
    if (line < 0 || found_[at(line)] >= most * shape_.length(line)) continue;
    lines_[at(k)] = line;
    also[at(line)] += length(k);
  }
  for (std::size_t k = 0; k < also.size(); ++k) found_[k] += also[k];
}

void ReferenceLines::find_chains() {
  std::vector<std::vector<Index>> edges_about(found_.size());
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const auto [a, b] = edges_.nodes[k];
    for (const Index line : shape_.lines_about(x_[a], shortest_[at(a)]))
      edges_about[at(line)].push_back(static_cast<Index>(k));
  }
  std::vector<Index> order;
  for (Index line = 0; line < shape_.line_count(); ++line) {
    constexpr double all = 0.95;
    if (!shape_.closed(line) && found_[at(line)] < all * shape_.length(line)) order.push_back(line);
  }
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](Index line) { return shape_.length(line); });
  for (const Index line : order) {
    const std::vector<Step> chain = best_chain(steps_along(line, edges_about[at(line)]));
    constexpr double most = 0.5;
    if (chain.size() < 2) continue;
    const double covered = chain.back().end - chain.front().begin;
    if (covered <= found_[at(line)] || covered < most * shape_.length(line)) continue;
    std::ranges::replace(lines_, line, -1);
    for (const Step& step : chain) lines_[at(step.edge)] = line;
    found_[at(line)] = covered;
  }
}

std::vector<ReferenceLines::Step> ReferenceLines::steps_along(Index line,
                                                              std::span<const Index> edges) const {
  std::vector<Step> steps;
  for (const Index edge : edges) {
    if (lines_[at(edge)] >= 0 && lines_[at(edge)] != line) continue;
    auto [from, to] = edges_.nodes[at(edge)];
    auto begin = shape_.foot_on_line(line, x_[from]), end = shape_.foot_on_line(line, x_[to]);
    if (begin.arc > end.arc) {
      std::swap(from, to);
      std::swap(begin, end);
    }
    constexpr double along = 0.7, near = 0.5, less_near = 1;
    const double off_begin = begin.distance / shortest_[at(from)];
    const double off_end = end.distance / shortest_[at(to)];
    const double reach = turns_[at(edge)] > 0 ? less_near : near;
    if (std::max(off_begin, off_end) > reach || end.arc - begin.arc < along * length(edge))
      continue;
    // Chains meet only at the ends of their lines.
    const double margin = length(edge) / 2;
    const auto passes = [&](Index node, double arc) {
      return arc < margin || arc > shape_.length(line) - margin || !meets_other_line(node, line);
    };
    if (!passes(from, begin.arc) || !passes(to, end.arc)) continue;
    const double off = (off_begin + off_end) / 2;
    steps.push_back({edge, from, to, begin.arc, end.arc,
                     (end.arc - begin.arc) * (1 - off * off) * (1 + turns_[at(edge)])});
  }
  std::ranges::stable_sort(steps, {}, &Step::begin);
  return steps;
}

std::vector<ReferenceLines::Step> ReferenceLines::best_chain(std::span<const Step> steps) const {
  std::map<Index, std::vector<std::size_t>> ending_at;  // node: steps
  std::vector<double> worth;                            // of the best chain that ends with a step
  std::vector<std::optional<std::size_t>> before;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    double most = 0;
    before.emplace_back();
    for (const std::size_t other : ending_at[steps[k].from])
      // A line has no two edges of one face.
      if (worth[other] > most && !share_face(steps[k].edge, steps[other].edge)) {
        most = worth[other];
        before.back() = other;
      }
    worth.push_back(most + steps[k].worth);
    ending_at[steps[k].to].push_back(k);
  }
  std::vector<Step> chain;
  if (steps.empty()) return chain;
  std::optional<std::size_t> step =
      static_cast<std::size_t>(std::ranges::max_element(worth) - worth.begin());
  for (; step; step = before[*step]) chain.push_back(steps[*step]);
  std::ranges::reverse(chain);
  return chain;
}

bool ReferenceLines::meets_other_line(Index node, Index line) const {
  return std::ranges::any_of(edges_at_[at(node)], [&](Index edge) {
    return lines_[at(edge)] >= 0 && lines_[at(edge)] != line;
  });
}

bool ReferenceLines::share_face(Index edge, Index other) const {
  const auto of_other = edges_.faces[other];
  return std::ranges::any_of(edges_.faces[edge], [&](Index face) {
    return std::ranges::find(of_other, face) != of_other.end();
  });
}

void ReferenceLines::find_corners() {
  std::map<Index, std::map<Index, int>> nodes_of;  // line: nodes, edges along it at each
  for (std::size_t k = 0; k < lines_.size(); ++k)
    if (lines_[k] >= 0)
      for (const Index node : edges_.nodes[k]) ++nodes_of[lines_[k]][node];
  struct Claim {
    double distance;
    Index node;
    Vec3 corner;
  };
  std::vector<Claim> claims;
  for (const auto& [line, nodes] : nodes_of)
    for (const auto& [node, count] : nodes) {
      if (count != 1 || shape_.closed(line)) continue;
      const double arc = shape_.foot_on_line(line, x_[node]).arc;
      const bool first = arc < shape_.length(line) / 2;
      const double left = first ? arc : shape_.length(line) - arc;
      const auto [end, fades_out] = shape_.ends(line)[first ? 0 : 1];
      const double distance = (x_[node] - end).norm(), reach = mean_length(node);
      if (fades_out) {
        constexpr double near = 0.3;
        if (distance > near * shortest_[at(node)]) fading_.insert(node);
      } else if (left <= reach && distance <= reach) {
        claims.push_back({distance, node, end});
      }
    }
  std::ranges::stable_sort(claims, {}, &Claim::distance);
  std::vector<Vec3> assigned;
  for (const Claim& claim : claims) {
    if (std::ranges::find(assigned, claim.corner) != assigned.end()) continue;
    if (corners_.try_emplace(claim.node, claim.corner).second) assigned.push_back(claim.corner);
  }
  constexpr double near = 0.5;
  std::erase_if(corners_, [&](const auto& corner) {
    const auto& [node, place] = corner;
    return (x_[node] - place).norm() <= near * mean_length(node);
  });
}

double ReferenceLines::mean_length(Index node) const {
  double sum = 0;
  for (const Index edge : edges_at_[at(node)]) sum += length(edge);
  return sum / static_cast<double>(edges_at_[at(node)].size());
}

}  // namespace winslow
