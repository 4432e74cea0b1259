#include "core/geometry/curve_row.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "support/random.h"

namespace winslow::test {
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
  const CurveRow row(numbers(some.size()), false, by_arc(curve), in_space(some));
  REQUIRE(row.can_follow());
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
    const CurveRow row(numbers(6), false, by_arc(circle), list);
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
  const CurveRow closed(numbers(6), true, by_arc(circle), places);
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
  CHECK_FALSE(CurveRow(nodes, false, by_arc(curve), in_space(drop)).can_follow());
}

}  // namespace winslow::test
