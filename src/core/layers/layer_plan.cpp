#include "core/layers/layer_plan.h"

#include "core/error.h"
#include "core/layers/wall_chain.h"

namespace winslow {

namespace {

/// The wanted layers of a column, regardless of the room for them.
struct Wish {
  double first = 0, thickness = 0;
  int wall = 0;
};

/// Plans the columns of one chain and appends them to those of the chains before, in order.
class ChainPlanner {
 public:
  ChainPlanner(const Mesh& mesh, const LayerOptions& options, const WallChain& chain)
      : mesh_(mesh), options_(options), chain_(chain) {}

  void plan(LayerStack& stack) {
    make_wishes();
    const std::size_t first = stack.columns.size();
    for (std::size_t i = 0; i < chain_.nodes.size(); ++i) add_columns(i, stack);
    for (std::size_t c = first; c + 1 < stack.columns.size(); ++c) {
      stack.pairs.push_back({c, c + 1});
    }
    if (chain_.closed) stack.pairs.push_back({stack.columns.size() - 1, first});
  }

 private:
  Vec2 xy(Index node) const { return mesh_.coordinates.xy(node); }
  Index previous(std::size_t i) const {
    if (i > 0) return chain_.nodes[i - 1];
    return chain_.closed ? chain_.nodes.back() : chain_.before;
  }
  Index next(std::size_t i) const {
    if (i + 1 < chain_.nodes.size()) return chain_.nodes[i + 1];
    return chain_.closed ? chain_.nodes.front() : chain_.after;
  }
  bool is_end(std::size_t i) const {
    return !chain_.closed && (i == 0 || i + 1 == chain_.nodes.size());
  }

  /// Mean length of the edges of the chain at a node.
  double spacing_at(std::size_t i) const {
    const Vec2 p = xy(chain_.nodes[i]);
    const double back = (p - xy(previous(i))).norm(), forth = (xy(next(i)) - p).norm();
    if (chain_.closed) return 0.5 * (back + forth);
    if (i == 0) return forth;
    return i + 1 == chain_.nodes.size() ? back : 0.5 * (back + forth);
  }

  Wish wish_of(int wall, std::size_t i) const {
    const LayerSpacing& spacing = options_.walls[at(wall)].spacing;
    const auto heights = spacing.match_outside
                             ? layer_heights_ending_with(spacing, std::sqrt(0.75) * spacing_at(i))
                             : layer_heights(spacing);
    return {spacing.first, sum_of(heights), wall};
  }

  /// Sets the wishes of all nodes. Where two walls meet, heights change smoothly along the wall by
  /// diffusion of their logarithms, which does not change constant heights.
  void make_wishes() {
    const std::size_t n = chain_.nodes.size();
    const std::size_t edges = chain_.edge_count();
    bool several = false;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t after = std::min(i, edges - 1);
      const std::size_t before = i > 0 ? i - 1 : (chain_.closed ? edges - 1 : 0);
      const int a = static_cast<int>(chain_.wall[before]), b = static_cast<int>(chain_.wall[after]);
      Wish wish = wish_of(a, i);
      if (a != b) {
        several = true;
        const Wish other = wish_of(b, i);
        const bool more = options_.walls[at(b)].spacing.count > options_.walls[at(a)].spacing.count;
        wish = {std::sqrt(wish.first * other.first), std::sqrt(wish.thickness * other.thickness),
                more ? b : a};
      }
      wishes_.push_back(wish);
    }
    if (several) blend();
  }

  void blend() {
    constexpr int passes = 16;  // about 5 columns on either side
    const std::size_t n = wishes_.size();
    for (int pass = 0; pass < passes; ++pass) {
      const std::vector<Wish> old = wishes_;
      for (std::size_t i = 0; i < n; ++i) {
        if (is_end(i)) continue;
        const Wish &a = old[(i + n - 1) % n], &b = old[(i + 1) % n];
        wishes_[i].first = std::pow(a.first * b.first, 0.25) * std::sqrt(old[i].first);
        wishes_[i].thickness =
            std::pow(a.thickness * b.thickness, 0.25) * std::sqrt(old[i].thickness);
      }
    }
  }

