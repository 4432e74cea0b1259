#include "core/motion/outline.h"

#include <algorithm>
#include <cmath>

namespace winslow {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance(const Vec2& p, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(along.dot(p - s.a) / length, 0.0, 1.0) : 0.0;
  return (p - (s.a + t * along)).norm();
}

}  // namespace

Meeting meeting(const Segment& s, const Segment& t) {
  const Vec2 along = s.b - s.a, other = t.b - t.a;
  // Nodes in one place are not always so to the last bit after a motion.
  constexpr double round_off = 1e-12;
  const double least = round_off * along.norm() * other.norm();
  const auto side = [&](const Vec2& line, const Vec2& arm) {
    const double area = cross(line, arm);
    return std::abs(area) <= least ? 0 : area;
  };
  const double from = side(along, t.a - s.a), to = side(along, t.b - s.a);
  const double begin = side(other, s.a - t.a), end = side(other, s.b - t.a);
  if (from * to > 0 || begin * end > 0) return {};
  if (from * to < 0 && begin * end < 0)
    return {Meeting::Kind::crossing, Vec2(s.a + begin / (begin - end) * along)};
  for (const Vec2& p : {s.a, s.b})
    if (distance(p, t) <= round_off * other.norm()) return {Meeting::Kind::touch, p};
  for (const Vec2& p : {t.a, t.b})
    if (distance(p, s) <= round_off * along.norm()) return {Meeting::Kind::touch, p};
  return {};
}

double distance(const Segment& s, const Segment& t) {
  if (meeting(s, t).kind != Meeting::Kind::none) return 0;
  return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)});
}

Box<2> box_of(const Segment& s) {
  Box<2> box{s.a, s.a};
  box.add(s.b);
  return box;
}

bool share_node(const EdgeNodes& a, const EdgeNodes& b) {
  return a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
}

Segment segment(const EdgeNodes& edge, const Coordinates& x) {
  return {x.xy(edge[0]), x.xy(edge[1])};
}

Outline::Outline(const Topology& topology, std::span<const Index> moving_nodes) {
  std::vector<unsigned char> moves(static_cast<std::size_t>(topology.node_count()), 0);
  for (const Index node : moving_nodes) moves[static_cast<std::size_t>(node)] = 1;
  const auto edges = topology.edges();
  constexpr Index inside = -2;
  std::vector<Index> marker(edges.size(), inside);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].elements[1] < 0) marker[e] = -1;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    for (const Face& face : topology.markers()[m].faces)
      if (const auto e = topology.find_face(face))
        marker[static_cast<std::size_t>(*e)] = static_cast<Index>(m);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (marker[e] == inside) continue;
    const EdgeNodes ends = edges[e].nodes;
    const int count =
        moves[static_cast<std::size_t>(ends[0])] + moves[static_cast<std::size_t>(ends[1])];
    if (count == 1) joints.push_back(moving.edges.size());
    (count > 0 ? moving : fixed).add(ends, marker[e]);
  }
}

BoxTree<2> tree_of(const std::vector<EdgeNodes>& edges, const Coordinates& x) {
  std::vector<Box<2>> boxes;
  boxes.reserve(edges.size());
  for (const EdgeNodes& edge : edges) boxes.push_back(box_of(segment(edge, x)));
  return BoxTree<2>(boxes);
}

}  // namespace winslow
