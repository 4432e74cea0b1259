#include "core/quality/wall_measures.h"

#include <unordered_map>

#include "core/search/box_tree.h"

namespace winslow {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<Wall> find_walls(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  require_plane(topology, "walls");
  std::vector<Wall> walls;
  std::unordered_map<Index, std::size_t> wall_of_node;
  for (const auto& loop : topology.boundary_loops()) {
    // With the elements on the left, a loop around the mesh turns left and one around a body right.
    if (!(signed_area2(mesh.coordinates, loop) < 0)) continue;
    for (const Index node : loop) wall_of_node[node] = walls.size();
    walls.push_back({loop, {}});
  }
  for (const Marker& marker : topology.markers()) {
    for (const Face& face : marker.faces) {
      const auto [a, b] = face.edge();
      const auto from = wall_of_node.find(a), to = wall_of_node.find(b);
      if (from == wall_of_node.end() || to == wall_of_node.end() || from->second != to->second)
        continue;
      auto& names = walls[from->second].markers;
      if (names.empty() || names.back() != marker.name) names.push_back(marker.name);
    }
  }
  return walls;
}

namespace {

/// The share-quantile of at least one value. Reorders the values; cheaper than sorting them.
double quantile(std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(std::floor(place));
  const auto at_place = values.begin() + below;
  std::nth_element(values.begin(), at_place, values.end());
  const double rest = place - static_cast<double>(below);
  if (rest == 0) return *at_place;
  return *at_place + rest * (*std::min_element(at_place + 1, values.end()) - *at_place);
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  Quantiles of;
  of.count = values.size();
  if (values.empty()) return of;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  of.min = *least;
  of.max = *most;
  of.low = quantile(values, 0.05);
  of.median = quantile(values, 0.5);
  of.high = quantile(values, 0.95);
  return of;
}

namespace {

/// Combines two values into one.
using Choice = std::function<double(double, double)>;

/// Combines two values with `choice`; if one is NaN, returns the other one.
double chosen(double a, double b, const Choice& choice) {
  if (std::isnan(a)) return b;
  return std::isnan(b) ? a : choice(a, b);
}

double larger(double a, double b) { return std::max(a, b); }
double mean(double a, double b) { return 0.5 * (a + b); }
double further_from_one(double a, double b) {
  return std::abs(std::log(a)) >= std::abs(std::log(b)) ? a : b;
}

/// Edge k of a wall, from node k to the next one, with the nodes of the wall before and after it.
struct WallEdge {
  WallEdge(const Wall& wall, std::size_t k) {
    const std::size_t n = wall.nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = wall.nodes[(k + n + i - 1) % n];
  }
  Index from() const { return nodes[1]; }
  Index to() const { return nodes[2]; }
  bool holds(Index node) const {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  }
  double distance(const PlanePoints& x, Index node) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
      least = std::min(least, segment_distance<2>(x[node], x[nodes[i]], x[nodes[i + 1]]));
    return least;
  }

  std::array<Index, 4> nodes{};
};

/// Height of the corner of the element that is opposite to an end of the edge; if that corner lies
/// on the wall, of the other corner off the edge; NaN if both lie on the wall.
double facing_height(const Topology& topology, const PlanePoints& x, const WallEdge& edge,
                     Index element, bool at_start) {
  const auto corners = topology.element(element);
  const std::size_t n = corners.size(), start = index_of(corners, edge.from());
  // Counter-clockwise: start, end, the corner opposite to the end, the corner opposite to the
  // start.
  const Index of_end = corners[(start + 2) % n], of_start = corners[(start + n - 1) % n];
  for (const Index node : at_start ? std::array{of_start, of_end} : std::array{of_end, of_start}) {
    if (!edge.holds(node)) return edge.distance(x, node);
  }
  return none;
}

Index element_at(const Topology& topology, const WallEdge& edge) {
  const auto face = topology.find_face(Face(edge.from(), edge.to()));
  return topology.edges()[at(*face)].elements[0];
}

/// Least angle between a normal and the edges that lead from a wall node into the mesh, degrees.
double least_tilt(const Topology& topology, const PlanePoints& x, Index node, const Vec2& normal) {
  if (normal.squaredNorm() == 0) return none;
  // The first and the last neighbour of a boundary node are those along the boundary.
  const auto row = topology.neighbours(node);
  double least = none;
  for (std::size_t k = 1; k + 1 < row.size(); ++k) {
    const Vec2 edge = x[row[k]] - x[node];
    const double tilt = degrees(std::abs(turn_between(normal, edge)));
    least = std::isnan(least) ? tilt : std::min(least, tilt);
  }
  return least;
}

/// Walks along a column of quadrilaterals, through opposite edges.
class Column {
 public:
  Column(const Topology& topology, const PlanePoints& x, std::array<Index, 2> edge, Index element)
      : topology_(topology), x_(x), edge_(edge), element_(element) {}

