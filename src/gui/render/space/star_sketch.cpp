#include "gui/render/space/star_sketch.h"

#include <utility>

namespace winslow::gui {

namespace {

constexpr double least_area = 1e-9;  // square pixels

/// Part of a convex polygon left of the line from a to b, on paper with y down.
std::vector<ScreenPoint> left_of(const std::vector<ScreenPoint>& polygon, const ScreenPoint& a,
                                 const ScreenPoint& b) {
  std::vector<ScreenPoint> kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ScreenPoint &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double at_p = (b - a).cross(p - a), at_q = (b - a).cross(q - a);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
      kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return kept;
}

double area_of(const std::vector<ScreenPoint>& polygon) {
  double sum = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum += (polygon[k - 1] - polygon[0]).cross(polygon[k] - polygon[0]);
  return 0.5 * sum;
}

ScreenPoint middle_of(const std::vector<ScreenPoint>& polygon) {
  ScreenVector sum;
  for (const ScreenPoint& p : polygon) sum = sum + (p - ScreenPoint());
  return ScreenPoint() + sum / static_cast<double>(polygon.size());
}

}  // namespace

double StarSketch::Flat::depth_at(const ScreenPoint& p) const {
  const auto& [a, b, c] = corners;
  const double wa = (c.at - b.at).cross(p - b.at), wb = (a.at - c.at).cross(p - c.at),
               wc = (b.at - a.at).cross(p - a.at);
  return (wa * a.depth + wb * b.depth + wc * c.depth) / area;
}

StarSketch::StarSketch(const SpaceCamera& camera, std::span<const Vec3> points,
                       std::span<const std::array<Index, 3>> triangles)
    : camera_(camera) {
  std::vector<Corner> seen;
  double nearest = 0, furthest = 0;
  for (const Vec3& p : points) {
    const View::Projection projection = camera.project(p);
    seen.push_back({projection.at, projection.depth});
    nearest = std::min(nearest, projection.depth - seen.front().depth);
    furthest = std::max(furthest, projection.depth - seen.front().depth);
  }
  slack_ = 1e-6 * (furthest - nearest);
  const Vec3 lamp = (camera.back() - 0.45 * camera.right() + 0.55 * camera.up()).normalized();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Corner &p = seen[at(a)], &q = seen[at(b)], &r = seen[at(c)];
    const double turn = (q.at - p.at).cross(r.at - p.at);  // y down: negative from outside
    Face face{t, {p.at, q.at, r.at}, turn < 0, 1};
    const Vec3 normal = (points[at(b)] - points[at(a)]).cross(points[at(c)] - points[at(a)]);
    const double size = normal.norm();
    const double facing = size > 0 ? normal.dot(lamp) / size : 0;
    face.light = std::clamp(face.front ? facing : -facing, 0.0, 1.0);
    faces_.push_back(face);
    Flat flat{{p, q, r}, (p.depth + q.depth + r.depth) / 3, turn};
    if (turn < 0) {
      std::swap(flat.corners[1], flat.corners[2]);
      flat.area = -turn;
    }
    flats_.push_back(flat);
  }
  order();
}

double StarSketch::compare(const Flat& a, const Flat& b) const {
  if (a.area < least_area || b.area < least_area) return 0;
  for (int axis = 0; axis < 2; ++axis) {
    const auto span = [&](const Flat& f) {
      const double p = axis == 0 ? f.corners[0].at.x() : f.corners[0].at.y();
      const double q = axis == 0 ? f.corners[1].at.x() : f.corners[1].at.y();
      const double r = axis == 0 ? f.corners[2].at.x() : f.corners[2].at.y();
      return std::pair(std::min({p, q, r}), std::max({p, q, r}));
    };
    const auto [low_a, high_a] = span(a);
    const auto [low_b, high_b] = span(b);
    if (high_a <= low_b || high_b <= low_a) return 0;
  }
  std::vector<ScreenPoint> common{a.corners[0].at, a.corners[1].at, a.corners[2].at};
  for (std::size_t k = 0; k < 3 && !common.empty(); ++k)
    common = left_of(common, b.corners[k].at, b.corners[(k + 1) % 3].at);
  if (area_of(common) < 1e-3 * std::min(a.area, b.area)) return 0;
  const ScreenPoint middle = middle_of(common);
  return b.depth_at(middle) - a.depth_at(middle);
}

