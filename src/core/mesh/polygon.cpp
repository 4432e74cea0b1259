#include "core/mesh/polygon.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace winslow {

namespace {

/// Sine of a corner below which it is flat.
double flat_sine(std::size_t corners) {
  constexpr double most = 0.2;
  return std::min(most, 0.5 * std::sin(2 * pi / static_cast<double>(corners)));
}

struct Angle {
  double sine = 0;
  bool narrow = false;  // less than a right angle

  Angle(const Vec2& p, const Vec2& next, const Vec2& previous) {
    const Vec2 a = next - p, b = previous - p;
    const double lengths = a.norm() * b.norm();
    if (lengths > 0) sine = cross(a, b) / lengths;
    narrow = a.dot(b) > 0;
  }
};

double signed_area2(std::span<const Vec2> p) {
  double sum = 0;
  for (std::size_t k = 1; k + 1 < p.size(); ++k) sum += cross(p[k] - p[0], p[k + 1] - p[0]);
  return sum;
}

/// Whether a polygon turns left, or straight on, at every corner, and once around in all.
bool is_convex(std::span<const Vec2> p) {
  const std::size_t n = p.size();
  double turn = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 in = p[k] - p[(k + n - 1) % n], out = p[(k + 1) % n] - p[k];
    const double left = cross(in, out), ahead = in.dot(out);
    if (left < 0 || (left == 0 && !(ahead > 0))) return false;
    turn += std::atan2(left, ahead);
  }
  return turn < 3 * pi;
}

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& from, const Vec2& to, const Vec2& p) {
    return cross(to - from, p - from);
  };
  const double ac = side(a, b, c), ad = side(a, b, d), ca = side(c, d, a), cb = side(c, d, b);
  return ((ac > 0 && ad < 0) || (ac < 0 && ad > 0)) && ((ca > 0 && cb < 0) || (ca < 0 && cb > 0));
}

/// The triangle of a flat corner between flat ones, with the corner that it faces; none if it faces
/// none.
std::optional<std::array<Index, 3>> triangle_across(std::span<const Vec2> p, std::size_t k,
                                                    std::span<const std::array<Index, 3>> real) {
  double best = flat_sine(p.size());
  const std::size_t next = (k + 1) % p.size();
  std::optional<std::array<Index, 3>> found;
  for (const auto& triangle : real) {
    const double sine = Angle(p[k], p[next], p[at(triangle[0])]).sine;
    if (sine <= best) continue;
    best = sine;
    found = {static_cast<Index>(k), static_cast<Index>(next), triangle[0]};
  }
  return found;
}

}  // namespace

PolygonCorners corners_of_polygon(std::span<const Vec2> places, const std::vector<bool>& at_wall) {
  const std::size_t n = places.size();
  const double flat = flat_sine(n);
  const bool sound = signed_area2(places) > 0 && is_simple(places);
  PolygonCorners out{.corners = n};
  std::vector<bool> real(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n, previous = (k + n - 1) % n;
    const Angle angle(places[k], places[next], places[previous]);
    const bool known = sound || (!at_wall.empty() && at_wall[k]);
    const double sine = known ? angle.sine : std::abs(angle.sine);
    real[k] = sine >= flat || (angle.narrow && (sine > 0 || !known));
    if (real[k])
      out.triangles.push_back(
          {static_cast<Index>(k), static_cast<Index>(next), static_cast<Index>(previous)});
  }
  out.real = static_cast<Index>(out.triangles.size());
  for (std::size_t k = 0; k < n; ++k) {
    if (real[k] || real[(k + 1) % n] || real[(k + n - 1) % n]) continue;
    const auto triangle = triangle_across(places, k, std::span(out.triangles).first(at(out.real)));
    if (triangle) out.triangles.push_back(*triangle);
  }
  return out;
}

