#include "core/geometry/curve.h"

#include <Eigen/Dense>
#include <utility>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

/// A cubic spline, by the second derivatives at its knots.
template <int D>
class SplineCurve final : public Curve<D> {
 public:
  SplineCurve(std::span<const Vec<D>> points, bool closed) : knots_(points.begin(), points.end()) {
    count_ = static_cast<Index>(points.size());
    if (closed) knots_.push_back(points.front());
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k)
      chord_.push_back((knots_[k + 1] - knots_[k]).norm());
    bends_ = closed ? periodic_bends() : natural_bends();
    tree_ = BoxTree<D>(std::span<const Vec<D>>(knots_));
    for (std::size_t k = 0; k < chord_.size(); ++k)
      arcs_.push_back(arcs_.back() + arc_in_piece(k, chord_[k]));
  }

  CurvePoint<D> nearest(const Vec<D>& p) const override { return at_place(nearest_place(p)); }

  double arc_of(const Vec<D>& p) const override {
    const Place place = nearest_place(p);
    return wrapped(arcs_[place.piece] + arc_in_piece(place.piece, place.t));
  }

  CurvePoint<D> at_arc(double arc) const override {
    const double along = closed() ? wrapped(arc) : std::clamp(arc, 0.0, arcs_.back());
    const auto after = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, along);
    const auto piece = static_cast<std::size_t>(after - arcs_.begin() - 1);
    return at_place({piece, parameter_at(piece, along - arcs_[piece]), 0});
  }

  double period() const override { return closed() ? arcs_.back() : 0; }

  std::string description() const override {
    return "smooth curve through " + std::to_string(count_) + " nodes";
  }

 private:
  struct Place {
    std::size_t piece = 0;
    double t = 0;  // 0 to the chord
    double distance = 0;
  };

  Place nearest_place(const Vec<D>& p) const {
    const auto knot = static_cast<std::ptrdiff_t>(
        tree_.nearest(p, std::numeric_limits<double>::infinity())->item);
    const auto pieces = static_cast<std::ptrdiff_t>(chord_.size());
    // The nearest place is next to the nearest knot, unless the radius of curvature is near the
    // distance of the knots. Two pieces on either side are enough then.
    constexpr std::ptrdiff_t reach = 2;
    std::optional<Place> best;
    for (std::ptrdiff_t k = knot - reach; k < knot + reach; ++k) {
      const bool wraps = closed();
      if (!wraps && (k < 0 || k >= pieces)) continue;
      const Place place = on_piece(static_cast<std::size_t>((k + 2 * pieces) % pieces), p);
      if (!best || place.distance < best->distance) best = place;
    }
    return *best;
  }

  double wrapped(double arc) const {
    if (!closed()) return arc;
    const double rest = std::fmod(arc, arcs_.back());
    return rest < 0 ? rest + arcs_.back() : rest;
  }

  /// Arc length of a piece up to t by Gauss's rule with 8 points. It is exact to round-off unless
  /// the piece is strongly curved.
  double arc_in_piece(std::size_t k, double t) const {
    constexpr std::array<double, 4> places{0.18343464249564980494, 0.52553240991632898582,
                                           0.79666647741362673959, 0.96028985649753623168};
    constexpr std::array<double, 4> weights{0.36268378337836198297, 0.31370664587788728734,
                                            0.22238103445337447054, 0.10122853629037625915};
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const double side : {-1.0, 1.0})
        sum += weights[i] * derivatives(k, 0.5 * t * (1 + side * places[i])).first.norm();
    return 0.5 * t * sum;
  }

  /// The parameter of a piece at an arc length, by Newton's method.
  double parameter_at(std::size_t k, double arc) const {
    constexpr int iterations = 20;
    const double h = chord_[k];
    double t = h * arc / (arcs_[k + 1] - arcs_[k]);
    for (int i = 0; i < iterations; ++i) {
      const double change = (arc_in_piece(k, t) - arc) / derivatives(k, t).first.norm();
      t = std::clamp(t - change, 0.0, h);
      if (std::abs(change) <= 2 * std::numeric_limits<double>::epsilon() * h) break;
    }
    return t;
  }

  struct Derivatives {
    Vec<D> r, first, second;
  };

  bool closed() const { return static_cast<Index>(knots_.size()) > count_; }

  Derivatives derivatives(std::size_t k, double t) const {
    const double h = chord_[k], a = (h - t) / h, b = t / h;
    const Vec<D>&p = knots_[k], &q = knots_[k + 1], &m = bends_[k], &n = bends_[k + 1];
    return {a * p + b * q + (h * h / 6) * ((a * a * a - a) * m + (b * b * b - b) * n),
            (q - p) / h + (h / 6) * ((1 - 3 * a * a) * m + (3 * b * b - 1) * n), a * m + b * n};
  }

  /// The nearest place on a piece, by Newton's method on the derivative of the squared distance
  /// within a bracket.
  Place on_piece(std::size_t k, const Vec<D>& p) const {
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

  CurvePoint<D> at_place(const Place& place) const {
    const Derivatives d = derivatives(place.piece, place.t);
    const double speed2 = d.first.squaredNorm();
    const Vec<D> tangent = d.first / std::sqrt(speed2);
    return {d.r, tangent, (d.second - tangent.dot(d.second) * tangent) / speed2};
  }

  /// Six times the jump of the slope of the chords at knot k.
  Vec<D> jump(std::size_t before, std::size_t k, std::size_t next) const {
    return 6 *
           ((knots_[next] - knots_[k]) / chord_[k] - (knots_[k] - knots_[before]) / chord_[before]);
  }

  /// Second derivatives m of the natural spline with chords h:
  /// h_(k-1) m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_k m_(k+1) = jump_k.
  std::vector<Vec<D>> natural_bends() const {
    const std::size_t n = knots_.size();
    std::vector<Vec<D>> m(n, Vec<D>(Vec<D>::Zero()));
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
      const Vec<D> after = k + 2 < n ? Vec<D>(chord_[k] * m[k + 1]) : Vec<D>(Vec<D>::Zero());
      m[k] = (m[k] - after) / diagonal[k];
    }
    return m;
  }

  /// The same for a closed curve, by the Sherman-Morrison formula.
  std::vector<Vec<D>> periodic_bends() const {
    const std::size_t n = chord_.size();
    std::vector<double> lower(n), diagonal(n), upper(n);
    std::vector<Vec<D>> rhs(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t before = (k + n - 1) % n;
      lower[k] = chord_[before];
      upper[k] = chord_[k];
      diagonal[k] = 2 * (chord_[before] + chord_[k]);
      rhs[k] = jump(before, k, k + 1);
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
      rhs[k] =
          (rhs[k] - (last ? Vec<D>(Vec<D>::Zero()) : Vec<D>(upper[k] * rhs[k + 1]))) / diagonal[k];
      u[k] = (u[k] - (last ? 0.0 : upper[k] * u[k + 1])) / diagonal[k];
    }
    const double weight = corner / gamma;
    const double denominator = 1 + u[0] + weight * u[n - 1];
    const Vec<D> share = (rhs[0] + weight * rhs[n - 1]) / denominator;
    std::vector<Vec<D>> m(n + 1);
    for (std::size_t k = 0; k < n; ++k) m[k] = rhs[k] - u[k] * share;
    m[n] = m[0];
    return m;
  }

  Index count_ = 0;
  std::vector<Vec<D>> knots_;
  std::vector<double> chord_;
  std::vector<double> arcs_{0};  // up to each knot
  std::vector<Vec<D>> bends_;    // second derivatives at the knots
  BoxTree<D> tree_;
};

