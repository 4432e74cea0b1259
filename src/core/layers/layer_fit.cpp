#include "core/layers/layer_fit.h"

#include "core/layers/clearance.h"

namespace winslow {

namespace {

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Room for the columns of layers between walls that have moved.
class Fitting {
 public:
  Fitting(const LayerStack& stack, const Topology& topology, const Coordinates& x,
          const Coordinates& moved)
      : stack_(stack), topology_(topology), x_(x), moved_(moved) {}

  LayerStack fit() {
    const auto stands = column_stands(stack_, moved_);
    for (std::size_t c = 0; c < stack_.columns.size(); ++c) {
      LayerColumn& column = stack_.columns[c];
      before_.push_back({column.direction, column.slant});
      column.direction = stands[c].direction;
      column.slant = stands[c].slant;
      granted_.push_back(sum(column.granted.empty() ? column.heights : column.granted));
      room_.push_back(granted_.back());
      limits_.push_back(LayerLimit::none);
    }
    keep_clear();
    keep_gentle();
    for (std::size_t c = 0; c < stack_.columns.size(); ++c) distribute(c);
    return std::move(stack_);
  }

 private:
  void limit(std::size_t c, double room, LayerLimit reason) {
    if (stack_.columns[c].prescribed || !(room < room_[c] * (1 - 1e-9))) return;
    room_[c] = room;
    limits_[c] = reason;
    changed_ = true;
  }

  /// A column takes no more of a gap than the rules of insertion give it, or than it had when it
  /// was inserted by other rules.
  void keep_clear() {
    const double share = LayerOptions{}.clearance;
    double tallest = 0;
    for (std::size_t c = 0; c < room_.size(); ++c) {
      tallest = std::max(tallest, room_[c] * std::max(stack_.columns[c].slant, before_[c].slant));
    }
    if (tallest == 0) return;
    const double reach = tallest / (2 * share);
    const Clearance earlier(topology_, x_, reach), now(topology_, moved_, reach);
    for (std::size_t c = 0; c < room_.size(); ++c) {
      const LayerColumn& column = stack_.columns[c];
      if (column.along_boundary || column.count() == 0) continue;
      double own = share;
      if (column.granted.empty()) {
        const double width = 2 * earlier.radius(column.wall_node, before_[c].direction);
        own = std::max(own, room_[c] * before_[c].slant / width);
      }
      const double width = 2 * now.radius(column.wall_node, column.direction);
      limit(c, own * width / column.slant, LayerLimit::clearance);
    }
  }

  /// Thickness changes no faster along the wall than the rules of insertion let it, or than it did.
  void keep_gentle() {
    constexpr int sweeps = 100;
    const double steepest = LayerOptions{}.steepest;
    const auto settle = [&](std::size_t a, std::size_t b) {
      const double length =
          (moved_.xy(stack_.columns[a].wall_node) - moved_.xy(stack_.columns[b].wall_node)).norm();
      const double step = std::max(steepest * length, granted_[a] - granted_[b]);
      limit(a, room_[b] + step, LayerLimit::neighbour);
    };
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      changed_ = false;
      for (const ColumnPair& pair : stack_.pairs) {
        settle(pair.left, pair.right);
        settle(pair.right, pair.left);
      }
      for (auto pair = stack_.pairs.rbegin(); pair != stack_.pairs.rend(); ++pair) {
        settle(pair->left, pair->right);
        settle(pair->right, pair->left);
      }
      if (!changed_) return;
    }
  }

  void distribute(std::size_t c) {
    LayerColumn& column = stack_.columns[c];
    if (column.count() == 0) return;
    if (limits_[c] == LayerLimit::none) {  // all that was granted
      if (column.granted.empty()) return;
      column.heights = std::move(column.granted);
      column.granted.clear();
      column.limit = column.granted_limit;
    } else {
      if (column.granted.empty()) {
        column.granted = column.heights;
        column.granted_limit = column.limit;
      }
      column.heights = thinned(column.granted, room_[c]);
      column.limit = limits_[c];
    }
    column.corrections.clear();  // they were of other heights
  }

  LayerStack stack_;
  const Topology& topology_;
  const Coordinates& x_;
  const Coordinates& moved_;
  std::vector<ColumnStand> before_;     // how the columns stood in x
  std::vector<double> granted_, room_;  // thickness of each column
  std::vector<LayerLimit> limits_;
  bool changed_ = false;
};

}  // namespace

std::vector<double> thinned(std::span<const double> heights, double thickness) {
  const double first = heights.front(), all = sum(heights);
  const double constant = first * static_cast<double>(heights.size());
  std::vector<double> result(heights.begin(), heights.end());
  if (thickness >= all) return result;
  if (constant >= all || thickness <= constant) {
    const double share = constant >= all ? thickness / all : thickness / constant;
    for (double& h : result) h = share * (constant >= all ? h : first);
    return result;
  }
  // first (h / first)^s, with s in [0, 1] so that they add up.
  const auto bent = [&](double s) {
    std::ranges::transform(heights, result.begin(),
                           [&](double h) { return first * std::pow(h / first, s); });
    return sum(result);
  };
  double low = 0, high = 1;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (bent(middle) > thickness ? high : low) = middle;
  }
  bent(low);
  return result;
}

LayerStack fitted_layers(const LayerStack& stack, const Topology& topology, const Coordinates& x,
                         const Coordinates& moved) {
  require_plane(topology, "layers");
  return Fitting(stack, topology, x, moved).fit();
}

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
