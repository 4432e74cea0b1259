#include "core/geometry/curve.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "core/error.h"
#include "support/random.h"

namespace winslow::test {
namespace {

std::vector<Vec2> sampled(int count, bool closed, const std::function<Vec2(double)>& curve) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k)
    points.push_back(curve(static_cast<double>(k) / (closed ? count : count - 1)));
  return points;
}

Vec2 ellipse(double t) { return {3 * std::cos(2 * pi * t), std::sin(2 * pi * t)}; }
Vec2 wave(double t) { return {2 * t, 0.3 * std::sin(2 * pi * t)}; }

/// By walking along the curve: the tangent and the curvature from places nearby.
void check_derivatives(const PlaneCurve& curve, const Vec2& near) {
  const CurvePoint at = curve.nearest(near);
  constexpr double h = 1e-4;
  const CurvePoint ahead = curve.nearest(at.point + h * at.tangent);
  const CurvePoint behind = curve.nearest(at.point - h * at.tangent);
  CHECK(at.tangent.norm() == doctest::Approx(1));
  CHECK((ahead.point - behind.point - 2 * h * at.tangent).norm() < 1e-7);
  const Vec2 bend = (ahead.point - 2 * at.point + behind.point) / (h * h);
  CHECK((bend - at.curvature).norm() < 2e-3 * (1 + at.curvature.norm()));
  CHECK(std::abs(at.tangent.dot(at.curvature)) < 1e-9);
}

}  // namespace

TEST_CASE("points on a straight line are one, whatever their spacing and direction") {
  Random random(4);
  for (int run = 0; run < 20; ++run) {
    const Vec2 origin = 100 * random.vector(), direction = random.vector();
    std::vector<Vec2> points;
    for (int k = 0; k < 9; ++k) points.emplace_back(origin + std::pow(k, 3) * direction);
    const auto line = curve_through(points, false);
    CHECK(line->description() == "straight line");
    const Vec2 p = origin + 50 * random.vector();
    const CurvePoint foot = line->nearest(p);
    const Vec2 unit = direction.normalized();
    CHECK((foot.point - (origin + unit.dot(p - origin) * unit)).norm() < 1e-10);
    CHECK(std::abs(std::abs(foot.tangent.dot(unit)) - 1) < 1e-12);
    CHECK(foot.curvature == Vec2(0, 0));
  }
}

TEST_CASE("points on a circle or an arc are one, with its radius") {
  const Vec2 centre(7, -3);
  for (const double share : {1.0, 0.2}) {
    const bool closed = share == 1;
    const auto points = sampled(31, closed, [&](double t) {
      return Vec2(centre + 2.5 * Vec2(std::cos(2 * pi * share * t), std::sin(2 * pi * share * t)));
    });
    const auto circle = curve_through(points, closed);
    CHECK(circle->description() == "circle of radius 2.5");
    for (const Vec2& near : {Vec2(9, -2), Vec2(12, -3), Vec2(7.1, -2.9)}) {
      const CurvePoint foot = circle->nearest(near);
      CHECK((foot.point - centre).norm() == doctest::Approx(2.5).epsilon(1e-12));
      CHECK((foot.curvature + (foot.point - centre) / (2.5 * 2.5)).norm() < 1e-9);
      check_derivatives(*circle, near);
    }
  }
}

TEST_CASE("other points have a smooth curve through them, close to what they were taken from") {
  for (const bool closed : {true, false}) {
    CAPTURE(closed);
    const auto& source = closed ? ellipse : wave;
    const auto points = sampled(81, closed, source);
    const auto curve = curve_through(points, closed);
    CHECK(curve->description() == "smooth curve through 81 nodes");
    for (const Vec2& p : points) CHECK((curve->nearest(p).point - p).norm() < 1e-12);
    Random random(9);
    for (int run = 0; run < 60; ++run) {
      const double t = random.uniform(0.05, 0.95);
      const Vec2 on = source(t);
      CHECK((curve->nearest(on).point - on).norm() < 2e-5);
      const Vec2 near = on + 0.05 * random.vector();
      const CurvePoint foot = curve->nearest(near);
      // Against a fine walk over the curve that the points were taken from.
      double nearest = 1e9;
      for (int k = 0; k <= 20000; ++k)
        nearest = std::min(nearest, (source(k / 20000.0) - near).norm());
      CHECK((foot.point - near).norm() == doctest::Approx(nearest).epsilon(1e-3));
      CHECK(std::abs(foot.tangent.dot(near - foot.point)) < 1e-9);
      check_derivatives(*curve, near);
    }
  }
}

TEST_CASE("a closed curve has no seam where its row of points begins") {
  const auto points = sampled(40, true, ellipse);
  const auto curve = curve_through(points, true);
  const CurvePoint before = curve->nearest(ellipse(-1e-7)), after = curve->nearest(ellipse(1e-7));
  CHECK((before.tangent - after.tangent).norm() < 1e-4);
  CHECK((before.curvature - after.curvature).norm() < 1e-3 * before.curvature.norm());
}

TEST_CASE("too few points, or two at one place, are refused") {
  CHECK_THROWS_AS(curve_through(std::array{Vec2(0, 0)}, false), UsageError);
  CHECK_THROWS_AS(curve_through(std::array{Vec2(0, 0), Vec2(1, 0)}, true), UsageError);
  CHECK_THROWS_AS(curve_through(std::array{Vec2(0, 0), Vec2(0, 0), Vec2(1, 0)}, false), UsageError);
}

}  // namespace winslow::test