namespace {

template <int D>
class Line final : public Curve<D> {
 public:
  Line(const Vec<D>& origin, const Vec<D>& direction) : origin_(origin), direction_(direction) {}
  CurvePoint<D> nearest(const Vec<D>& p) const override { return at_arc(arc_of(p)); }
  double arc_of(const Vec<D>& p) const override { return direction_.dot(p - origin_); }
  CurvePoint<D> at_arc(double arc) const override {
    return {origin_ + arc * direction_, direction_, Vec<D>::Zero()};
  }
  double period() const override { return 0; }
  bool goes_on() const override { return true; }
  std::string description() const override { return "straight line"; }

 private:
  Vec<D> origin_, direction_;
};

/// A circle in the plane of two perpendicular unit vectors.
template <int D>
class Circle final : public Curve<D> {
 public:
  Circle(const Vec<D>& centre, double radius, const Vec<D>& first, const Vec<D>& second)
      : centre_(centre), first_(first), second_(second), radius_(radius) {}
  CurvePoint<D> nearest(const Vec<D>& p) const override {
    const Vec2 arm(first_.dot(p - centre_), second_.dot(p - centre_));
    const double length = arm.norm();
    return at_direction(length > 0 ? Vec2(arm / length) : Vec2(1, 0));
  }
  double arc_of(const Vec<D>& p) const override {
    const double angle = std::atan2(second_.dot(p - centre_), first_.dot(p - centre_));
    return radius_ * (angle < 0 ? angle + 2 * pi : angle);
  }
  CurvePoint<D> at_arc(double arc) const override {
    return at_direction(Vec2(std::cos(arc / radius_), std::sin(arc / radius_)));
  }
  double period() const override { return 2 * pi * radius_; }
  bool goes_on() const override { return true; }
  std::string description() const override { return "circle of radius " + number_text(radius_); }