  void add_columns(std::size_t i, LayerStack& stack) const {
    const Vec2 p = xy(chain_.nodes[i]);
    const Vec2 back = xy(previous(i)) - p, forth = xy(next(i)) - p;
    LayerColumn column;
    column.wall_node = chain_.nodes[i];
    column.wall = wishes_[i].wall;
    column.first = wishes_[i].first;
    column.asked = column.room = wishes_[i].thickness;
    const double angle = open_angle(back, forth);
    const ColumnOverride* own = override_of(column.wall_node);
    if (is_end(i)) return add_end(angle, i == 0 ? back : forth, column, own, stack);

    if (own && own->thickness) {
      column.prescribed = true;
      column.asked = column.room = *own->thickness;
    }
    const double turning = angle - pi;  // convex positive
    for (const ColumnStand& stand : stand_on(-back, forth, column_count(turning, own))) {
      set_stand(column, stand);
      stack.columns.push_back(column);
    }
  }

  const ColumnOverride* override_of(Index node) const {
    const auto own = std::ranges::find(options_.overrides, node, &ColumnOverride::node);
    return own == options_.overrides.end() ? nullptr : &*own;
  }

  std::size_t column_count(double turning, const ColumnOverride* own) const {
    constexpr double least_turning = 10;  // degrees; a fan on less has no width
    if (own && own->columns) {
      if (*own->columns > 1 && turning < radians(least_turning)) {
        throw UsageError("node " + std::to_string(own->node) +
                         " cannot have several columns: the wall is not a convex corner there");
      }
      return static_cast<std::size_t>(*own->columns);
    }
    if (!options_.fans || turning <= radians(options_.fan_threshold)) return 1;
    const long sectors = std::lround(turning / radians(options_.fan_angle));
    return static_cast<std::size_t>(std::max(1L, sectors)) + 1;
  }

  /// Adds the column at an end of the wall. It lies on the next boundary if the angle there is
  /// between 30 and 150 degrees; else it has no layers, and the layers of the wall end in a wedge.
  static void add_end(double angle, const Vec2& other, LayerColumn column,
                      const ColumnOverride* own, LayerStack& stack) {
    if (own && own->columns && *own->columns > 1) {
      throw UsageError("node " + std::to_string(own->node) +
                       " cannot have several columns: the wall ends there");
    }
    if (own && own->thickness) column.asked = column.room = std::min(column.room, *own->thickness);
    constexpr double most = 0.6;  // of the edge that it lies on
    column.along_boundary = angle > radians(30) && angle < radians(150);
    set_stand(column, {other.normalized(), column.along_boundary ? 1 / std::sin(angle) : 1});
    const double room = column.along_boundary ? most * other.norm() / column.slant : 0;
    if (room < column.room) {
      column.room = room;
      column.limit = LayerLimit::end;
    }
    stack.columns.push_back(std::move(column));
  }

  const Mesh& mesh_;
  const LayerOptions& options_;
  const WallChain& chain_;
  std::vector<Wish> wishes_;
};

/// Limits the room of columns. Rules only reduce the room, so they can be applied repeatedly and in
/// any order.
class RoomKeeper {
 public:
  RoomKeeper(LayerStack& stack, const LayerOptions& options, const Coordinates& x)
      : columns_(stack.columns), pairs_(stack.pairs), options_(options), x_(x) {}

  /// Limits layers on both sides of a gap to their shares of its width.
  void keep_clear(const Topology& topology) {
    double tallest = 0;
    for (const LayerColumn& c : columns_) tallest = std::max(tallest, c.room * c.slant);
    if (tallest == 0) return;
    const Clearance clearance(topology, x_, tallest / (2 * options_.clearance));
    for (LayerColumn& c : columns_) {
      if (c.along_boundary) continue;
      const double width = 2 * clearance.radius(c.wall_node, c.plane_direction());
      limit(c, options_.clearance * width / c.slant, LayerLimit::clearance);
    }
  }

  /// Limits columns that lean towards each other, so that their tips leave a part of the wall edge,
  /// and limits the change of thickness along the wall. Each limit may require another one, so the
  /// pairs are swept until nothing changes.
  void keep_gentle() {
    sweep_pairs(pairs_, [&](const ColumnPair& pair) {
      changed_ = false;
      settle(columns_[pair.left], columns_[pair.right]);
      return changed_;
    });
  }

  /// Sets the heights of all columns to fit their room.
  void distribute() {
    for (LayerColumn& c : columns_) {
      LayerSpacing spacing = options_.walls[at(c.wall)].spacing;
      spacing.first = c.first;
      if (options_.scale_all && c.room > 0) {
        c.heights = layer_heights_within(spacing, c.asked);
        for (double& h : c.heights) h *= c.room / c.asked;
      } else {
        c.heights = layer_heights_within(spacing, c.room);
      }
    }
  }

