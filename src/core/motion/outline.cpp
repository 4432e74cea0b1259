#include "core/motion/outline.h"

#include <Eigen/Geometry>

namespace winslow {

namespace {

double distance(const Vec2& p, const Facet<2>& s) {
  const Vec2 along = s[1] - s[0];
  const double length = along.squaredNorm();
  const double t = length > 0 ? std::clamp(along.dot(p - s[0]) / length, 0.0, 1.0) : 0.0;
  return (p - (s[0] + t * along)).norm();
}

}  // namespace

Meeting<2> meeting(const Facet<2>& s, const Facet<2>& t) {
  const Vec2 along = s[1] - s[0], other = t[1] - t[0];
  // Nodes in one place are not always so to the last bit after a motion.
  constexpr double round_off = 1e-12;
  const double least = round_off * along.norm() * other.norm();
  const auto side = [&](const Vec2& line, const Vec2& arm) {
    const double area = cross(line, arm);
    return std::abs(area) <= least ? 0 : area;
  };
  const double from = side(along, t[0] - s[0]), to = side(along, t[1] - s[0]);
  const double begin = side(other, s[0] - t[0]), end = side(other, s[1] - t[0]);
  if (from * to > 0 || begin * end > 0) return {};
  if (from * to < 0 && begin * end < 0)
    return {Meeting<2>::Kind::crossing, Vec2(s[0] + begin / (begin - end) * along)};
  for (const Vec2& p : s)
    if (distance(p, t) <= round_off * other.norm()) return {Meeting<2>::Kind::touch, p};
  for (const Vec2& p : t)
    if (distance(p, s) <= round_off * along.norm()) return {Meeting<2>::Kind::touch, p};
  return {};
}

double distance(const Facet<2>& s, const Facet<2>& t) {
  if (meeting(s, t).kind != Meeting<2>::Kind::none) return 0;
  return std::min({distance(s[0], t), distance(s[1], t), distance(t[0], s), distance(t[1], s)});
}

namespace {

using Kind = Meeting<3>::Kind;

// Nodes in one place are not always so to the last bit after a motion.
constexpr double round_off = 1e-12;

double longest_edge(const Facet<3>& t) {
  return std::max({(t[1] - t[0]).norm(), (t[2] - t[1]).norm(), (t[0] - t[2]).norm()});
}

/// A triangle with queries about its plane.
class PlaneOf {
 public:
  /// reach: largest extent of the compared facet.
  PlaneOf(const Facet<3>& t, double reach)
      : t_(t), normal_((t[1] - t[0]).cross(t[2] - t[0])), area_(normal_.norm()) {
    least_ = round_off * area_ * std::max(longest_edge(t), reach);
    normal_.cwiseAbs().maxCoeff(&dropped_);
  }

  /// Six times the signed volume of the point over the triangle, 0 for a point in its plane.
  double side(const Vec3& p) const {
    const double volume = normal_.dot(p - t_[0]);
    return std::abs(volume) <= least_ ? 0 : volume;
  }

  /// Projection along the axis that is nearest to the normal.
  Vec2 flat(const Vec3& p) const { return {p[(dropped_ + 1) % 3], p[(dropped_ + 2) % 3]}; }

  /// Location of a point in the plane: > 0 inside, 0 on the outline, < 0 outside.
  int inside(const Vec3& p) const {
    int place = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double area = normal_.dot((t_[(k + 1) % 3] - t_[k]).cross(p - t_[k]));
      const double least = round_off * area_ * area_;
      if (area < -least) return -1;
      if (area <= least) place = 0;
    }
    return place;
  }

  /// A common point of the triangle and a segment in its plane, if there is one.
  std::optional<Vec3> overlap(const Vec3& p, const Vec3& q) const {
    for (const Vec3& end : {p, q})
      if (inside(end) >= 0) return end;
    for (std::size_t k = 0; k < 3; ++k) {
      const Meeting<2> found =
          meeting(Facet<2>{flat(p), flat(q)}, Facet<2>{flat(t_[k]), flat(t_[(k + 1) % 3])});
      if (found.kind != Meeting<2>::Kind::none) return lifted(found.place, p, q);
    }
    return std::nullopt;
  }

 private:
  /// The point of a segment with the given projection.
  Vec3 lifted(const Vec2& place, const Vec3& p, const Vec3& q) const {
    const Vec2 way = flat(q) - flat(p);
    const double t = way.squaredNorm() > 0 ? (place - flat(p)).dot(way) / way.squaredNorm() : 0;
    return p + t * (q - p);
  }