 private:
  CurvePoint<D> at_direction(const Vec2& out) const {
    const Vec<D> normal = out.x() * first_ + out.y() * second_;
    return {centre_ + radius_ * normal, out.x() * second_ - out.y() * first_, -normal / radius_};
  }

  Vec<D> centre_, first_, second_;
  double radius_;
};

template <int D>
std::unique_ptr<const Curve<D>> line_through(std::span<const Vec<D>> points, double tolerance) {
  // The longest chord from the first point is the most accurate direction.
  const Vec<D> origin = points.front();
  Vec<D> longest = Vec<D>::Zero();
  for (const Vec<D>& p : points)
    if ((p - origin).squaredNorm() > longest.squaredNorm()) longest = p - origin;
  const Vec<D> direction = longest.normalized();
  for (const Vec<D>& p : points) {
    const Vec<D> arm = p - origin;
    if ((arm - direction.dot(arm) * direction).norm() > tolerance) return nullptr;
  }
  return std::make_unique<Line<D>>(origin, direction);
}

struct FittedCircle {
  Vec2 centre;
  double radius;
};

/// Fits |p|^2 = 2 c . p + (r^2 - c^2) by least squares, relative to the mean of the points.
std::optional<FittedCircle> fit_circle(std::span<const Vec2> points, double tolerance) {
  if (points.size() < 5) return std::nullopt;  // fewer would lie on some circle by chance
  const Vec2 mean = mean_of<2>(points);
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
  if (!std::isfinite(radius)) return std::nullopt;
  for (const Vec2& p : points)
    if (std::abs((p - mean - centre).norm() - radius) > tolerance) return std::nullopt;
  return FittedCircle{mean + centre, radius};
}

std::unique_ptr<const PlaneCurve> circle_through(std::span<const Vec2> points, double tolerance) {
  const auto circle = fit_circle(points, tolerance);
  if (!circle) return nullptr;
  return std::make_unique<Circle<2>>(circle->centre, circle->radius, Vec2(1, 0), Vec2(0, 1));
}

/// Fits a circle in the best-fitting plane of the points, if they lie in it.
std::unique_ptr<const SpaceCurve> circle_through(std::span<const Vec3> points, double tolerance) {
  if (points.size() < 5) return nullptr;
  const Vec3 mean = mean_of<3>(points);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);  // ascending
  const Vec3 normal = axes.eigenvectors().col(0), first = axes.eigenvectors().col(2);
  const Vec3 second = normal.cross(first);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) {
    if (std::abs(normal.dot(p - mean)) > tolerance) return nullptr;
    flat.emplace_back(first.dot(p - mean), second.dot(p - mean));
  }
  const auto circle = fit_circle(flat, tolerance);
  if (!circle) return nullptr;
  const Vec3 centre = mean + circle->centre.x() * first + circle->centre.y() * second;
  return std::make_unique<Circle<3>>(centre, circle->radius, first, second);
}