 private:
  void limit(LayerColumn& column, double room, LayerLimit reason) {
    if (column.prescribed) return;
    // Round-off is no reason for another sweep.
    if (!(room < column.room * (1 - 1e-9))) return;
    column.room = room;
    column.limit = reason;
    changed_ = true;
  }

  void settle(LayerColumn& a, LayerColumn& b) {
    const Vec2 edge = x_.xy(b.wall_node) - x_.xy(a.wall_node);
    const double length = edge.norm();
    const double step = options_.steepest * length;  // none within a fan
    limit(a, b.room + step, LayerLimit::neighbour);
    limit(b, a.room + step, LayerLimit::neighbour);
    if (length == 0) return;
    // The part of the edge that each column covers.
    const double of_a = std::max(0.0, a.room * a.slant * a.plane_direction().dot(edge) / length);
    const double of_b = std::max(0.0, -b.room * b.slant * b.plane_direction().dot(edge) / length);
    const double most = (1 - options_.crossing) * length;
    if (of_a + of_b <= most) return;
    const double scale = most / (of_a + of_b);
    if (of_a > 0) limit(a, a.room * scale, LayerLimit::crossing);
    if (of_b > 0) limit(b, b.room * scale, LayerLimit::crossing);
  }

  std::vector<LayerColumn>& columns_;
  const std::vector<ColumnPair>& pairs_;
  const LayerOptions& options_;
  const Coordinates& x_;
  bool changed_ = false;
};

/// Replaces the columns of a fan without room for layers by one column.
void collapse_empty_fans(LayerStack& stack) {
  for (std::size_t p = 0; p < stack.pairs.size();) {
    const auto [left, right] = stack.pairs[p];
    const LayerColumn &a = stack.columns[left], &b = stack.columns[right];
    if (a.wall_node != b.wall_node || !a.heights.empty()) {
      ++p;
      continue;
    }
    stack.columns.erase(stack.columns.begin() + static_cast<std::ptrdiff_t>(right));
    stack.pairs.erase(stack.pairs.begin() + static_cast<std::ptrdiff_t>(p));
    for (ColumnPair& pair : stack.pairs) {
      if (pair.left >= right) --pair.left;
      if (pair.right >= right) --pair.right;
    }
  }
}

void require(bool good, const char* what) {
  if (!good) throw UsageError(what);
}

}  // namespace

LayerOptions with_counts(LayerOptions options, const Mesh& mesh) {
  // Height of a regular triangle or tetrahedron, as a share of its edge.
  const double share = in_dimension(*mesh.topology, "layers", [](auto dimension) {
    return dimension == 2 ? std::sqrt(0.75) : std::sqrt(2.0 / 3);
  });
  for (LayerWall& wall : options.walls) {
    if (!wall.spacing.match_outside) continue;
    std::vector<double> lengths;
    for (const std::string& name : wall.markers) {
      const auto marker = mesh.topology->markers().find(name);
      if (!marker) continue;
      for (const Face& face : mesh.topology->markers()[at(*marker)].faces) {
        const std::size_t edges = face.size() == 2 ? 1 : face.size();
        for (std::size_t k = 0; k < edges; ++k) {
          const Vec3 p = place_of(mesh.coordinates, face[k]);
          const Vec3 q = place_of(mesh.coordinates, face[(k + 1) % face.size()]);
          if (wall.part.holds(p.head<2>()) && wall.part.holds(q.head<2>()))
            lengths.push_back((q - p).norm());
        }
      }
    }
    if (lengths.empty()) continue;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    wall.spacing.count = layers_until(wall.spacing, share * *middle);
  }
  return options;
}

void validate(const LayerOptions& options) {
  require(!options.walls.empty(), "no wall is given to insert layers at");
  for (const LayerWall& wall : options.walls) {
    require(!wall.markers.empty(), "a wall without markers");
    validate(wall.spacing);
    require(wall.part.xmin <= wall.part.xmax && wall.part.ymin <= wall.part.ymax,
            "the part of a wall that is to have layers ends before it begins");
  }
  LayerOptions copy = options;
  check(option_table(copy));
  validate(options.overrides);
}

