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

void lay_out_in_space(const LayerColumn& column, double scale, Coordinates& x) {
  const Vec3 wall = x.xyz(column.wall_node);
  double height = 0;
  for (std::size_t k = 0; k < column.count(); ++k) {
    height += column.heights[k];
    x.set_xyz(column.nodes[k + 1], wall + scale * height * column.slant * column.direction);
  }
}

/// The neighbours of a column; none at the end of a wall.
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
  // Positive at a convex corner, where the wall turns away from the elements.
  const double turning = -turn_between(arriving, leaving);
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
  for (const LayerColumn& column : columns)
    stands.push_back({column.plane_direction(), column.slant});
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
    if (!beside[c].left || same_node(beside[c].left, c)) continue;  // not the first of a fan
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
    if (x.dimension() == 3) {
      lay_out_in_space(column, scale, x);
    } else {
      lay_out(column, {column.plane_direction(), column.slant}, scale, x);
    }
  }
}

Coordinates straight_columns(const LayerStack& stack, const Coordinates& x) {
  Coordinates straight = x;
  const std::vector<ColumnStand> stands = column_stands(stack, x);
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    const LayerColumn& column = stack.columns[c];
    // A column that was found on a boundary keeps the course of that boundary.
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

namespace {

/// Normal of the wall at each column: the sum of the unit normals of its wall edges; zero inside a
/// fan.
std::vector<Vec2> wall_normals(const LayerStack& stack, const Coordinates& x) {
  std::vector<Vec2> normals(stack.columns.size(), Vec2(0, 0));
  for (const ColumnPair& pair : stack.pairs) {
    const Vec2 edge =
        x.xy(stack.columns[pair.right].wall_node) - x.xy(stack.columns[pair.left].wall_node);
    if (edge.squaredNorm() == 0) continue;
    const Vec2 normal = Vec2(-edge.y(), edge.x()).normalized();
    normals[pair.left] += normal;
    normals[pair.right] += normal;
  }
  return normals;
}

ColumnMeasure measure(const LayerColumn& column, const Vec2& normal, const Coordinates& x) {
  ColumnMeasure m;
  for (std::size_t k = 0; k < column.count(); ++k) {
    const double length = (x.xy(column.nodes[k + 1]) - x.xy(column.nodes[k])).norm();
    const double error = std::abs(length / wanted_length(column, k) - 1);
    m.spacing_error = std::max(m.spacing_error, error);
    m.thickness += length / column.slant;
    if (k > 0) continue;
    m.first_error = error;
    m.first_height = length / column.slant;
  }
  if (column.count() > 0 && normal.squaredNorm() > 0 && !column.along_boundary) {
    const Vec2 first = x.xy(column.nodes[1]) - x.xy(column.nodes[0]);
    m.tilt = degrees(std::abs(turn_between(first, normal)));
  }
  return m;
}

}  // namespace

bool cut_short(const LayerColumn& column) { return column.thickness() < column.asked * (1 - 1e-3); }

LayerMeasures measure_layers(const LayerStack& stack, const Coordinates& x) {
  LayerMeasures m;
  const std::vector<Vec2> normals = wall_normals(stack, x);
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    m.columns.push_back(measure(stack.columns[c], normals[c], x));
    if (cut_short(stack.columns[c])) ++m.cut_short;
  }
  const auto all = [](const ColumnMeasure& c) { return c.thickness > 0; };
  const auto of = [&](double ColumnMeasure::*member, const auto& counts) {
    std::vector<double> values;
    for (const ColumnMeasure& column : m.columns)
      if (counts(column)) values.push_back(column.*member);
    return statistics_of(values);
  };
  m.first_height = of(&ColumnMeasure::first_height, all);
  m.thickness = of(&ColumnMeasure::thickness, all);
  m.spacing_error = of(&ColumnMeasure::spacing_error, all);
  m.first_error = of(&ColumnMeasure::first_error, all);
  m.orthogonality = of(&ColumnMeasure::tilt, [](const ColumnMeasure& c) { return c.tilt >= 0; });
  return m;
}

}  // namespace winslow
