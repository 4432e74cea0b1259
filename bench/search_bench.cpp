// Nearest of half a million points: the box tree beside a plain k-d tree, which does nothing else.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/search/box_tree.h"
#include "support/random.h"

namespace {

using namespace winslow;

/// The yardstick: point after point, the middle of a range splits it, along x and y in turns.
class KdTree {
 public:
  explicit KdTree(std::vector<Vec2> points) : points_(std::move(points)) {
    for (std::size_t i = 0; i < points_.size(); ++i) order_.push_back(static_cast<Index>(i));
    build(0, order_.size(), 0);
  }

  std::optional<Index> nearest(const Vec2& point, double radius) const {
    Nearest best{radius, {}};
    search(0, order_.size(), 0, point, best);
    return best.item;
  }

 private:
  struct Nearest {
    double distance;
    std::optional<Index> item;
  };

  void build(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto place = [this](std::size_t i) {
      return order_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(place(begin), place(middle), place(end),
                     [&](Index a, Index b) { return points_[at(a)][axis] < points_[at(b)][axis]; });
    build(begin, middle, 1 - axis);
    build(middle + 1, end, 1 - axis);
  }

  void search(std::size_t begin, std::size_t end, int axis, const Vec2& point,
              Nearest& best) const {
    if (begin >= end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Vec2& here = points_[at(order_[middle])];
    const double distance = (here - point).norm();
    if (distance <= best.distance) best = {distance, order_[middle]};
    const double beyond = point[axis] - here[axis];
    const auto visit = [&](bool low) {
      search(low ? begin : middle + 1, low ? middle : end, 1 - axis, point, best);
    };
    visit(beyond < 0);
    if (std::abs(beyond) <= best.distance) visit(beyond >= 0);
  }

  std::vector<Vec2> points_;
  std::vector<Index> order_;
};

constexpr int side = 707;

/// A jittered grid over the unit square, row by row or in no order.
std::vector<Vec2> points(bool in_order) {
  test::Random random(1);
  std::vector<Vec2> points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) points.push_back((Vec2(i, j) + random.vector(-0.2, 0.2)) / side);
  if (in_order) return points;
  std::vector<Vec2> shuffled;
  for (const Index i : random.permutation(static_cast<Index>(points.size())))
    shuffled.push_back(points[at(i)]);
  return shuffled;
}

template <class Tree>
void build(benchmark::State& run) {
  const std::vector<Vec2> all = points(run.range(0) != 0);
  for (auto _ : run) benchmark::DoNotOptimize(Tree(all));
}

template <class Tree>
void query(benchmark::State& run) {
  const Tree tree(points(run.range(0) != 0));
  test::Random random(2);
  std::vector<Vec2> asked;
  for (int i = 0; i < 100000; ++i) asked.push_back(random.vector(0, 1));
  for (auto _ : run)
    for (const Vec2& p : asked) benchmark::DoNotOptimize(tree.nearest(p, 0.01));
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(asked.size()));
}

BENCHMARK_TEMPLATE(build, KdTree)
    ->ArgName("in_order")
    ->Arg(1)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(build, BoxTree<2>)
    ->ArgName("in_order")
    ->Arg(1)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(query, KdTree)
    ->ArgName("in_order")
    ->Arg(1)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(query, BoxTree<2>)
    ->ArgName("in_order")
    ->Arg(1)
    ->Arg(0)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