LayerStack plan_layers(const Mesh& mesh, const LayerOptions& given) {
  validate(given);
  const LayerOptions options = with_counts(given, mesh);
  const std::vector<WallChain> chains = find_wall_chains(mesh, options.walls);
  LayerStack stack;
  for (const WallChain& chain : chains) ChainPlanner(mesh, options, chain).plan(stack);
  require_columns(options.overrides, stack);
  RoomKeeper keeper(stack, options, mesh.coordinates);
  keeper.keep_clear(*mesh.topology);
  keeper.keep_gentle();
  keeper.distribute();
  collapse_empty_fans(stack);
  return stack;
}

void reduce_room(LayerStack& stack, const std::vector<std::size_t>& columns, double factor,
                 LayerLimit limit, const LayerOptions& options, const Coordinates& x) {
  for (const std::size_t c : columns) {
    stack.columns[c].room *= factor;
    stack.columns[c].limit = limit;
  }
  RoomKeeper keeper(stack, options, x);
  keeper.keep_gentle();
  keeper.distribute();
  collapse_empty_fans(stack);
}

OptionTable option_table(LayerSpacing& spacing) {
  return {
      {.key = "count",
       .value = IntegerOption{&spacing.count, between(1, most_layers)},
       .label = "Count",
       .help = "Number of layers"},
      {.key = "first",
       .value = RealOption{&spacing.first, above(0)},
       .label = "First height",
       .help = "Height of the layer at the wall",
       .unit = "units of the mesh"},
      {.key = "ratio",
       .value = RealOption{&spacing.ratio, between(0.5, 10)},
       .label = "Ratio",
       .help = "Ratio of the second height to the first"},
      {.key = "growth",
       .value = RealOption{&spacing.growth, between(0.5, 2)},
       .label = "Growth",
       .help = "Factor of the ratio from layer to layer"},
      {.key = "total",
       .value = OptionalRealOption{&spacing.total, above(0)},
       .label = "Thickness",
       .help = "Thickness of all layers; gives the ratio",
       .unit = "units of the mesh"},
      {.key = "match_outside",
       .value = SwitchOption{&spacing.match_outside},
       .label = "Match the elements outside",
       .help = "As many layers as it takes until the last is as high as the elements outside"},
  };
}

OptionTable option_table(LayerOptions& options) {
  return {
      {.key = "fans",
       .value = SwitchOption{&options.fans, "no-fans",
                             "One column at sharp convex corners, too, instead of a fan"},
       .label = "Fans at sharp corners",
       .help = "Several columns at sharp convex corners, such as a trailing edge"},
      {.key = "fan_threshold",
       .value = RealOption{&options.fan_threshold, between(10, 180)},
       .label = "Fan threshold",
       .help = "Turning of the wall from which a corner gets a fan",
       .unit = "degrees",
       .applies = options.fans},
      {.key = "fan_angle",
       .value = RealOption{&options.fan_angle, between(10, 90)},
       .label = "Fan angle",
       .help = "Angle between neighbouring columns of a fan",
       .unit = "degrees",
       .applies = options.fans},
      {.key = "clearance",
       .value = RealOption{&options.clearance, inside(0, 0.5)},
       .label = "Clearance",
       .help = "Share of a gap's width that the layers of either side may take"},
      {.key = "crossing",
       .value = RealOption{&options.crossing, inside(0, 1)},
       .label = "Crossing",
       .help = "Share of a wall edge's length that has to be left of it at the rim of the layers"},
      {.key = "steepest",
       .value = RealOption{&options.steepest, {.low = 0, .high = 5, .low_included = false}},
       .label = "Steepest",
       .help = "Largest change of thickness along the wall, per length of wall"},
      {.key = "scale_all",
       .value = SwitchOption{&options.scale_all},
       .label = "Scale all heights",
       .help = "Where there is less room than asked, make all layers thinner, the first as well, "
               "instead of the outer ones"},
  };
}

namespace {

/// Fits the heights of columns to walls that have moved.
class Fitting {
 public:
  Fitting(const LayerStack& stack, const Topology& topology, const Coordinates& x,
          const Coordinates& moved)
      : stack_(stack), topology_(topology), x_(x), moved_(moved) {}

  LayerStack fit() {
    const auto stands = column_stands(stack_, moved_);
    for (std::size_t c = 0; c < stack_.columns.size(); ++c) {
      LayerColumn& column = stack_.columns[c];
      before_.push_back({column.plane_direction(), column.slant});
      set_stand(column, stands[c]);
      granted_.push_back(sum_of(column.granted.empty() ? column.heights : column.granted));
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

  /// Limits columns to the share of a gap that the rules of insertion give, or to their share
  /// before the motion if this is larger, as after an insertion by other rules.
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
      const double width = 2 * now.radius(column.wall_node, column.plane_direction());
      limit(c, own * width / column.slant, LayerLimit::clearance);
    }
  }

