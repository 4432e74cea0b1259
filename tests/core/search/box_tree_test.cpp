#include "core/search/box_tree.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace {

enum class Kind { boxes, flat, points, coincident };

template <int D>
Vec<D> random_point(Random& random) {
  Vec<D> p;
  for (int k = 0; k < D; ++k) p[k] = random.uniform(-1, 1);
  return p;
}

/// Boxes of all sizes; flat in one direction; points; points most of which share a place.
template <int D>
std::vector<Box<D>> random_boxes(Random& random, int count, Kind kind) {
  std::vector<Box<D>> boxes;
  for (int i = 0; i < count; ++i) {
    const Vec<D> p = random_point<D>(random);
    Vec<D> size = std::pow(10.0, random.uniform(-6, 0)) * random_point<D>(random).cwiseAbs();
    if (kind == Kind::flat) size[random.index(D)] = 0;
    if (kind == Kind::points || kind == Kind::coincident) size.setZero();
    const Vec<D> at = kind == Kind::coincident && i % 4 != 0 ? Vec<D>::Constant(0.25) : p;
    boxes.push_back({at, at + size});
  }
  return boxes;
}

template <int D>
Index nearest_by_hand(const std::vector<Box<D>>& boxes, const Vec<D>& p, double radius) {
  Index nearest = -1;
  double least = radius;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double d = boxes[i].distance(p);
    if (nearest < 0 ? d > least : d >= least) continue;
    least = d;
    nearest = static_cast<Index>(i);
  }
  return nearest;
}

template <int D>
std::vector<Index> overlapping_by_hand(const std::vector<Box<D>>& boxes, const Box<D>& box) {
  std::vector<Index> found;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    bool apart = false;
    for (int k = 0; k < D; ++k)
      apart |= boxes[i].min[k] > box.max[k] || boxes[i].max[k] < box.min[k];
    if (!apart) found.push_back(static_cast<Index>(i));
  }
  return found;
}

template <int D>
std::vector<Index> overlapping(const BoxTree<D>& tree, const Box<D>& box) {
  std::vector<Index> found;
  tree.overlapping(box, [&](Index i) { found.push_back(i); });
  std::ranges::sort(found);
  return found;
}

template <int D>
void check_against_brute_force(const BoxTree<D>& tree, const std::vector<Box<D>>& boxes,
                               Random& random) {
  for (int trial = 0; trial < 60; ++trial) {
    const Vec<D> p = 1.2 * random_point<D>(random);
    const double radius = trial % 3 == 0 ? 10 : std::pow(10.0, random.uniform(-3, 0));
    const auto found = tree.nearest(p, radius);
    const Index expected = nearest_by_hand(boxes, p, radius);
    REQUIRE((found ? found->item : -1) == expected);
    if (found) CHECK(found->distance == boxes[static_cast<std::size_t>(expected)].distance(p));
    Box<D> box{p, p};
    box.add(p + random.uniform() * random_point<D>(random));
    REQUIRE(overlapping(tree, box) == overlapping_by_hand(boxes, box));
  }
}

/// Where a ray enters a sphere.
std::optional<double> sphere_hit(const Ray<3>& ray, const Vec3& centre, double radius) {
  const Vec3 to = ray.origin - centre;
  const double a = ray.direction.squaredNorm(), b = to.dot(ray.direction);
  const double discriminant = b * b - a * (to.squaredNorm() - radius * radius);
  const double t = discriminant < 0 ? -1 : (-b - std::sqrt(discriminant)) / a;
  return t < 0 ? std::nullopt : std::optional(t);
}

}  // namespace

