#include "core/layers/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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

std::size_t Clearance::Hash::operator()(const Cell& cell) const {
  return std::hash<long long>()((static_cast<long long>(cell.first) << 32) ^
                                static_cast<unsigned>(cell.second));
}

Clearance::Cell Clearance::cell_of(const Vec2& p) const {
  const Vec2 scaled = (p - corner_) / cell_;
  return {static_cast<int>(std::floor(scaled.x())), static_cast<int>(std::floor(scaled.y()))};
}

Clearance::Clearance(const Topology& topology, const Coordinates& x, double reach)
    : x_(x), reach_(reach) {
  for (const auto& edge : topology.edges()) {
    if (edge.elements[1] < 0) segments_.push_back({edge.nodes[0], edge.nodes[1]});
  }
  choose_cells();
  for (std::size_t s = 0; s < segments_.size(); ++s) list(static_cast<Index>(s));
}

void Clearance::choose_cells() {
  if (segments_.empty()) return;
  Vec2 most = corner_ = x_.xy(segments_.front().a);
  double length = 0;
  for (const auto& [a, b] : segments_) {
    const Vec2 p = x_.xy(a), q = x_.xy(b);
    corner_ = corner_.cwiseMin(p).cwiseMin(q);
    most = most.cwiseMax(p).cwiseMax(q);
    length += (q - p).norm();
  }
  // However small the reach is, cells need not be smaller than segments, and their numbers have to
  // be integers.
  constexpr double finest = 1e-6;
  cell_ = std::max({2 * reach_, length / static_cast<double>(segments_.size()),
                    finest * (most - corner_).maxCoeff()});
}

void Clearance::list(Index segment) {
  constexpr double most_cells = 4096;
  const auto [a, b] = segments_[static_cast<std::size_t>(segment)];
  const Vec2 from = x_.xy(a), along = x_.xy(b) - from;
  const double pieces = std::ceil(along.norm() / cell_) + 1;
  if (pieces > most_cells) {
    long_.push_back(segment);
    return;
  }
  const auto steps = static_cast<int>(pieces);
  std::optional<Cell> last;
  for (int i = 0; i <= steps; ++i) {
    const Cell cell = cell_of(from + along * (static_cast<double>(i) / steps));
    if (cell == last) continue;
    last = cell;
    cells_[cell].push_back(segment);
  }
}

double Clearance::radius(Index node, const Vec2& inward) const {
  const Vec2 p = x_.xy(node);
  const Cell home = cell_of(p);
  double least = reach_;
  const auto look_at = [&](std::span<const Index> some) {
    for (const Index s : some) {
      const Segment& segment = segments_[static_cast<std::size_t>(s)];
      if (segment.a == node || segment.b == node) continue;
      least = std::min(least, touching_radius(x_.xy(segment.a) - p, x_.xy(segment.b) - p, inward));
    }
  };
  look_at(long_);
  // The disc lies within one cell of its point, and a segment is listed within one cell of any of
  // its points.
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      const auto found = cells_.find({home.first + i, home.second + j});
      if (found != cells_.end()) look_at(found->second);
    }
  }
  return least;
}

}  // namespace winslow
