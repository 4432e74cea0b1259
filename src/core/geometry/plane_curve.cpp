#include "core/geometry/plane_curve.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

class Line final : public PlaneCurve {
 public:
  Line(const Vec2& origin, const Vec2& direction) : origin_(origin), direction_(direction) {}
  CurvePoint nearest(const Vec2& p) const override {
    return {origin_ + direction_.dot(p - origin_) * direction_, direction_, Vec2(0, 0)};
  }
  std::string description() const override { return "straight line"; }

 private:
  Vec2 origin_, direction_;
};

class Circle final : public PlaneCurve {
 public:
  Circle(const Vec2& centre, double radius) : centre_(centre), radius_(radius) {}
  CurvePoint nearest(const Vec2& p) const override {
    const Vec2 arm = p - centre_;
    const double length = arm.norm();
    const Vec2 out = length > 0 ? Vec2(arm / length) : Vec2(1, 0);
    return {centre_ + radius_ * out, Vec2(-out.y(), out.x()), -out / radius_};
  }
  std::string description() const override { return "circle of radius " + number_text(radius_); }

 private:
  Vec2 centre_;
  double radius_;
};

/// Cubic pieces between knots, by the second derivatives there.
class Spline final : public PlaneCurve {
 public:
  Spline(std::span<const Vec2> points, bool closed) : knots_(points.begin(), points.end()) {
    count_ = static_cast<Index>(points.size());
    if (closed) knots_.push_back(points.front());
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k)
      chord_.push_back((knots_[k + 1] - knots_[k]).norm());
    bends_ = closed ? periodic_bends() : natural_bends();
    tree_ = BoxTree<2>(std::span<const Vec2>(knots_));
  }

  CurvePoint nearest(const Vec2& p) const override {
    const auto knot = static_cast<std::ptrdiff_t>(
        tree_.nearest(p, std::numeric_limits<double>::infinity())->item);
    const auto pieces = static_cast<std::ptrdiff_t>(chord_.size());
    // The nearest knot is next to the nearest place but where the curve bends as fast as its knots
    // lie apart; two pieces on either side are enough for that.
    constexpr std::ptrdiff_t reach = 2;
    std::optional<Place> best;
    for (std::ptrdiff_t k = knot - reach; k < knot + reach; ++k) {
      const bool wraps = closed();
      if (!wraps && (k < 0 || k >= pieces)) continue;
      const Place place = on_piece(static_cast<std::size_t>((k + 2 * pieces) % pieces), p);
      if (!best || place.distance < best->distance) best = place;
    }
    return at_place(*best);
  }

  std::string description() const override {
    return "smooth curve through " + std::to_string(count_) + " nodes";
  }

 private:
  struct Place {
    std::size_t piece = 0;
    double t = 0;  // 0 to the chord
    double distance = 0;
  };
  struct Derivatives {
    Vec2 r, first, second;
  };

  bool closed() const { return static_cast<Index>(knots_.size()) > count_; }

  Derivatives derivatives(std::size_t k, double t) const {
    const double h = chord_[k], a = (h - t) / h, b = t / h;
    const Vec2 &p = knots_[k], &q = knots_[k + 1], &m = bends_[k], &n = bends_[k + 1];
    return {a * p + b * q + (h * h / 6) * ((a * a * a - a) * m + (b * b * b - b) * n),
            (q - p) / h + (h / 6) * ((1 - 3 * a * a) * m + (3 * b * b - 1) * n), a * m + b * n};
  }

  /// By Newton's method on the derivative of the squared distance, safeguarded by a bracket.
  Place on_piece(std::size_t k, const Vec2& p) const {
    constexpr int samples = 4, iterations = 60;
    const double h = chord_[k];
    Place best{k, 0, std::numeric_limits<double>::infinity()};
    for (int s = 0; s <= samples; ++s) {
      const double t = h * s / samples, distance = (derivatives(k, t).r - p).norm();
      if (distance < best.distance) best = {k, t, distance};
    }
    double low = std::max(0.0, best.t - h / samples), high = std::min(h, best.t + h / samples);
    double t = best.t;
    for (int i = 0; i < iterations; ++i) {
      const Derivatives d = derivatives(k, t);
      const double slope = d.first.dot(d.r - p);
      const double curvature = d.first.squaredNorm() + d.second.dot(d.r - p);
      (slope > 0 ? high : low) = t;
      double next = curvature > 0 ? t - slope / curvature : 0.5 * (low + high);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double change = std::abs(next - t);
      t = next;
      if (change <= 4 * std::numeric_limits<double>::epsilon() * h) break;
    }
    const double distance = (derivatives(k, t).r - p).norm();
    return distance <= best.distance ? Place{k, t, distance} : best;
  }

  CurvePoint at_place(const Place& place) const {
    const Derivatives d = derivatives(place.piece, place.t);
    const double speed2 = d.first.squaredNorm();
    const Vec2 tangent = d.first / std::sqrt(speed2);
    return {d.r, tangent, (d.second - tangent.dot(d.second) * tangent) / speed2};
  }

  Vec2 jump(std::size_t before, std::size_t k, std::size_t next) const {
    return 6 *
           ((knots_[next] - knots_[k]) / chord_[k] - (knots_[k] - knots_[before]) / chord_[before]);
  }

  /// h_(k-1) m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_k m_(k+1) = 6 (slope_k - slope_(k-1)).
  std::vector<Vec2> natural_bends() const {
    const std::size_t n = knots_.size();
    std::vector<Vec2> m(n, Vec2(0, 0));
    if (n < 3) return m;
    std::vector<double> diagonal(n, 1);
    for (std::size_t k = 1; k + 1 < n; ++k) {
      diagonal[k] = 2 * (chord_[k - 1] + chord_[k]);
      m[k] = jump(k - 1, k, k + 1);
      if (k == 1) continue;
      const double factor = chord_[k - 1] / diagonal[k - 1];
      diagonal[k] -= factor * chord_[k - 1];
      m[k] -= factor * m[k - 1];
    }
    for (std::size_t k = n - 2; k >= 1; --k) {
      const Vec2 after = k + 2 < n ? Vec2(chord_[k] * m[k + 1]) : Vec2(0, 0);
      m[k] = (m[k] - after) / diagonal[k];
    }
    return m;
  }

  /// The same in a ring, by the Sherman-Morrison formula.
  std::vector<Vec2> periodic_bends() const {
    const std::size_t n = chord_.size();
    std::vector<double> lower(n), diagonal(n), upper(n);
    std::vector<Vec2> rhs(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t before = (k + n - 1) % n;
      lower[k] = chord_[before];
      upper[k] = chord_[k];
      diagonal[k] = 2 * (chord_[before] + chord_[k]);
      rhs[k] = 6 * ((knots_[k + 1] - knots_[k]) / chord_[k] -
                    (knots_[k] - knots_[before]) / chord_[before]);
    }
    const double corner = lower[0], gamma = -diagonal[0];
    diagonal[0] -= gamma;
    diagonal[n - 1] -= corner * upper[n - 1] / gamma;
    std::vector<double> u(n, 0.0);
    u[0] = gamma;
    u[n - 1] = upper[n - 1];
    for (std::size_t k = 1; k < n; ++k) {
      const double factor = lower[k] / diagonal[k - 1];
      diagonal[k] -= factor * upper[k - 1];
      rhs[k] -= factor * rhs[k - 1];
      u[k] -= factor * u[k - 1];
    }
    for (std::size_t k = n; k-- > 0;) {
      const bool last = k + 1 == n;
      rhs[k] = (rhs[k] - (last ? Vec2(0, 0) : Vec2(upper[k] * rhs[k + 1]))) / diagonal[k];
      u[k] = (u[k] - (last ? 0.0 : upper[k] * u[k + 1])) / diagonal[k];
    }
    const double weight = corner / gamma;
    const double denominator = 1 + u[0] + weight * u[n - 1];
    const Vec2 share = (rhs[0] + weight * rhs[n - 1]) / denominator;
    std::vector<Vec2> m(n + 1);
    for (std::size_t k = 0; k < n; ++k) m[k] = rhs[k] - u[k] * share;
    m[n] = m[0];
    return m;
  }

  Index count_ = 0;
  std::vector<Vec2> knots_;
  std::vector<double> chord_;
  std::vector<Vec2> bends_;  // second derivatives at the knots
  BoxTree<2> tree_;
};

