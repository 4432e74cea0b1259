#include "core/geometry/curve.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
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

namespace {

std::vector<Vec2> oval(int count, double from = 0, double to = 1) {
  std::vector<Vec2> points;
  for (int k = 0; k < count; ++k) {
    const double t = from + (to - from) * k / (to - from == 1 ? count : count - 1);
    points.emplace_back(3 * std::cos(2 * pi * t), std::sin(2 * pi * t));
  }
  return points;
}

std::vector<Vec3> in_space(const std::vector<Vec2>& points) {
  std::vector<Vec3> out;
  for (const Vec2& p : points) out.emplace_back(p.x(), p.y(), 0);
  return out;
}

std::vector<Index> numbers(std::size_t count) {
  std::vector<Index> out(count);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// By a polygon of many chords.
double length_of(const Curve<2>& curve, double from, double to) {
  constexpr int chords = 20000;
  double sum = 0;
  Vec2 before = curve.at_arc(from).point;
  for (int k = 1; k <= chords; ++k) {
    const Vec2 p = curve.at_arc(from + (to - from) * k / chords).point;
    sum += (p - before).norm();
    before = p;
  }
  return sum;
}

}  // namespace

TEST_CASE("a curve by its length of arc: there and back, and as long as it is") {
  const std::vector<Vec2> line{Vec2(1, 2), Vec2(2, 4), Vec2(4, 8)};
  std::vector<Vec2> circle;
  for (int k = 0; k < 9; ++k)
    circle.emplace_back(5 + 2 * std::cos(0.4 * k), 1 + 2 * std::sin(0.4 * k));
  Random random(1);
  const auto check = [&](const PlaneCurve& curve, double most) {
    CAPTURE(curve.description());
    for (int run = 0; run < 20; ++run) {
      const double arc = most * random.uniform(0.02, 0.98);
      const CurvePoint<2> at = curve.at_arc(arc);
      CHECK(std::abs(curve.arc_of(at.point) - arc) < 1e-12 * most);
      const CurvePoint<2> nearest = curve.nearest(at.point);
      CHECK((nearest.point - at.point).norm() < 1e-12 * most);
      CHECK((nearest.tangent - at.tangent).norm() < 1e-10);
      constexpr double h = 1e-4;
      const Vec2 ahead = curve.at_arc(arc + h).point, behind = curve.at_arc(arc - h).point;
      CHECK(((ahead - behind) / (2 * h) - at.tangent).norm() < 1e-6);
      CHECK(((ahead - 2 * at.point + behind) / (h * h) - at.curvature).norm() < 1e-4);
    }
    CHECK(std::abs(length_of(curve, 0.1 * most, 0.9 * most) / (0.8 * most) - 1) < 1e-7);
  };
  const auto along = curve_through(line, false);
  CHECK(along->period() == 0);
  check(*along, 3 * std::sqrt(5.0));
  const auto round = curve_through(circle, false);
  CHECK(std::abs(round->period() - 4 * pi) < 1e-9);
  check(*round, round->period());
  const auto closed = curve_through(oval(60), true);
  // The perimeter of an ellipse with half axes 3 and 1: 12 E(8/9).
  CHECK(std::abs(closed->period() - 13.364893220555258) < 1e-5);
  check(*closed, closed->period());
  CHECK((closed->at_arc(0.3).point - closed->at_arc(0.3 - closed->period()).point).norm() < 1e-12);
  const auto open = curve_through(oval(30, 0, 0.4), false);
  CHECK(open->period() == 0);
  check(*open, open->arc_of(Vec2(3 * std::cos(0.8 * pi), std::sin(0.8 * pi))));
}

TEST_CASE("nodes of a row keep their shares of its length, wherever its ends are") {
  const auto points = oval(24, 0, 0.4);
  const std::shared_ptr<const PlaneCurve> curve = curve_through(points, false);
  // Of every third node, so that lengths of edges differ.
  std::vector<Vec2> some;
  for (std::size_t k = 0; k < points.size(); k += k < 6 ? 1 : 3) some.push_back(points[k]);
  const CurveRow row(numbers(some.size()), false, lifted(curve), in_space(some));
  REQUIRE(row.can_move());
  CHECK(row.between().size() == some.size() - 2);
  const auto same = row.places(in_space(some).front(), in_space(some).back());
  for (std::size_t k = 0; k < same.between.size(); ++k)
    CHECK((same.between[k].point.head<2>() - some[k + 1]).norm() < 1e-12);
  const double from = 0.2, to = 2.4;
  const Vec2 first = curve->at_arc(from).point, last = curve->at_arc(to).point;
  const auto places = row.places({first.x(), first.y(), 0}, {last.x(), last.y(), 0});
  double whole = 0;
  for (std::size_t k = 0; k + 1 < some.size(); ++k)
    whole += length_of(*curve, curve->arc_of(some[k]), curve->arc_of(some[k + 1]));
  for (std::size_t k = 0; k < places.between.size(); ++k) {
    const double share =
        length_of(*curve, curve->arc_of(some[0]), curve->arc_of(some[k + 1])) / whole;
    CHECK(std::abs(row.shares()[k] - share) < 1e-6);
    CHECK((places.between[k].point.head<2>() - curve->at_arc(from + share * (to - from)).point)
              .norm() < 1e-6);
  }
}

TEST_CASE("a row on a circle goes the way round that it went, and a closed one all of it") {
  std::vector<Vec3> places;
  for (const double angle : {10.0, 30.0, 80.0, 150.0, 200.0, 240.0})
    places.emplace_back(std::cos(radians(angle)), std::sin(radians(angle)), 0);
  std::vector<Vec2> flat;
  for (const Vec3& p : places) flat.push_back(p.head<2>());
  const std::shared_ptr<const PlaneCurve> circle = curve_through(flat, false);
  for (const bool backwards : {false, true}) {
    CAPTURE(backwards);
    auto list = places;
    if (backwards) std::reverse(list.begin(), list.end());
    const CurveRow row(numbers(6), false, lifted(circle), list);
    const auto turned = [&](const Vec3& p, double angle) {
      const Vec2 q = Eigen::Rotation2D<double>(radians(angle)) * Vec2(p.head<2>());
      return Vec3(q.x(), q.y(), 0);
    };
    for (const double angle : {0.0, 100.0, 170.0, 260.0, 359.0}) {
      const auto at = row.places(turned(list.front(), angle), turned(list.back(), angle));
      for (std::size_t k = 0; k < at.between.size(); ++k)
        CHECK((at.between[k].point - turned(list[k + 1], angle)).norm() < 1e-12);
    }
  }
  const CurveRow closed(numbers(6), true, lifted(circle), places);
  CHECK(closed.between().size() == 5);
  CHECK(closed.first() == closed.last());
  const auto at = closed.places(Vec3(0, 1, 0), Vec3(0, 1, 0));
  const Vec3 second(std::cos(radians(110)), std::sin(radians(110)), 0);
  CHECK((at.between[0].point - second).norm() < 1e-12);
  for (std::size_t k = 0; k < 5; ++k) CHECK(closed.part_of_last(k) == 0);
}

TEST_CASE("a row round a corner of a curve that is not closed cannot follow") {
  std::vector<Vec2> drop = oval(20, 0.02, 0.98);
  drop.insert(drop.begin(), Vec2(4, 0));
  drop.emplace_back(4, 0);
  const std::shared_ptr<const PlaneCurve> curve = curve_through(drop, false);
  std::vector<Index> nodes = numbers(drop.size());
  nodes.back() = 0;
  CHECK_FALSE(CurveRow(nodes, false, lifted(curve), in_space(drop)).can_move());
}

}  // namespace winslow::test