template <int D>
std::unique_ptr<const Curve<D>> curve_of(std::span<const Vec<D>> points, bool closed,
                                         double tolerance) {
  if (points.size() < (closed ? 3U : 2U))
    throw UsageError("a curve through " + std::to_string(points.size()) + " points");
  for (std::size_t k = 0; k + (closed ? 0 : 1) < points.size(); ++k)
    if (points[k] == points[(k + 1) % points.size()])
      throw UsageError("a curve through points of which two neighbours lie at one place");
  const double allowed = tolerance * Box<D>::around(points).size().norm();
  if (!closed)
    if (auto line = line_through<D>(points, allowed)) return line;
  if (auto circle = circle_through(points, allowed)) return circle;
  return std::make_unique<SplineCurve<D>>(points, closed);
}

}  // namespace

std::unique_ptr<const PlaneCurve> curve_through(std::span<const Vec2> points, bool closed,
                                                double tolerance) {
  return curve_of<2>(points, closed, tolerance);
}

std::unique_ptr<const SpaceCurve> curve_through(std::span<const Vec3> points, bool closed,
                                                double tolerance) {
  return curve_of<3>(points, closed, tolerance);
}

namespace {

/// A curve of the plane in space.
class LiftedCurve final : public SpaceCurve {
 public:
  explicit LiftedCurve(std::shared_ptr<const PlaneCurve> curve) : curve_(std::move(curve)) {}
  CurvePoint<3> nearest(const Vec3& p) const override {
    return lifted_point(curve_->nearest(p.head<2>()));
  }
  double arc_of(const Vec3& p) const override { return curve_->arc_of(p.head<2>()); }
  CurvePoint<3> at_arc(double arc) const override { return lifted_point(curve_->at_arc(arc)); }
  double period() const override { return curve_->period(); }
  bool goes_on() const override { return curve_->goes_on(); }
  std::string description() const override { return curve_->description(); }

 private:
  static CurvePoint<3> lifted_point(const CurvePoint<2>& place) {
    return {lifted(place.point), lifted(place.tangent), lifted(place.curvature)};
  }

  std::shared_ptr<const PlaneCurve> curve_;
};

}  // namespace

std::shared_ptr<const SpaceCurve> lifted(std::shared_ptr<const PlaneCurve> curve) {
  return std::make_shared<LiftedCurve>(std::move(curve));
}

CurveRow::CurveRow(std::vector<Index> nodes, bool closed, std::shared_ptr<const SpaceCurve> curve,
                   std::span<const Vec3> places)
    : nodes_(std::move(nodes)), closed_(closed), curve_(std::move(curve)) {
  const bool round_a_corner = !closed_ && nodes_.front() == nodes_.back();
  if (round_a_corner && curve_->period() == 0) return;
  const std::vector<double> lengths = edge_lengths(places);
  for (const double length : lengths) length_ += length;
  double along = 0;
  for (std::size_t k = 0; k + 1 < lengths.size(); ++k) {
    along += lengths[k];
    shares_.push_back(along / length_);
  }
}

/// Signed arc length between two arc positions; the shorter way on a closed curve.
double CurveRow::arc_between(double from, double to) const {
  const double period = curve_->period();
  return period > 0 ? std::remainder(to - from, period) : to - from;
}

std::vector<double> CurveRow::edge_lengths(std::span<const Vec3> places) const {
  std::vector<double> lengths;
  double before = curve_->arc_of(places.front());
  const double start = before;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double arc = curve_->arc_of(places[k]);
    lengths.push_back(arc_between(before, arc));
    before = arc;
  }
  if (closed_) lengths.push_back(arc_between(before, start));
  return lengths;
}

CurveRow::Places CurveRow::places(const Vec3& first, const Vec3& last) const {
  const double from = curve_->arc_of(first), to = curve_->arc_of(last);
  const double period = curve_->period();
  double length = closed_ ? length_ : to - from;
  if (!closed_ && period > 0) {
    // The row keeps its direction around the closed curve and goes around at most once.
    const double way = length_ < 0 ? -1 : 1;
    double round = std::fmod(way * length, period);
    if (round <= 0) round += period;
    length = way * round;
  }
  Places out{curve_->at_arc(from), curve_->at_arc(to), {}};
  for (const double share : shares_) out.between.push_back(curve_->at_arc(from + share * length));
  return out;
}

}  // namespace winslow