  const Facet<3>& t_;
  Vec3 normal_;
  double area_, least_ = 0;
  int dropped_ = 0;
};

/// The intersection of a segment and a triangle. from, to: the sides of its ends.
Meeting<3> meeting(const PlaneOf& plane, const Vec3& p, const Vec3& q, double from, double to) {
  if (from * to > 0) return {};
  if (from == 0 && to == 0) {
    const auto place = plane.overlap(p, q);
    return place ? Meeting<3>{Kind::touch, *place} : Meeting<3>{};
  }
  const Vec3 place = p + from / (from - to) * (q - p);
  const int inside = plane.inside(place);
  if (inside < 0) return {};
  return {inside > 0 && from * to < 0 ? Kind::crossing : Kind::touch, place};
}

/// The strongest intersection of the edges of s with t.
Meeting<3> edges_through(const Facet<3>& s, const Facet<3>& t) {
  const PlaneOf plane(t, longest_edge(s));
  const std::array<double, 3> side{plane.side(s[0]), plane.side(s[1]), plane.side(s[2])};
  Meeting<3> strongest;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    Meeting<3> found = meeting(plane, s[k], s[next], side[k], side[next]);
    if (found.kind == Kind::crossing) return found;
    if (found.kind == Kind::touch) strongest = found;
  }
  return strongest;
}

/// Ericson, Real-Time Collision Detection, section 5.1.9.
double distance_of_segments(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  const Vec3 d = q - p, e = b - a, r = p - a;
  const double dd = d.squaredNorm(), ee = e.squaredNorm();
  if (dd == 0 || ee == 0) {
    const Vec3& from = dd == 0 ? p : a;
    const Vec3& base = dd == 0 ? a : p;
    const Vec3& way = dd == 0 ? e : d;
    const double length = way.squaredNorm();
    const double t = length > 0 ? std::clamp(way.dot(from - base) / length, 0.0, 1.0) : 0;
    return (from - base - t * way).norm();
  }
  const double de = d.dot(e), dr = d.dot(r), er = e.dot(r);
  const double denominator = dd * ee - de * de;
  double s = denominator > 0 ? std::clamp((de * er - dr * ee) / denominator, 0.0, 1.0) : 0;
  const double t = std::clamp((de * s + er) / ee, 0.0, 1.0);
  s = std::clamp((de * t - dr) / dd, 0.0, 1.0);
  return (p + s * d - a - t * e).norm();
}

/// Distance of a point from a triangle if it projects to the interior.
std::optional<double> distance_over(const Vec3& p, const Facet<3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  for (std::size_t k = 0; k < 3; ++k)
    if (normal.dot((t[(k + 1) % 3] - t[k]).cross(p - t[k])) < 0) return std::nullopt;
  const double area = normal.norm();
  if (area == 0) return std::nullopt;
  return std::abs(normal.dot(p - t[0])) / area;
}

}  // namespace

Meeting<3> meeting(const Facet<3>& s, const Facet<3>& t) {
  Meeting<3> first = edges_through(s, t);
  if (first.kind == Kind::crossing) return first;
  const Meeting<3> second = edges_through(t, s);
  return second.kind == Kind::none || (second.kind == Kind::touch && first.kind == Kind::touch)
             ? first
             : second;
}

double distance(const Facet<3>& s, const Facet<3>& t) {
  if (meeting(s, t).kind != Kind::none) return 0;
  double nearest = (s[0] - t[0]).norm();
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto over = distance_over(s[i], t)) nearest = std::min(nearest, *over);
    if (const auto over = distance_over(t[i], s)) nearest = std::min(nearest, *over);
    for (std::size_t k = 0; k < 3; ++k)
      nearest = std::min(nearest, distance_of_segments(s[i], s[(i + 1) % 3], t[k], t[(k + 1) % 3]));
  }
  return nearest;
}

