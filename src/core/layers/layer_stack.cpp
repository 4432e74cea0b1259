#include "core/layers/layer_stack.h"

#include "core/error.h"

namespace winslow {

namespace {

Vec2 rotated(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

void lay_out(const LayerColumn& column, const ColumnStand& stand, double scale, Coordinates& x) {
  const Vec2 wall = x.xy(column.wall_node);
  if (!column.bends.empty()) {
    Vec2 tip = wall;
    for (std::size_t k = 0; k < column.count(); ++k) {
      tip += scale * column.heights[k] * stand.slant * rotated(stand.direction, column.bends[k]);
      x.set_xy(column.nodes[k + 1], tip);
    }
    return;
  }
  double height = 0;
  for (std::size_t k = 0; k < column.count(); ++k) {
    height += column.heights[k];
    x.set_xy(column.nodes[k + 1], wall + scale * height * stand.slant * stand.direction);
  }
}

/// The columns beside each one; none at the end of a wall.
struct Beside {
  std::optional<std::size_t> left, right;
};

std::vector<Beside> neighbours_of_columns(const LayerStack& stack) {
  std::vector<Beside> beside(stack.columns.size());
  for (const ColumnPair& pair : stack.pairs) {
    beside[pair.left].right = pair.right;
    beside[pair.right].left = pair.left;
  }
  return beside;
}

}  // namespace

std::string_view limit_name(LayerLimit limit) {
  constexpr std::array<std::string_view, 6> names{"none",      "clearance", "crossing",
                                                  "neighbour", "end",       "room"};
  return names[static_cast<std::size_t>(limit)];
}

std::string_view end_name(LayerEnd end) {
  constexpr std::array<std::string_view, 9> names{"none",      "elements",   "boundary",
                                                  "meeting",   "isotropic",  "growth",
                                                  "clearance", "neighbours", "count"};
  return names[static_cast<std::size_t>(end)];
}

std::vector<ColumnStand> stand_on(const Vec2& arriving, const Vec2& leaving, std::size_t count) {
  // Positive where the wall turns away from the elements: a convex corner.
  const double turning =
      -std::atan2(arriving.x() * leaving.y() - arriving.y() * leaving.x(), arriving.dot(leaving));
  const Vec2 normal = Vec2(-arriving.y(), arriving.x()).normalized();
  std::vector<ColumnStand> stands;
  if (count == 1) {
    constexpr double most_slant = 3;  // in corners sharper than about 39 degrees
    stands.push_back(
        {rotated(normal, -0.5 * turning), 1 / std::max(std::cos(0.5 * turning), 1 / most_slant)});
    return stands;
  }
  const auto sectors = static_cast<double>(count - 1);
  for (std::size_t k = 0; k < count; ++k) {
    stands.push_back({rotated(normal, -turning * static_cast<double>(k) / sectors), 1});
  }
  return stands;
}

std::vector<ColumnStand> column_stands(const LayerStack& stack, const Coordinates& x) {
  const auto& columns = stack.columns;
  const std::vector<Beside> beside = neighbours_of_columns(stack);
  const auto wall = [&](std::size_t c) { return x.xy(columns[c].wall_node); };
  const auto same_node = [&](const std::optional<std::size_t>& a, std::size_t b) {
    return a && columns[*a].wall_node == columns[b].wall_node;
  };
  std::vector<ColumnStand> stands;
  for (const LayerColumn& column : columns) stands.push_back({column.direction, column.slant});
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (columns[c].along_boundary && columns[c].count() > 0 && columns[c].bends.empty()) {
      stands[c].direction = (x.xy(columns[c].rim()) - wall(c)).normalized();
    }
    if (!columns[c].bends.empty() && !beside[c].left != !beside[c].right) {  // one wall edge
      const Vec2 along = beside[c].left ? Vec2(wall(c) - wall(*beside[c].left))
                                        : Vec2(wall(*beside[c].right) - wall(c));
      stands[c] = stand_on(along, along, 1).front();
      continue;
    }
    if (!beside[c].left || same_node(beside[c].left, c)) continue;  // an end, or not a fan's first
    std::vector<std::size_t> fan{c};
    while (same_node(beside[fan.back()].right, c)) fan.push_back(*beside[fan.back()].right);
    if (!beside[fan.back()].right) continue;
    const auto found = stand_on(wall(c) - wall(*beside[c].left),
                                wall(*beside[fan.back()].right) - wall(c), fan.size());
    for (std::size_t k = 0; k < fan.size(); ++k) stands[fan[k]] = found[k];
  }
  return stands;
}

void lay_out(const LayerStack& stack, double scale, Coordinates& x) {
  for (const LayerColumn& column : stack.columns) {
    lay_out(column, {column.direction, column.slant}, scale, x);
  }
}

Coordinates straight_columns(const LayerStack& stack, const Coordinates& x) {
  Coordinates straight = x;
  const std::vector<ColumnStand> stands = column_stands(stack, x);
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    const LayerColumn& column = stack.columns[c];
    // One that was found on a boundary has the course of that boundary, wherever this is now.
    if (column.along_boundary && !column.bends.empty()) continue;
    lay_out(column, stands[c], 1, straight);
  }
  return straight;
}

void validate(std::span<const ColumnOverride> overrides) {
  constexpr int most_columns = 20;
  std::vector<Index> nodes;
  for (const ColumnOverride& own : overrides) {
    const auto require = [&](bool good, const char* what) {
      if (!good) throw UsageError("node " + std::to_string(own.node) + ": " + what);
    };
    require(own.columns || own.thickness, "neither a number of columns nor a thickness is given");
    require(!own.columns || (*own.columns >= 1 && *own.columns <= most_columns),
            "the number of columns must be 1 to 20");
    require(!own.thickness || (std::isfinite(*own.thickness) && *own.thickness >= 0),
            "the thickness of a column must be finite and not negative");
    nodes.push_back(own.node);
  }
  std::ranges::sort(nodes);
  const auto twice = std::ranges::adjacent_find(nodes);
  if (twice != nodes.end()) {
    throw UsageError("node " + std::to_string(*twice) + " is given columns of its own twice");
  }
}

void require_columns(std::span<const ColumnOverride> overrides, const LayerStack& stack) {
  for (const ColumnOverride& own : overrides) {
    const bool found =
        std::ranges::find(stack.columns, own.node, &LayerColumn::wall_node) != stack.columns.end();
    if (found) continue;
    throw UsageError("node " + std::to_string(own.node) +
                     " is given columns of its own, but is on none of the walls");
  }
}

}  // namespace winslow