  /// Limits the change of thickness along the wall to that of the rules of insertion, or to the
  /// difference of the granted thicknesses if this is larger.
  void keep_gentle() {
    const double steepest = LayerOptions{}.steepest;
    const auto settle = [&](std::size_t a, std::size_t b) {
      const double length =
          (moved_.xy(stack_.columns[a].wall_node) - moved_.xy(stack_.columns[b].wall_node)).norm();
      const double step = std::max(steepest * length, granted_[a] - granted_[b]);
      limit(a, room_[b] + step, LayerLimit::neighbour);
    };
    sweep_pairs(stack_.pairs, [&](const ColumnPair& pair) {
      changed_ = false;
      settle(pair.left, pair.right);
      settle(pair.right, pair.left);
      return changed_;
    });
  }

  void distribute(std::size_t c) {
    LayerColumn& column = stack_.columns[c];
    if (column.count() == 0) return;
    if (limits_[c] == LayerLimit::none) {  // the granted heights again
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
    column.corrections.clear();  // they belong to the previous heights
  }

  LayerStack stack_;
  const Topology& topology_;
  const Coordinates& x_;
  const Coordinates& moved_;
  std::vector<ColumnStand> before_;     // directions and slants in x
  std::vector<double> granted_, room_;  // thickness of each column
  std::vector<LayerLimit> limits_;
  bool changed_ = false;
};

}  // namespace

std::vector<double> thinned(std::span<const double> heights, double thickness) {
  const double first = heights.front(), all = sum_of(heights);
  const double constant = first * static_cast<double>(heights.size());
  std::vector<double> result(heights.begin(), heights.end());
  if (thickness >= all) return result;
  if (constant >= all || thickness <= constant) {
    const double share = constant >= all ? thickness / all : thickness / constant;
    for (double& h : result) h = share * (constant >= all ? h : first);
    return result;
  }
  // Heights first (h / first)^s, with s in [0, 1] for the wanted sum.
  const auto bent = [&](double s) {
    std::ranges::transform(heights, result.begin(),
                           [&](double h) { return first * std::pow(h / first, s); });
    return sum_of(result);
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

/// Columns with an inverted element between them.
std::vector<std::size_t> crossing_columns(const LayerStack& stack, const Coordinates& x) {
  const auto points = [&](const LayerColumn& column) {
    std::vector<Vec2> all{x.xy(column.wall_node)};
    for (std::size_t k = 0; k < column.count(); ++k) {
      all.push_back(all.back() + wanted_length(column, k) * column.plane_direction());
    }
    return all;
  };
  std::vector<std::size_t> crossing;
  for (const ColumnPair& pair : stack.pairs) {
    const auto a = points(stack.columns[pair.left]), b = points(stack.columns[pair.right]);
    bool good = true;
    for (std::size_t k = 0; k + 1 < std::max(a.size(), b.size()) && good; ++k) {
      // The element is a triangle at the rim of a shorter column and at the wall in a fan.
      std::vector<Vec2> corners{a[std::min(k, a.size() - 1)], b[std::min(k, b.size() - 1)]};
      if (corners[0] == corners[1]) corners.pop_back();
      if (k + 1 < b.size()) corners.push_back(b[k + 1]);
      if (k + 1 < a.size()) corners.push_back(a[k + 1]);
      const std::size_t n = corners.size();
      for (std::size_t c = 0; c < n; ++c) {
        const Vec2 next = corners[(c + 1) % n] - corners[c];
        const Vec2 previous = corners[(c + n - 1) % n] - corners[c];
        good = good && cross(next, previous) > 0;
      }
    }
    if (good) continue;
    crossing.push_back(pair.left);
    crossing.push_back(pair.right);
  }
  sort_unique(crossing);
  return crossing;
}

}  // namespace

LayerStack sound_plan(const Mesh& mesh, const LayerOptions& options) {
  constexpr int most_rounds = 60;
  LayerStack stack = plan_layers(mesh, options);
  for (int round = 0; round < most_rounds; ++round) {
    const auto crossing = crossing_columns(stack, mesh.coordinates);
    if (crossing.empty()) break;
    reduce_room(stack, crossing, 0.8, LayerLimit::crossing, options, mesh.coordinates);
  }
  return stack;
}

}  // namespace winslow
