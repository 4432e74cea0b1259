#include "core/layers/clearance.h"

namespace winslow {

namespace {

/// Radius of the circle through the origin with its centre in the unit direction n, and through q:
/// |q|^2 / (2 n.q). Infinite where q does not lie on that side.
double touching_radius(const Vec2& q, const Vec2& n) {
  const double height = n.dot(q);
  return height > 1e-12 * q.norm() ? q.squaredNorm() / (2 * height)
                                   : std::numeric_limits<double>::infinity();
}

/// The smallest such radius over the points a + t (b - a), t in [0, 1]. With q(t) = a + t v, it is
/// (A + 2 B t + C t^2) / (2 (D + E t)); where its derivative vanishes,
/// C E t^2 + 2 C D t + 2 B D - A E = 0.
double touching_radius(const Vec2& a, const Vec2& b, const Vec2& n) {
  double least = std::min(touching_radius(a, n), touching_radius(b, n));
  const Vec2 v = b - a;
  const double aa = a.squaredNorm(), bb = a.dot(v), cc = v.squaredNorm();
  const double dd = n.dot(a), ee = n.dot(v);
  const auto consider = [&](double t) {
    if (t > 0 && t < 1) least = std::min(least, touching_radius(a + t * v, n));
  };
  if (std::abs(ee) < 1e-12 * std::sqrt(cc)) {
    consider(-bb / cc);
    return least;
  }
  const double discriminant = cc * cc * dd * dd - cc * ee * (2 * bb * dd - aa * ee);
  if (discriminant < 0) return least;
  const double root = std::sqrt(discriminant);
  consider((-cc * dd + root) / (cc * ee));
  consider((-cc * dd - root) / (cc * ee));
  return least;
}

}  // namespace

Clearance::Clearance(const Topology& topology, const Coordinates& x, double reach)
    : x_(x), reach_(reach) {
  require_plane(topology, "layers");
  std::vector<Box<2>> boxes;
  for (const auto& edge : topology.edges()) {
    if (edge.elements[1] >= 0) continue;
    segments_.push_back({edge.nodes[0], edge.nodes[1]});
    Box<2> box{x.xy(edge.nodes[0]), x.xy(edge.nodes[0])};
    box.add(x.xy(edge.nodes[1]));
    boxes.push_back(box);
  }
  tree_ = BoxTree<2>(boxes);
}

double Clearance::radius(Index node, const Vec2& inward) const {
  const Vec2 p = x_.xy(node);
  // What touches a disc no larger than the reach lies within the largest one; somewhat more, so
  // that round-off misses nothing.
  const Vec2 centre = p + reach_ * inward;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Vec2 half = Vec2::Constant((1 + 1e-6) * reach_ + 4 * epsilon * p.cwiseAbs().maxCoeff());
  double least = reach_;
  tree_.overlapping({centre - half, centre + half}, [&](Index s) {
    const Segment& segment = segments_[static_cast<std::size_t>(s)];
    if (segment.a == node || segment.b == node) return;
    least = std::min(least, touching_radius(x_.xy(segment.a) - p, x_.xy(segment.b) - p, inward));
  });
  return least;
}

}  // namespace winslow