TEST_CASE_TEMPLATE("what a box tree finds is what looking at every box finds", Boxes, Box<2>,
                   Box<3>) {
  constexpr int D = decltype(Boxes::min)::RowsAtCompileTime;
  for (const Kind kind : {Kind::boxes, Kind::flat, Kind::points, Kind::coincident})
    for (const int count : {1, 8, 9, 17, 700})
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        CAPTURE(static_cast<int>(kind));
        CAPTURE(count);
        CAPTURE(seed);
        Random random(seed);
        const auto boxes = random_boxes<D>(random, count, kind);
        const BoxTree<D> tree(boxes);
        CHECK(tree.size() == count);
        check_against_brute_force(tree, boxes, random);
      }
}

TEST_CASE_TEMPLATE("a tree of points finds what a tree of boxes without extent finds", Boxes,
                   Box<2>, Box<3>) {
  constexpr int D = decltype(Boxes::min)::RowsAtCompileTime;
  for (const Kind kind : {Kind::points, Kind::coincident}) {
    for (const int count : {1, 8, 9, 64, 65, 700}) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(count);
      Random random(7);
      auto boxes = random_boxes<D>(random, count, kind);
      std::vector<Vec<D>> points;
      for (const Box<D>& box : boxes) points.push_back(box.min);
      BoxTree<D> tree(points);
      CHECK(tree.size() == count);
      check_against_brute_force(tree, boxes, random);
      // Items that were points need not stay so.
      for (Box<D>& box : boxes) box.max += 0.1 * random_point<D>(random).cwiseAbs();
      tree.refit(boxes);
      check_against_brute_force(tree, boxes, random);
    }
  }
}

TEST_CASE_TEMPLATE("points that are much closer together in one place than in another are found",
                   Boxes, Box<2>, Box<3>) {
  constexpr int D = decltype(Boxes::min)::RowsAtCompileTime;
  Random random(13);
  std::vector<Box<D>> boxes;
  std::vector<Vec<D>> points;
  for (int i = 0; i < 400; ++i) {
    points.push_back(std::pow(10.0, random.uniform(-14, 0)) * random_point<D>(random));
    boxes.push_back({points.back(), points.back()});
  }
  const BoxTree<D> tree(points);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec<D> p = std::pow(10.0, random.uniform(-14, 0)) * random_point<D>(random);
    const auto found = tree.nearest(p, 10);
    REQUIRE(found);
    CHECK(found->item == nearest_by_hand(boxes, p, 10));
  }
}

TEST_CASE_TEMPLATE("a tree that was refitted finds items where they are now", Boxes, Box<2>,
                   Box<3>) {
  constexpr int D = decltype(Boxes::min)::RowsAtCompileTime;
  Random random(5);
  auto boxes = random_boxes<D>(random, 300, Kind::boxes);
  BoxTree<D> tree(boxes);
  for (Box<D>& box : boxes) {
    const Vec<D> by = random_point<D>(random);
    box = {box.min + by, box.max + by};
  }
  tree.refit(boxes);
  check_against_brute_force(tree, boxes, random);
}

TEST_CASE_TEMPLATE("a tree of nothing finds nothing", Boxes, Box<2>, Box<3>) {
  constexpr int D = decltype(Boxes::min)::RowsAtCompileTime;
  BoxTree<D> none;
  BoxTree<D> empty{std::span<const Box<D>>()}, pointless{std::span<const Vec<D>>()};
  for (BoxTree<D>* tree : {&none, &empty, &pointless}) {
    tree->refit({});
    CHECK(tree->size() == 0);
    CHECK_FALSE(tree->nearest(Vec<D>::Zero(), 1e300));
    CHECK(overlapping(*tree, {Vec<D>::Constant(-1e300), Vec<D>::Constant(1e300)}).empty());
    const Ray<D> ray{Vec<D>::Zero(), Vec<D>::Ones()};
    CHECK(tree->hits(ray, [](Index) { return 0.0; }).empty());
  }
}

