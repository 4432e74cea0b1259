#include "core/layers/layer_measures.h"

namespace winslow {

namespace {

/// Normals of the wall under each column: the sum of the unit normals of the edges on which it
/// stands; zero inside a fan.
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
    m.tilt = degrees(
        std::atan2(std::abs(first.x() * normal.y() - first.y() * normal.x()), first.dot(normal)));
  }
  return m;
}

template <typename Value, typename Counts>
Statistics statistics(const std::vector<ColumnMeasure>& columns, const Value& value,
                      const Counts& counts) {
  Statistics s{std::numeric_limits<double>::infinity(), 0, 0};
  std::size_t n = 0;
  for (const ColumnMeasure& column : columns) {
    if (!counts(column)) continue;
    const double v = value(column);
    s.min = std::min(s.min, v);
    s.max = std::max(s.max, v);
    s.avg += v;
    ++n;
  }
  if (n == 0) return {};
  s.avg /= static_cast<double>(n);
  return s;
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
    return statistics(
        m.columns, [&](const ColumnMeasure& c) { return c.*member; }, counts);
  };
  m.first_height = of(&ColumnMeasure::first_height, all);
  m.thickness = of(&ColumnMeasure::thickness, all);
  m.spacing_error = of(&ColumnMeasure::spacing_error, all);
  m.first_error = of(&ColumnMeasure::first_error, all);
  m.orthogonality = of(&ColumnMeasure::tilt, [](const ColumnMeasure& c) { return c.tilt >= 0; });
  return m;
}

}  // namespace winslow