  struct Cell {
    Index element;
    double height;
  };
  /// The next cell; none at the end of the column.
  std::optional<Cell> next() {
    if (element_ < 0 || topology_.element_type(element_) != ElementType::quadrilateral) return {};
    const auto corners = topology_.element(element_);
    const std::size_t a = index_of(corners, edge_[0]), b = index_of(corners, edge_[1]);
    const std::size_t first = (a + 1) % 4 == b ? a : b;
    const std::array<Index, 2> opposite{corners[(first + 2) % 4], corners[(first + 3) % 4]};
    const Cell cell{element_, (middle(opposite) - middle(edge_)).norm()};
    const auto& across =
        topology_.edges()[at(*topology_.find_face(Face(opposite[0], opposite[1])))].elements;
    element_ = across[0] == element_ ? across[1] : across[0];
    edge_ = opposite;
    return cell;
  }

 private:
  Vec2 middle(const std::array<Index, 2>& edge) const { return 0.5 * (x_[edge[0]] + x_[edge[1]]); }

  const Topology& topology_;
  const PlanePoints& x_;
  std::array<Index, 2> edge_;  // the edge of the element towards the wall
  Index element_;
};

double larger_over_smaller(double a, double b) { return std::max(a, b) / std::min(a, b); }

}  // namespace

std::vector<double> first_heights(const Mesh& mesh, const Wall& wall) {
  const PlanePoints x(mesh.coordinates);
  const std::size_t n = wall.nodes.size();
  std::vector<double> heights(n, none);
  for (std::size_t k = 0; k < n; ++k) {
    const WallEdge edge(wall, k);
    const Index element = element_at(*mesh.topology, edge);
    for (const bool at_start : {true, false}) {
      double& height = heights[at_start ? k : (k + 1) % n];
      height = chosen(height, facing_height(*mesh.topology, x, edge, element, at_start), mean);
    }
  }
  return heights;
}

std::vector<double> wall_spacings(const Mesh& mesh, const Wall& wall) {
  const std::size_t n = wall.nodes.size();
  const auto place = [&](std::size_t k) { return mesh.coordinates.xy(wall.nodes[k % n]); };
  std::vector<double> spacings;
  for (std::size_t k = 0; k < n; ++k)
    spacings.push_back(0.5 *
                       ((place(k) - place(k + n - 1)).norm() + (place(k + 1) - place(k)).norm()));
  return spacings;
}

std::vector<double> first_edge_tilts(const Mesh& mesh, const Wall& wall) {
  const PlanePoints x(mesh.coordinates);
  const std::size_t n = wall.nodes.size();
  std::vector<double> tilts(n);
  for (std::size_t k = 0; k < n; ++k) {
    Vec2 normal(0, 0);
    for (const std::size_t from : {(k + n - 1) % n, k}) {
      const Vec2 edge = x[wall.nodes[(from + 1) % n]] - x[wall.nodes[from]];
      normal += Vec2(-edge.y(), edge.x()).normalized();
    }
    tilts[k] = least_tilt(*mesh.topology, x, wall.nodes[k], normal);
  }
  return tilts;
}

std::vector<NeighbourRatio> column_growth(const Mesh& mesh, const Wall& wall) {
  const PlanePoints x(mesh.coordinates);
  std::vector<NeighbourRatio> ratios;
  for (std::size_t k = 0; k < wall.nodes.size(); ++k) {
    const WallEdge edge(wall, k);
    Column column(*mesh.topology, x, {edge.from(), edge.to()}, element_at(*mesh.topology, edge));
    std::optional<Column::Cell> last = column.next();
    while (const std::optional<Column::Cell> cell = last ? column.next() : std::nullopt) {
      ratios.push_back(
          {{last->element, cell->element}, larger_over_smaller(cell->height, last->height)});
      last = cell;
    }
  }
  return ratios;
}

std::vector<NeighbourRatio> size_ratios(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  require_plane(topology, "sizes of elements");
  std::vector<double> areas(at(topology.element_count()));
  for (Index e = 0; e < topology.element_count(); ++e)
    areas[at(e)] = 0.5 * signed_area2(mesh.coordinates, topology.element(e));
  std::vector<NeighbourRatio> ratios;
  for (const Topology::Edge& edge : topology.edges()) {
    if (edge.elements[1] < 0) continue;
    const std::array<Index, 2> pair{edge.elements[0], edge.elements[1]};
    const double a = areas[at(pair[0])], b = areas[at(pair[1])];
    if (a > 0 && b > 0) ratios.push_back({pair, std::sqrt(larger_over_smaller(a, b))});
  }
  return ratios;
}

std::vector<double> values_of(std::span<const NeighbourRatio> ratios) {
  std::vector<double> values;
  values.reserve(ratios.size());
  for (const NeighbourRatio& ratio : ratios) values.push_back(ratio.value);
  return values;
}

Index WallReport::node_count() const {
  std::size_t count = 0;
  for (const WallMeasures& wall : walls) count += wall.wall.nodes.size();
  return static_cast<Index>(count);
}

WallReport measure_walls(const Mesh& mesh) {
  WallReport report;
  std::vector<double> heights, tilts, growths;
  const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  for (Wall& wall : find_walls(mesh)) {
    WallMeasures& of = report.walls.emplace_back();
    of.first_height = first_heights(mesh, wall);
    of.tilt = first_edge_tilts(mesh, wall);
    of.spacing = wall_spacings(mesh, wall);
    const std::vector<double> growth = values_of(column_growth(mesh, wall));
    of.growth = quantiles_of(growth);
    of.wall = std::move(wall);
    append(heights, of.first_height);
    append(tilts, of.tilt);
    append(growths, growth);
  }
  report.first_height = quantiles_of(std::move(heights));
  report.tilt = quantiles_of(std::move(tilts));
  report.growth = quantiles_of(std::move(growths));
  report.size_ratio = quantiles_of(values_of(size_ratios(mesh)));
  return report;
}

namespace {

/// In the order of the enumeration.
constexpr std::array infos{
    FieldInfo("first_height", "First height",
              "Height of the cells at the walls of bodies, in units of the mesh.", Better::larger,
              ColorRange::robust_both_sides, 0, {.judged = false, .unit = "units of the mesh"}),
    FieldInfo("first_height_ratio", "First height over before",
              "Height of the cells at the walls of bodies over what it was in the mesh that the "
              "present one is compared with. 1 is unchanged.",
              Better::smaller, ColorRange::around_one, 1.05,
              {.one_is_best = true, .judged = false}),
    FieldInfo("first_edge_tilt", "Tilt of the first edge",
              "Degrees by which the first edges off a wall deviate from its normal.",
              Better::smaller, ColorRange::from_zero, 20, {.unit = "degrees"}),
    FieldInfo("growth", "Growth off the wall",
              "Ratio of the heights of consecutive cells in the columns of quadrilaterals on a "
              "wall, the larger over the smaller; the larger of a cell's two.",
              Better::smaller, ColorRange::from_one, 1.3, {.judged = false}),
    FieldInfo("size_ratio", "Size ratio",
              "Square root of the ratio of the areas of an element and a neighbour, the larger "
              "over the smaller; the largest of its neighbours'.",
              Better::smaller, ColorRange::from_one, 2),
};

std::vector<double> empty_values(const Mesh& mesh) {
  return std::vector<double>(at(mesh.topology->element_count()), none);
}

std::vector<double> largest(const Mesh& mesh, std::span<const NeighbourRatio> ratios) {
  std::vector<double> values = empty_values(mesh);
  for (const NeighbourRatio& ratio : ratios)
    for (const Index e : ratio.elements) values[at(e)] = chosen(values[at(e)], ratio.value, larger);
  return values;
}

/// How to combine the values at the two ends of a wall edge, and those of several wall edges of one
/// element.
struct Choices {
  Choice of_ends, of_edges;
};

/// Values of elements with an edge on a wall. at_nodes(wall): values of its nodes.
template <typename AtNodes>
std::vector<double> over_walls(const Mesh& mesh, const AtNodes& at_nodes, const Choices& choices) {
  std::vector<double> values = empty_values(mesh);
  for (const Wall& wall : find_walls(mesh)) {
    const std::vector<double> list = at_nodes(wall);
    for (std::size_t i = 0; i < wall.nodes.size(); ++i) {
      const std::size_t j = (i + 1) % wall.nodes.size();
      double& value = values[at(element_at(*mesh.topology, WallEdge(wall, i)))];
      value = chosen(value, chosen(list[i], list[j], choices.of_ends), choices.of_edges);
    }
  }
  return values;
}

std::vector<double> height_ratios(const Mesh& mesh, const Wall& wall, const Coordinates& before) {
  std::vector<double> ratios = first_heights(mesh, wall);
  const std::vector<double> were = first_heights(Mesh{mesh.topology, before}, wall);
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    ratios[i] /= were[i];
    if (!(ratios[i] > 0) || !std::isfinite(ratios[i])) ratios[i] = none;
  }
  return ratios;
}

std::vector<double> growths(const Mesh& mesh) {
  std::vector<NeighbourRatio> all;
  for (const Wall& wall : find_walls(mesh)) {
    const auto of_wall = column_growth(mesh, wall);
    all.insert(all.end(), of_wall.begin(), of_wall.end());
  }
  return largest(mesh, all);
}

}  // namespace

