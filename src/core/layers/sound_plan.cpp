#include "core/layers/sound_plan.h"

#include <algorithm>
#include <vector>

namespace winslow {

namespace {

bool corner_valid(const Vec2& p, const Vec2& next, const Vec2& previous) {
  const Vec2 a = next - p, b = previous - p;
  return a.x() * b.y() - a.y() * b.x() > 0;
}

/// Columns whose layers, laid out, have an inverted element between them.
std::vector<std::size_t> crossing_columns(const LayerStack& stack, const Coordinates& x) {
  const auto points = [&](const LayerColumn& column) {
    std::vector<Vec2> all{x.xy(column.wall_node)};
    for (std::size_t k = 0; k < column.count(); ++k) {
      all.push_back(all.back() + wanted_length(column, k) * column.direction);
    }
    return all;
  };
  std::vector<std::size_t> crossing;
  for (const ColumnPair& pair : stack.pairs) {
    const auto a = points(stack.columns[pair.left]), b = points(stack.columns[pair.right]);
    bool good = true;
    for (std::size_t k = 0; k + 1 < std::max(a.size(), b.size()) && good; ++k) {
      // At a shorter column's rim, and at the wall under a fan, the element is a triangle.
      std::vector<Vec2> corners{a[std::min(k, a.size() - 1)], b[std::min(k, b.size() - 1)]};
      if (corners[0] == corners[1]) corners.pop_back();
      if (k + 1 < b.size()) corners.push_back(b[k + 1]);
      if (k + 1 < a.size()) corners.push_back(a[k + 1]);
      const std::size_t n = corners.size();
      for (std::size_t c = 0; c < n; ++c) {
        good = good && corner_valid(corners[c], corners[(c + 1) % n], corners[(c + n - 1) % n]);
      }
    }
    if (good) continue;
    crossing.push_back(pair.left);
    crossing.push_back(pair.right);
  }
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  return crossing;
}

}  // namespace

LayerStack sound_plan(const Mesh& mesh, const LayerOptions& options) {
  constexpr int most_rounds = 60;
  LayerStack stack = plan_layers(mesh, options);
  for (int round = 0; round < most_rounds; ++round) {
    const auto crossing = crossing_columns(stack, mesh.coordinates);
    if (crossing.empty()) break;
    take_room(stack, crossing, 0.8, LayerLimit::crossing, options, mesh.coordinates);
  }
  return stack;
}

}  // namespace winslow