TEST_CASE("the distance is the caller's, and of items equally near the lowest is found") {
  Random random(11);
  std::vector<std::array<Vec2, 2>> segments;
  std::vector<Box<2>> boxes;
  // Every segment twice: two items share each place.
  for (int i = 0; i < 400; ++i) {
    if (i % 2 == 0) segments.push_back({random.vector(), random.vector()});
    if (i % 2 == 1) segments.push_back(segments.back());
    Box<2> box{segments.back()[0], segments.back()[0]};
    box.add(segments.back()[1]);
    boxes.push_back(box);
  }
  const BoxTree<2> tree(boxes);
  const auto distance = [&](Index i, const Vec2& p) {
    const auto& [a, b] = segments[static_cast<std::size_t>(i)];
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
  };
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 p = 2 * random.vector();
    Index expected = -1;
    for (Index i = 0; i < 400; ++i)
      if (expected < 0 || distance(i, p) < distance(expected, p)) expected = i;
    const auto found = tree.nearest(p, 10, [&](Index i) { return distance(i, p); });
    REQUIRE(found);
    CHECK(found->item == expected);
    CHECK(found->item % 2 == 0);
    for (const double radius : {found->distance * (1 + 1e-9), found->distance * (1 - 1e-9)}) {
      const auto again = tree.nearest(p, radius, [&](Index i) { return distance(i, p); });
      CHECK(again.has_value() == (radius > found->distance));
    }
  }
}

TEST_CASE("nothing is near to a point that is no number") {
  Random random(2);
  const BoxTree<2> tree(random_boxes<2>(random, 50, Kind::points));
  const Vec2 nowhere(std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK_FALSE(tree.nearest(nowhere, 10));
  CHECK_FALSE(
      tree.nearest(nowhere, 10, [](Index) { return std::numeric_limits<double>::quiet_NaN(); }));
}

TEST_CASE("a ray meets items in order, and those of boxes it misses are not asked") {
  Random random(3);
  std::vector<Vec3> centres;
  std::vector<double> radii;
  std::vector<Box<3>> boxes;
  for (int i = 0; i < 500; ++i) {
    centres.push_back(random_point<3>(random));
    radii.push_back(random.uniform(0.01, 0.2));
    const Vec3 half = Vec3::Constant(radii.back());
    boxes.push_back({centres.back() - half, centres.back() + half});
  }
  const BoxTree<3> tree(boxes);
  std::size_t asked = 0, met = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Ray<3> ray{2 * random_point<3>(random), random_point<3>(random)};
    if (trial % 4 == 0) ray.direction = Vec3::Unit(trial / 4 % 3);
    const auto hit = [&](Index i) {
      return sphere_hit(ray, centres[static_cast<std::size_t>(i)],
                        radii[static_cast<std::size_t>(i)]);
    };
    const auto found = tree.hits(ray, [&](Index i) {
      ++asked;
      return hit(i);
    });
    std::size_t expected = 0;
    for (Index i = 0; i < 500; ++i) expected += hit(i) ? 1 : 0;
    REQUIRE(found.size() == expected);
    met += expected;
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(found[k].t == *hit(found[k].item));
    CHECK(std::ranges::is_sorted(found, {}, &BoxTree<3>::RayHit::t));
  }
  CHECK(met > 100);
  CHECK(asked < 20000);  // of 100000
}

TEST_CASE("a ray finds flat boxes that it lies in, and points that it goes through") {
  const std::vector<Box<3>> boxes{{{1, 0, 0}, {1, 0, 0}},
                                  {{2, -1, 0}, {3, 1, 0}},
                                  {{-2, 0, 0}, {-1, 0, 0}},
                                  {{0, 0, 1e-9}, {5, 0, 1e-9}}};
  const BoxTree<3> tree(boxes);
  const auto entered = [&](Index i) {
    return std::optional(boxes[static_cast<std::size_t>(i)].min.x());
  };
  const auto found = tree.hits({Vec3::Zero(), Vec3(1, 0, 0)}, entered);
  REQUIRE(found.size() == 2);
  CHECK(found[0].item == 0);
  CHECK(found[1].item == 1);
  CHECK(found[1].t == 2);
}