/// Repeatedly picks the deepest triangle with nothing left behind it. In a cycle of triangles, each
/// in front of the next, it picks the deepest; stars of valid tetrahedra have no such cycle.
void StarSketch::order() {
  const std::size_t n = flats_.size();
  std::vector<std::vector<std::size_t>> before(n);  // triangles in front of each one
  std::vector<int> behind(n, 0);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double order = compare(flats_[a], flats_[b]);
      if (order == 0) continue;
      const std::size_t deep = order < 0 ? a : b, near = order < 0 ? b : a;
      before[deep].push_back(near);
      ++behind[near];
    }
  std::vector<Face> sorted;
  std::vector<bool> done(n, false);
  while (sorted.size() < n) {
    std::size_t best = n;
    for (std::size_t k = 0; k < n; ++k) {
      if (done[k]) continue;
      const bool better =
          best == n || (behind[k] == 0) > (behind[best] == 0) ||
          ((behind[k] == 0) == (behind[best] == 0) && flats_[k].depth > flats_[best].depth);
      if (better) best = k;
    }
    done[best] = true;
    sorted.push_back(faces_[best]);
    for (const std::size_t k : before[best]) --behind[k];
  }
  faces_ = std::move(sorted);
}

std::vector<StarSketch::Piece> StarSketch::cut(const Vec3& a, const Vec3& b) const {
  const View::Projection from = camera_.project(a), to = camera_.project(b);
  const ScreenVector along = to.at - from.at;
  std::vector<std::pair<double, double>> hidden;
  for (const Flat& flat : flats_) {
    if (flat.area < least_area) continue;
    double low = 0, high = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenPoint &p = flat.corners[k].at, &q = flat.corners[(k + 1) % 3].at;
      const double start = (q - p).cross(from.at - p), slope = (q - p).cross(along);
      if (slope == 0) {
        if (start <= 0) high = -1;
      } else if (slope > 0) {
        low = std::max(low, -start / slope);
      } else {
        high = std::min(high, -start / slope);
      }
    }
    if (!(high - low > 1e-9)) continue;
    // Depth of the line below the triangle.
    const auto deeper = [&](double s) {
      return from.depth + s * (to.depth - from.depth) - flat.depth_at(from.at + s * along);
    };
    const double at_low = deeper(low), at_high = deeper(high);
    if (at_low <= slack_ && at_high <= slack_) continue;
    const double zero = at_low == at_high ? low : low + (high - low) * at_low / (at_low - at_high);
    if (at_low < 0) low = zero;
    if (at_high < 0) high = zero;
    if (high - low > 1e-9) hidden.emplace_back(low, high);
  }
  std::sort(hidden.begin(), hidden.end());
  std::vector<Piece> pieces;
  double reached = 0;
  const auto add = [&](double low, double high, bool is_hidden) {
    if (high - low > 1e-9)
      pieces.push_back({from.at + low * along, from.at + high * along, is_hidden});
  };
  for (std::size_t k = 0; k < hidden.size();) {
    const double low = hidden[k].first;
    double high = low;
    // Adjacent triangles hide the line as one.
    for (; k < hidden.size() && hidden[k].first <= high + 1e-9; ++k)
      high = std::max(high, hidden[k].second);
    add(reached, low, false);
    add(low, high, true);
    reached = high;
  }
  add(reached, 1, false);
  return pieces;
}

bool StarSketch::hides(const Vec3& point) const {
  const View::Projection seen = camera_.project(point);
  return std::any_of(flats_.begin(), flats_.end(), [&](const Flat& flat) {
    if (flat.area < least_area) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      const ScreenPoint &p = flat.corners[k].at, &q = flat.corners[(k + 1) % 3].at;
      if ((q - p).cross(seen.at - p) <= 1e-9 * flat.area) return false;
    }
    return seen.depth - flat.depth_at(seen.at) > slack_;
  });
}

}  // namespace winslow::gui