namespace {

/// The facets of a face. A facet without area, as two edges in a line have, would touch whatever is
/// near: a face with a flat corner is cut elsewhere.
template <int D>
std::vector<FacetNodes<D>> facets_of(const Face& face, const Coordinates& x) {
  if constexpr (D == 2) {
    return {face.edge()};
  } else {
    if (face.size() == 3) return {{face[0], face[1], face[2]}};
    std::vector<Vec3> places;
    for (const Index node : face) places.push_back(x.xyz(node));
    const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
      return (places[b] - places[a]).cross(places[c] - places[a]).norm();
    };
    constexpr double flat = 1e-6;  // of the other triangle
    if (face.size() == 4) {
      const auto [less, more] = std::minmax({area(0, 1, 2), area(0, 2, 3)});
      if (less > flat * more) return {{face[0], face[1], face[2]}, {face[0], face[2], face[3]}};
    }
    std::vector<FacetNodes<D>> facets;
    for (const auto& [a, b, c] : cut_face(places))
      facets.push_back({face[at(a)], face[at(b)], face[at(c)]});
    return facets;
  }
}

/// The faces around what moves as a whole inside a mesh. No face: no node inside moves.
class MovingInside {
 public:
  MovingInside(const Topology& topology, const std::vector<unsigned char>& moves)
      : topology_(topology), moves_(moves) {
    for (const Index node : topology.interior_nodes()) any_ = any_ || moves[at(node)] != 0;
    if (!any_) return;
    for (Index e = 0; e < topology.element_count(); ++e)
      whole_.push_back(all_move(topology.element(e)));
  }

  /// Whether a face inside the mesh is one of them.
  bool outlines(const Topology::SharedFace& face) const {
    return any_ && all_move(face.nodes) &&
           !(whole_[at(face.elements[0])] && whole_[at(face.elements[1])]) &&
           std::ranges::any_of(face.nodes,
                               [&](Index node) { return !topology_.on_boundary(node); });
  }

 private:
  template <class Nodes>
  bool all_move(const Nodes& nodes) const {
    return std::ranges::all_of(nodes, [&](Index node) { return moves_[at(node)] != 0; });
  }

  const Topology& topology_;
  const std::vector<unsigned char>& moves_;
  bool any_ = false;
  std::vector<bool> whole_;  // #elements: all nodes move
};

}  // namespace

template <int D>
Outline<D>::Outline(const Topology& topology, const Coordinates& x,
                    std::span<const Index> moving_nodes, std::span<const Index> yielding) {
  std::vector<bool> yields(static_cast<std::size_t>(topology.node_count()), false);
  for (const Index node : yielding) yields[static_cast<std::size_t>(node)] = true;
  std::vector<unsigned char> moves(static_cast<std::size_t>(topology.node_count()), 0);
  for (const Index node : moving_nodes) moves[static_cast<std::size_t>(node)] = 1;
  const Index faces = topology.face_count();
  constexpr Index inside = -3;
  const MovingInside moving_inside(topology, moves);
  std::vector<Index> marker(static_cast<std::size_t>(faces), inside);
  for (Index f = 0; f < faces; ++f)
    if (topology.face(f).elements[1] < 0) marker[static_cast<std::size_t>(f)] = no_marker;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    for (const Face& face : topology.markers()[m].faces)
      if (const auto f = topology.find_face(face))
        marker[static_cast<std::size_t>(*f)] = static_cast<Index>(m);
  }
  for (Index f = 0; f < faces; ++f) {
    Index own = marker[static_cast<std::size_t>(f)];
    if (own == inside && moving_inside.outlines(topology.face(f))) own = prescribed_inside;
    if (own == inside) continue;
    const Face nodes_of_face = topology.face(f).nodes;
    if (std::ranges::any_of(nodes_of_face,
                            [&](Index node) { return yields[static_cast<std::size_t>(node)]; }))
      continue;
    for (const FacetNodes<D>& nodes : facets_of<D>(nodes_of_face, x)) add(nodes, own, moves);
  }
}

template <int D>
void Outline<D>::add(const FacetNodes<D>& nodes, Index marker,
                     const std::vector<unsigned char>& moves) {
  const auto count = std::ranges::count_if(
      nodes, [&](Index node) { return moves[static_cast<std::size_t>(node)] != 0; });
  if (count > 0 && count < D) joints.push_back(moving.facets.size());
  (count > 0 ? moving : fixed).add(nodes, marker);
}

template <int D>
std::string Outline<D>::marker_name(const Topology& topology, Index marker) {
  if (marker == prescribed_inside) return "what is prescribed inside";
  return marker < 0 ? "" : topology.markers()[static_cast<std::size_t>(marker)].name;
}

template struct Outline<2>;
template struct Outline<3>;

}  // namespace winslow