PolygonShape::PolygonShape(PolygonCorners corners) : corners_(std::move(corners)) {
  const auto n = static_cast<Index>(corners_.corners);
  for (Index k = 0; k < n; ++k) {
    const Index next = (k + 1) % n, previous = (k + n - 1) % n;
    edges_.push_back({k, next});
    faces_.emplace_back(k, next);
    links_.emplace_back(next, previous);
    mirrored_.push_back((n - k) % n);
  }
  const Index real = corners_.real;
  const auto corner = [&](Index k) { return corners_.triangles[at((k + real) % real)][0]; };
  const auto edges_between = [&](Index from, Index to) {
    return to > from ? to - from : to - from + n;
  };
  for (Index k = 0; k < real; ++k)
    side_edges_.push_back(
        {edges_between(corner(k), corner(k + 1)), edges_between(corner(k - 1), corner(k))});
  shape_ = {.type = ElementType::polygon,
            .name = "polygon",
            .dimension = 2,
            .corners = {},
            .edges = edges_,
            .faces = faces_,
            .links = links_,
            .mirrored = mirrored_,
            .real_corners = real,
            .corner_triangles = corners_.triangles,
            .side_edges = side_edges_};
}

std::size_t PolygonShape::bytes() const {
  return sizeof(*this) +
         bytes_of(corners_.triangles, faces_, links_, edges_, side_edges_, mirrored_);
}

bool is_flat_corner(const ElementShape& shape, std::size_t corner) {
  if (shape.type != ElementType::polygon) return false;
  const auto real = shape.corner_triangles.first(at(shape.real_corners));
  return std::ranges::none_of(real, [&](const auto& t) { return at(t[0]) == corner; });
}

double regular_area(const ElementShape& shape) {
  const int n = regular_sides(shape);
  constexpr double root_3 = 1.73205080756887729;
  if (n == 3) return 1;
  if (n == 4) return 4 / root_3;
  return n / (root_3 * std::tan(pi / n));
}

bool is_simple(std::span<const Vec2> places) {
  if (is_convex(places)) return true;
  const std::size_t n = places.size();
  const auto end = [&](std::size_t k) -> const Vec2& { return places[(k + 1) % n]; };
  std::vector<std::size_t> order(n);  // of the edges, from left to right
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto left = [&](std::size_t k) { return std::min(places[k].x(), end(k).x()); };
  std::ranges::sort(order, {}, left);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = order[i];
    const double right = std::max(places[k].x(), end(k).x());
    for (std::size_t j = i + 1; j < n && left(order[j]) <= right; ++j) {
      const std::size_t m = order[j];
      if ((k + 1) % n == m || (m + 1) % n == k) continue;
      if (cross_each_other(places[k], end(k), places[m], end(m))) return false;
    }
  }
  return true;
}

namespace {

/// Cuts off ears.
class Cutting {
 public:
  explicit Cutting(std::span<const Vec2> places) : p_(places), rest_(places.size()) {
    std::iota(rest_.begin(), rest_.end(), Index{0});
  }

  std::vector<std::array<Index, 3>> run() {
    std::vector<std::array<Index, 3>> triangles;
    worth_.resize(rest_.size());
    for (std::size_t k = 0; k < rest_.size(); ++k) worth_[k] = worth(k);
    while (rest_.size() > 3) {
      const auto best = static_cast<std::size_t>(std::ranges::max_element(worth_) - worth_.begin());
      triangles.push_back(ear(best));
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(best));
      worth_.erase(worth_.begin() + static_cast<std::ptrdiff_t>(best));
      const std::size_t n = rest_.size();
      for (const std::size_t k : {best % n, (best + n - 1) % n}) worth_[k] = worth(k);
      // What was inside an ear may have been cut off, too.
      for (std::size_t k = 0; k < n; ++k)
        if (worth_[k] < blocked + 1) worth_[k] = worth(k);
    }
    triangles.push_back({rest_[0], rest_[1], rest_[2]});
    return triangles;
  }

 private:
  static constexpr double blocked = -10;  // below the worth of any ear

  std::array<Index, 3> ear(std::size_t k) const {
    const std::size_t n = rest_.size();
    return {rest_[(k + n - 1) % n], rest_[k], rest_[(k + 1) % n]};
  }

