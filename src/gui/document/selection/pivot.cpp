#include "gui/document/selection/pivot.h"

#include <Eigen/Geometry>
#include <utility>

#include "core/motion/rigid_motion.h"

namespace winslow::gui {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  std::vector<Vec2> chain;
  const auto add = [&](const Vec2& p, std::size_t floor) {
    while (chain.size() >= floor + 2 &&
           cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0)
      chain.pop_back();
    chain.push_back(p);
  };
  for (const Vec2& p : points) add(p, 0);
  const std::size_t lower = chain.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower - 1);
  if (chain.size() > 1) chain.pop_back();
  return chain;
}

/// The two corners of a convex polygon farthest apart (rotating calipers).
std::pair<Vec2, Vec2> diameter(const std::vector<Vec2>& h) {
  const std::size_t n = h.size();
  if (n < 3) return {h.front(), h.back()};
  std::pair<Vec2, Vec2> best{h[0], h[1]};
  const auto keep = [&](const Vec2& a, const Vec2& b) {
    if ((a - b).squaredNorm() > (best.first - best.second).squaredNorm()) best = {a, b};
  };
  std::size_t j = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 edge = h[(i + 1) % n] - h[i];
    while (cross(edge, h[(j + 1) % n] - h[j]) > 0) {
      keep(h[i], h[j]);
      j = (j + 1) % n;
    }
    keep(h[i], h[j]);
    keep(h[(i + 1) % n], h[j]);
  }
  return best;
}

/// Cosine of the angle between the two edges that meet at a point of a loop: 1 for a cusp, -1 for a
/// straight line. -1 for a point on no loop.
double sharpness(const std::vector<std::vector<Index>>& loops, const Coordinates& x,
                 const Vec2& point) {
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (x.xy(loop[i]) != point) continue;
      const Vec2 a = x.xy(loop[(i + loop.size() - 1) % loop.size()]) - point;
      const Vec2 b = x.xy(loop[(i + 1) % loop.size()]) - point;
      return a.dot(b) / std::max(a.norm() * b.norm(), 1e-300);
    }
  return -1;
}

Vec2 mean(const std::vector<Vec2>& points) {
  Vec2 sum(0, 0);
  for (const Vec2& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// In the order of PivotPlace.
struct NamedAnchor {
  const char* name;
  Vec2 BodyAnchors::*point;
};
constexpr std::array<NamedAnchor, 4> named_anchors{
    {{"centre", &BodyAnchors::centre},
     {"centroid", &BodyAnchors::centroid},
     {"leading edge", &BodyAnchors::leading_edge},
     {"trailing edge", &BodyAnchors::trailing_edge}}};

}  // namespace

const Vec2& BodyAnchors::point(PivotPlace place) const {
  return this->*named_anchors[static_cast<std::size_t>(place)].point;
}

const char* pivot_place_name(PivotPlace place) {
  return named_anchors[static_cast<std::size_t>(place)].name;
}

BodyAnchors find_anchors(const std::vector<std::vector<Index>>& loops,
                         const std::vector<Index>& nodes, const Coordinates& x) {
  std::vector<Vec2> points;
  for (Index node : nodes) points.push_back(x.xy(node));
  double area = 0;
  Vec2 moment(0, 0);
  for (const auto& loop : loops) {
    const Vec2 origin = x.xy(loop.front());
    double loop_area = 0;
    Vec2 loop_moment(0, 0);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      points.push_back(x.xy(loop[i]));
      const Vec2 p = x.xy(loop[i]) - origin;
      const Vec2 q = x.xy(loop[(i + 1) % loop.size()]) - origin;
      loop_area += cross(p, q) / 2;
      loop_moment += cross(p, q) / 6 * (p + q);
    }
    // Holes of the mesh run clockwise.
    area += std::abs(loop_area);
    moment += std::abs(loop_area) * origin + (loop_area < 0 ? Vec2(-loop_moment) : loop_moment);
  }
  BodyAnchors anchors;
  Box<3> box = Box<3>::empty();
  for (const Vec2& p : points) box.add(Vec3(p.x(), p.y(), 0));
  anchors.centre = body_centre(box).head<2>();
  anchors.centroid = area > 0 ? Vec2(moment / area) : mean(points);
  const auto [a, b] = diameter(hull(points));
  const double sharp_a = sharpness(loops, x, a);
  const double sharp_b = sharpness(loops, x, b);
  // If both ends are equally sharp (ellipse), assume flow from the left.
  const bool a_trails = std::abs(sharp_a - sharp_b) < 1e-6 ? a.x() > b.x() : sharp_a > sharp_b;
  anchors.trailing_edge = a_trails ? a : b;
  anchors.leading_edge = a_trails ? b : a;
  const double tiny = 1e-12 * box.size().maxCoeff();
  for (int axis : {0, 1})
    if (std::abs(anchors.centroid[axis]) < tiny) anchors.centroid[axis] = 0;
  return anchors;
}

namespace {

/// Of the two directions of a line, the one whose largest component is positive.
Vec3 upright(const Vec3& direction) {
  Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  Vec3 axis = direction[most] < 0 ? Vec3(-direction) : direction;
  // Remove rounding errors of zeros, which would be shown and stored in recipes.
  for (Index k = 0; k < 3; ++k)
    if (std::abs(axis[k]) < 1e-12) axis[k] = 0;
  return axis;
}

/// Twice the area vector of a polygon (Newell).
Vec3 area_of(const std::vector<Index>& nodes, const Coordinates& x) {
  Vec3 area(0, 0, 0);
  const Vec3 origin = x.xyz(nodes.front());
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
    area += (x.xyz(nodes[k]) - origin).cross(x.xyz(nodes[k + 1]) - origin);
  return area;
}

}  // namespace

std::optional<SpacePivot> pivot_at(const PivotSource& source, const Coordinates& x,
                                   const Vec3& axis) {
  const auto exists = [&](Index node) { return node >= 0 && node < x.size(); };
  if (source.nodes.empty() || !std::ranges::all_of(source.nodes, exists)) return std::nullopt;
  SpacePivot pivot{source.from, source.nodes, Vec3(0, 0, 0), axis};
  for (const Index node : source.nodes) pivot.point += x.xyz(node);
  pivot.point /= static_cast<double>(source.nodes.size());
  if (source.nodes.size() == 1) return pivot;
  const Vec3 direction = source.nodes.size() == 2
                             ? Vec3(x.xyz(source.nodes[1]) - x.xyz(source.nodes[0]))
                             : area_of(source.nodes, x);
  if (!(direction.norm() > 0)) return std::nullopt;
  const Vec3 unit = direction.normalized();
  pivot.axis = source.nodes.size() == 2 ? upright(unit) : unit;
  return pivot;
}

RigidMotion motion_of(bool in_plane, double rotate, const Vec3& translate, const Vec3& pivot,
                      const Vec3& axis) {
  if (in_plane) return {rotate, GivenVector::of(2, pivot), GivenVector::of(2, translate)};
  return {rotate, pivot, translate, axis};
}

}  // namespace winslow::gui