const std::vector<WallField>& all_wall_fields() {
  static const std::vector<WallField> all = [] {
    std::vector<WallField> list;
    for (std::size_t i = 0; i < infos.size(); ++i) list.push_back(static_cast<WallField>(i));
    return list;
  }();
  return all;
}

const FieldInfo& wall_field_info(WallField field) { return infos[static_cast<std::size_t>(field)]; }

std::vector<double> element_values(const Mesh& mesh, WallField field, const Coordinates* before) {
  require_plane(*mesh.topology, "cells at walls");
  switch (field) {
    case WallField::first_height:
      return over_walls(mesh, [&](const Wall& wall) { return first_heights(mesh, wall); },
                        {mean, larger});
    case WallField::first_height_ratio:
      if (!before || before->size() != mesh.coordinates.size()) return empty_values(mesh);
      return over_walls(mesh, [&](const Wall& wall) { return height_ratios(mesh, wall, *before); },
                        {further_from_one, further_from_one});
    case WallField::first_edge_tilt:
      return over_walls(mesh, [&](const Wall& wall) { return first_edge_tilts(mesh, wall); },
                        {larger, larger});
    case WallField::growth:
      return growths(mesh);
    case WallField::size_ratio:
      return largest(mesh, size_ratios(mesh));
  }
  return empty_values(mesh);
}

}  // namespace winslow
