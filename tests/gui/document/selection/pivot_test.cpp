#include "gui/document/selection/pivot.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace winslow::gui {

namespace {

/// A closed loop through points, nodes numbered in order.
struct Loop {
  explicit Loop(const std::vector<Vec2>& points)
      : x(2, static_cast<Index>(points.size())), nodes(points.size()) {
    std::iota(nodes.begin(), nodes.end(), 0);
    for (std::size_t i = 0; i < points.size(); ++i) x.set_xy(static_cast<Index>(i), points[i]);
  }
  Coordinates x;
  std::vector<Index> nodes;
};

Vec2 turned(const Vec2& p, double angle) {
  return {std::cos(angle) * p.x() - std::sin(angle) * p.y(),
          std::sin(angle) * p.x() + std::cos(angle) * p.y()};
}

}  // namespace

TEST_CASE("a wedge's sharp end is its trailing edge, whichever way it lies and runs") {
  for (const double angle : {0.0, 0.7, 2.9, -1.3}) {
    CAPTURE(angle);
    const Vec2 shift(5, -2);
    std::vector<Vec2> points;
    // Round nose at the origin, sharp tail at (1, 0).
    for (int i = 0; i <= 8; ++i) {
      const double t = pi / 2 + pi * i / 8;
      points.push_back(shift + turned(Vec2(0.1 + 0.1 * std::cos(t), 0.1 * std::sin(t)), angle));
    }
    points.push_back(shift + turned(Vec2(1, 0), angle));
    Loop loop(points);
    for (int way = 0; way < 2; ++way) {
      const BodyAnchors anchors = find_anchors({loop.nodes}, {}, loop.x);
      CHECK((anchors.trailing_edge - (shift + turned(Vec2(1, 0), angle))).norm() < 1e-12);
      CHECK((anchors.leading_edge - (shift + turned(Vec2(0, 0), angle))).norm() < 1e-12);
      std::reverse(loop.nodes.begin(), loop.nodes.end());
    }
  }
}

TEST_CASE("centroids are of the enclosed area, not of the nodes, and of all loops together") {
  // A square of side 1 with one side divided finely: the mean of the nodes is off.
  std::vector<Vec2> points;
  for (int i = 0; i < 50; ++i) points.emplace_back(i / 50.0, 0);
  points.emplace_back(1, 0);
  points.emplace_back(1, 1);
  points.emplace_back(0, 1);
  const Loop square(points);
  const BodyAnchors one = find_anchors({square.nodes}, {}, square.x);
  CHECK((one.centroid - Vec2(0.5, 0.5)).norm() < 1e-12);
  CHECK((one.centre - Vec2(0.5, 0.5)).norm() < 1e-12);
  // With a second square of side 2 beyond it, clockwise as holes of a mesh are.
  for (const Vec2& p : {Vec2(4, 0), Vec2(4, 2), Vec2(6, 2), Vec2(6, 0)}) points.push_back(p);
  const Loop both(points);
  const std::vector<Index> first(both.nodes.begin(), both.nodes.begin() + 53);
  const std::vector<Index> second(both.nodes.begin() + 53, both.nodes.end());
  const BodyAnchors two = find_anchors({first, second}, {}, both.x);
  CHECK((two.centroid - Vec2((0.5 + 4 * 5) / 5, (0.5 + 4 * 1) / 5)).norm() < 1e-12);
}

TEST_CASE("nodes of an open curve have a chord and a mean") {
  const Loop curve({Vec2(0, 0), Vec2(1, 0.2), Vec2(2, 0)});
  const BodyAnchors anchors = find_anchors({}, curve.nodes, curve.x);
  CHECK((anchors.trailing_edge - Vec2(2, 0)).norm() == 0);
  CHECK((anchors.leading_edge - Vec2(0, 0)).norm() == 0);
  CHECK((anchors.centroid - Vec2(1, 0.2 / 3)).norm() < 1e-12);
}

TEST_CASE("the farthest pair is found among many points as by trying all") {
  std::vector<Vec2> points;
  unsigned state = 7;
  const auto next = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / (1u << 24);
  };
  for (int round = 0; round < 20; ++round) {
    points.clear();
    for (int i = 0; i < 60; ++i) points.emplace_back(next(), 2 * next());
    const Loop cloud(points);
    double farthest = 0;
    for (const Vec2& p : points)
      for (const Vec2& q : points) farthest = std::max(farthest, (p - q).norm());
    const BodyAnchors anchors = find_anchors({}, cloud.nodes, cloud.x);
    CHECK((anchors.leading_edge - anchors.trailing_edge).norm() ==
          doctest::Approx(farthest).epsilon(1e-14));
  }
}

}  // namespace winslow::gui
