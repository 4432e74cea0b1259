#include "core/quality/wall_measures.h"

#include <unordered_map>

#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// With the elements on the left, loops around them turn left and loops around bodies right.
bool bounds_a_body(const PlanePoints& x, const std::vector<Index>& loop) {
  const Vec2 origin = x[loop.front()];  // far from the true one, areas would cancel
  double area2 = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 a = x[loop[k]] - origin, b = x[loop[(k + 1) % loop.size()]] - origin;
    area2 += a.x() * b.y() - a.y() * b.x();
  }
  return area2 < 0;
}

}  // namespace

std::vector<Wall> find_walls(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  require_plane(topology, "walls");
  const PlanePoints x(mesh.coordinates);
  std::vector<Wall> walls;
  std::unordered_map<Index, std::size_t> wall_of_node;
  for (const auto& loop : topology.boundary_loops()) {
    if (!bounds_a_body(x, loop)) continue;
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

/// Reorders the values, of which there is at least one. Cheaper than to sort them all.
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

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Signed area of the parallelogram between two vectors.
double spanned(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Edge k of a wall, from node k to the next, with the wall's nodes before and after it.
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

std::size_t place_in(std::span<const Index> element, Index node) {
  return static_cast<std::size_t>(std::find(element.begin(), element.end(), node) -
                                  element.begin());
}

/// Height of the corner that faces an end of the edge; NaN if it is on the wall, and so is the
/// other one.
double facing_height(const Topology& topology, const PlanePoints& x, const WallEdge& edge,
                     Index element, bool at_start) {
  const auto corners = topology.element(element);
  const std::size_t n = corners.size(), start = place_in(corners, edge.from());
  // Counter-clockwise from the start: its end, then what faces the end, then what faces the start.
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

double mean_of_known(double a, double b) {
  if (std::isnan(a)) return b;
  return std::isnan(b) ? a : 0.5 * (a + b);
}

/// Least angle between a normal and the edges that lead from a wall node into the mesh, degrees.
double least_tilt(const Topology& topology, const PlanePoints& x, Index node, const Vec2& normal) {
  if (normal.squaredNorm() == 0) return none;
  // The first and the last neighbour of a boundary node are those along the boundary.
  const auto row = topology.neighbours(node);
  double least = none;
  for (std::size_t k = 1; k + 1 < row.size(); ++k) {
    const Vec2 edge = x[row[k]] - x[node];
    const double tilt = degrees(std::atan2(std::abs(spanned(normal, edge)), normal.dot(edge)));
    least = std::isnan(least) ? tilt : std::min(least, tilt);
  }
  return least;
}

/// Walks from quadrilateral to quadrilateral over opposite edges.
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
    const std::size_t a = place_in(corners, edge_[0]), b = place_in(corners, edge_[1]);
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
  std::array<Index, 2> edge_;  // by which the element is entered
  Index element_;
};

double larger_over_smaller(double a, double b) { return std::max(a, b) / std::min(a, b); }

double area_of(const PlanePoints& x, std::span<const Index> element) {
  const Vec2 origin = x[element[0]];
  double area2 = 0;
  for (std::size_t k = 1; k + 1 < element.size(); ++k)
    area2 += spanned(x[element[k]] - origin, x[element[k + 1]] - origin);
  return 0.5 * area2;
}

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
      height = mean_of_known(height, facing_height(*mesh.topology, x, edge, element, at_start));
    }
  }
  return heights;
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
  const PlanePoints x(mesh.coordinates);
  std::vector<double> areas(at(topology.element_count()));
  for (Index e = 0; e < topology.element_count(); ++e)
    areas[at(e)] = area_of(x, topology.element(e));
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

}  // namespace winslow
