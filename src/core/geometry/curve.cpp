#include "core/geometry/curve.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/error.h"
#include "core/geometry/spline_curve.h"
#include "core/options/option.h"

namespace winslow {

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
  std::string description() const override { return "straight line"; }

 private:
  Vec<D> origin_, direction_;
};

/// In the plane of two axes at right angles.
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
double extent_of(std::span<const Vec<D>> points) {
  Box<D> box = Box<D>::empty();
  for (const Vec<D>& p : points) box.add(p);
  return box.size().norm();
}

template <int D>
std::unique_ptr<const Curve<D>> line_through(std::span<const Vec<D>> points, double tolerance) {
  // The longest chord from the first point gives the direction to its last digit.
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

Vec2 mean_of(std::span<const Vec2> points) {
  Vec2 sum(0, 0);
  for (const Vec2& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

struct FittedCircle {
  Vec2 centre;
  double radius;
};

/// Least squares of |p|^2 = 2 c . p + (r^2 - c^2), about the mean of the points.
std::optional<FittedCircle> fit_circle(std::span<const Vec2> points, double tolerance) {
  if (points.size() < 5) return std::nullopt;  // fewer would lie on some circle by chance
  const Vec2 mean = mean_of(points);
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

/// In the plane that fits the points best, if they lie in it.
std::unique_ptr<const SpaceCurve> circle_through(std::span<const Vec3> points, double tolerance) {
  if (points.size() < 5) return nullptr;
  Vec3 mean(0, 0, 0);
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
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
  const double allowed = tolerance * extent_of<D>(points);
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

}  // namespace winslow