  /// Area over the square of the longest side, with a sign; `blocked` if a corner lies inside.
  double worth(std::size_t k) const {
    const auto [a, b, c] = ear(k);
    const Vec2 &p = p_[at(a)], &q = p_[at(b)], &r = p_[at(c)];
    const double longest =
        std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()});
    const double area = cross(q - p, r - p);
    if (!(longest > 0)) return 0;
    if (!(area > 0)) return area / longest;
    for (const Index other : rest_) {
      if (other == a || other == b || other == c) continue;
      const Vec2& s = p_[at(other)];
      if (cross(q - p, s - p) > 0 && cross(r - q, s - q) > 0 && cross(p - r, s - r) > 0)
        return blocked;
    }
    return area / longest;
  }

  std::span<const Vec2> p_;
  std::vector<Index> rest_;
  std::vector<double> worth_;
};

}  // namespace

std::vector<std::array<Index, 3>> cut_polygon(std::span<const Vec2> places) {
  return Cutting(places).run();
}

namespace {

/// Cuts a polygon so that the worst triangle is as good as can be, by area over the square of the
/// longest side: the best cuts of the parts beyond the sides of a triangle are combined. (Dynamic
/// programming; G. T. Klincsek, Ann. Discrete Math. 9, 1980.) Ears cut one by one may leave corners
/// in a line to the last triangle. Triangles that are all positive overlap nowhere, since their
/// areas add up to that of the polygon.
std::vector<std::array<Index, 3>> best_cut(std::span<const Vec2> p) {
  const std::size_t n = p.size();
  std::vector<double> worst(n * n, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> apex(n * n, 0);
  const auto worth = [&](std::size_t a, std::size_t b, std::size_t c) {
    const double longest = std::max(
        {(p[b] - p[a]).squaredNorm(), (p[c] - p[b]).squaredNorm(), (p[a] - p[c]).squaredNorm()});
    return longest > 0 ? cross(p[b] - p[a], p[c] - p[a]) / longest : 0;
  };
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t a = 0; a + span < n; ++a) {
      const std::size_t c = a + span;
      worst[a * n + c] = -std::numeric_limits<double>::infinity();
      for (std::size_t b = a + 1; b < c; ++b) {
        const double value = std::min({worth(a, b, c), worst[a * n + b], worst[b * n + c]});
        if (value <= worst[a * n + c]) continue;
        worst[a * n + c] = value;
        apex[a * n + c] = b;
      }
    }
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<std::size_t, 2>> sides{{0, n - 1}};
  while (!sides.empty()) {
    const auto [a, c] = sides.back();
    sides.pop_back();
    if (c < a + 2) continue;
    const std::size_t b = apex[a * n + c];
    triangles.push_back({static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)});
    sides.push_back({a, b});
    sides.push_back({b, c});
  }
  return triangles;
}

}  // namespace

std::vector<std::array<Index, 3>> cut_face(std::span<const Vec3> places) {
  Vec3 normal(0, 0, 0);
  for (std::size_t k = 1; k + 1 < places.size(); ++k)
    normal += (places[k] - places[0]).cross(places[k + 1] - places[0]);
  if (!(normal.norm() > 0)) {
    std::vector<std::array<Index, 3>> fan;
    for (Index k = 1; at(k + 1) < places.size(); ++k) fan.push_back({0, k, k + 1});
    return fan;
  }
  const Vec3 first = normal.unitOrthogonal(), second = normal.normalized().cross(first);
  std::vector<Vec2> seen;
  for (const Vec3& p : places)
    seen.emplace_back(first.dot(p - places[0]), second.dot(p - places[0]));
  constexpr std::size_t most = 40;  // corners; the effort grows with the cube
  return seen.size() > most ? cut_polygon(seen) : best_cut(seen);
}

std::vector<Vec2> places_of(const Coordinates& x, std::span<const Index> corners) {
  std::vector<Vec2> places;
  places.reserve(corners.size());
  for (const Index node : corners) places.push_back(x.xy(node));
  return places;
}

}  // namespace winslow