double extent_of(std::span<const Vec2> points) {
  Box<2> box = Box<2>::empty();
  for (const Vec2& p : points) box.add(p);
  return box.size().norm();
}

std::unique_ptr<const PlaneCurve> line_through(std::span<const Vec2> points, double tolerance) {
  // The longest chord from the first point gives the direction to its last digit.
  const Vec2 origin = points.front();
  Vec2 longest(0, 0);
  for (const Vec2& p : points)
    if ((p - origin).squaredNorm() > longest.squaredNorm()) longest = p - origin;
  const Vec2 direction = longest.normalized();
  for (const Vec2& p : points) {
    const Vec2 arm = p - origin;
    if (std::abs(direction.x() * arm.y() - direction.y() * arm.x()) > tolerance) return nullptr;
  }
  return std::make_unique<Line>(origin, direction);
}

/// Least squares of |p|^2 = 2 c . p + (r^2 - c^2), about the mean of the points.
std::unique_ptr<const PlaneCurve> circle_through(std::span<const Vec2> points, double tolerance) {
  if (points.size() < 5) return nullptr;  // fewer would lie on some circle by chance
  Vec2 mean(0, 0);
  for (const Vec2& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd a(rows, 3);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec2 p = points[static_cast<std::size_t>(i)] - mean;
    a.row(i) << 2 * p.x(), 2 * p.y(), 1;
    b[i] = p.squaredNorm();
  }
  const Eigen::Vector3d s = a.colPivHouseholderQr().solve(b);
  const Vec2 centre = s.head<2>();
  const double radius = std::sqrt(s[2] + centre.squaredNorm());
  if (!std::isfinite(radius)) return nullptr;
  for (const Vec2& p : points)
    if (std::abs((p - mean - centre).norm() - radius) > tolerance) return nullptr;
  return std::make_unique<Circle>(mean + centre, radius);
}

}  // namespace

std::unique_ptr<const PlaneCurve> curve_through(std::span<const Vec2> points, bool closed,
                                                double tolerance) {
  if (points.size() < (closed ? 3U : 2U))
    throw UsageError("a curve through " + std::to_string(points.size()) + " points");
  for (std::size_t k = 0; k + (closed ? 0 : 1) < points.size(); ++k)
    if (points[k] == points[(k + 1) % points.size()])
      throw UsageError("a curve through points of which two neighbours lie at one place");
  const double allowed = tolerance * extent_of(points);
  if (!closed)
    if (auto line = line_through(points, allowed)) return line;
  if (auto circle = circle_through(points, allowed)) return circle;
  return std::make_unique<Spline>(points, closed);
}

}  // namespace winslow
