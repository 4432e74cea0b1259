#include "core/quality/wall_measures.h"

#include <unordered_map>

#include "core/quality/space_walls.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool in_space(const Mesh& mesh) { return mesh.topology->kind() == MeshKind::volume; }

}  // namespace

std::vector<Wall> find_walls(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  if (in_space(mesh)) return find_space_walls(mesh);
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

/// Combines the values at the nodes of an edge or face; without values NaN.
using NodeChoice = double (*)(std::span<const double>);

double largest_of(std::span<const double> values) {
  return values.empty() ? none : *std::ranges::max_element(values);
}
double mean_of_values(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? none : sum / static_cast<double>(values.size());
}
double furthest_from_one(std::span<const double> values) {
  double furthest = none;
  for (const double value : values) furthest = chosen(furthest, value, further_from_one);
  return furthest;
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
  if (in_space(mesh)) return space_first_heights(mesh, wall);
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
  if (in_space(mesh)) return space_wall_spacings(mesh, wall);
  const std::size_t n = wall.nodes.size();
  const auto place = [&](std::size_t k) { return mesh.coordinates.xy(wall.nodes[k % n]); };
  std::vector<double> spacings;
  for (std::size_t k = 0; k < n; ++k)
    spacings.push_back(0.5 *
                       ((place(k) - place(k + n - 1)).norm() + (place(k + 1) - place(k)).norm()));
  return spacings;
}

std::vector<double> first_edge_tilts(const Mesh& mesh, const Wall& wall) {
  if (in_space(mesh)) return space_first_edge_tilts(mesh, wall);
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
  if (in_space(mesh)) return space_column_growth(mesh, wall, faces_of_elements(*mesh.topology));
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

std::vector<NeighbourRatio> size_ratios(const Mesh& mesh, int threads) {
  if (in_space(mesh)) return space_size_ratios(mesh, threads);
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

WallReport measure_walls(const Mesh& mesh) { return WallSurvey(mesh).report(); }

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
              "wall, in space of prisms and hexahedra, the larger over the smaller; the larger of "
              "a cell's two.",
              Better::smaller, ColorRange::from_one, 1.3, {.judged = false}),
    FieldInfo("size_ratio", "Size ratio",
              "Square root of the ratio of the areas of an element and a neighbour, in space cube "
              "root of that of the volumes, the larger over the smaller; the largest of its "
              "neighbours'.",
              Better::smaller, ColorRange::from_one, 2),
};

std::vector<double> empty_values(const Mesh& mesh) {
  return std::vector<double>(at(mesh.topology->element_count()), none);
}

void add_largest(std::span<const NeighbourRatio> ratios, std::vector<double>& values) {
  for (const NeighbourRatio& ratio : ratios)
    for (const Index e : ratio.elements) values[at(e)] = chosen(values[at(e)], ratio.value, larger);
}

/// Calls visit(element, numbers) for each edge or face of a wall, with the numbers of its nodes on
/// the wall.
template <typename Visit>
void for_elements_at(const Mesh& mesh, const Wall& wall, const Visit& visit) {
  if (in_space(mesh)) {
    std::vector<std::size_t> numbers;
    for (const SurfaceFace& face : wall.faces) {
      numbers.clear();
      for (const Index node : face.nodes) numbers.push_back(at(number_on_wall(wall, node)));
      visit(face.element, numbers);
    }
    return;
  }
  const std::size_t n = wall.nodes.size();
  for (std::size_t i = 0; i < n; ++i)
    visit(element_at(*mesh.topology, WallEdge(wall, i)), std::array{i, (i + 1) % n});
}

/// How to combine the values at the nodes of a wall edge or face, and those of several of these of
/// one element.
struct Choices {
  NodeChoice of_nodes;
  Choice of_faces;
};

/// Values of elements with an edge or a face on a wall. at_nodes: values of its nodes, by wall.
std::vector<double> over_walls(const Mesh& mesh, std::span<const Wall> walls,
                               std::span<const std::vector<double>> at_nodes,
                               const Choices& choices) {
  std::vector<double> values = empty_values(mesh);
  std::vector<double> list;
  for (std::size_t w = 0; w < walls.size(); ++w)
    for_elements_at(mesh, walls[w], [&](Index element, std::span<const std::size_t> numbers) {
      list.clear();
      for (const std::size_t i : numbers)
        if (!std::isnan(at_nodes[w][i])) list.push_back(at_nodes[w][i]);
      double& value = values[at(element)];
      value = chosen(value, choices.of_nodes(list), choices.of_faces);
    });
  return values;
}

/// of(wall) for each wall.
template <typename Of>
auto for_each_wall(std::span<const Wall> walls, const Of& of) {
  std::vector<decltype(of(walls[0]))> lists;
  for (const Wall& wall : walls) lists.push_back(of(wall));
  return lists;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
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
  return WallSurvey(mesh).element_values(field, before);
}

WallSurvey::WallSurvey(const Mesh& mesh, int threads)
    : mesh_(mesh), threads_(threads), walls_(find_walls(mesh)) {}

const WallSurvey::Lists& WallSurvey::heights() {
  if (!heights_)
    heights_ = for_each_wall(walls_, [&](const Wall& wall) { return first_heights(mesh_, wall); });
  return *heights_;
}

const WallSurvey::Lists& WallSurvey::tilts() {
  if (!tilts_)
    tilts_ = for_each_wall(walls_, [&](const Wall& wall) { return first_edge_tilts(mesh_, wall); });
  return *tilts_;
}

const std::vector<std::vector<NeighbourRatio>>& WallSurvey::growths() {
  if (growths_) return *growths_;
  const bool space = in_space(mesh_) && !walls_.empty();
  const CompressedRows faces = space ? faces_of_elements(*mesh_.topology) : CompressedRows();
  growths_ = for_each_wall(walls_, [&](const Wall& wall) {
    return space ? space_column_growth(mesh_, wall, faces) : column_growth(mesh_, wall);
  });
  return *growths_;
}

const std::vector<NeighbourRatio>& WallSurvey::sizes() {
  if (!sizes_) sizes_ = size_ratios(mesh_, threads_);
  return *sizes_;
}

WallSurvey::Lists WallSurvey::height_ratios(const Coordinates& before) {
  Lists ratios = heights();
  const Mesh earlier{mesh_.topology, before};
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const std::vector<double> were = first_heights(earlier, walls_[w]);
    for (std::size_t i = 0; i < were.size(); ++i) {
      double& ratio = ratios[w][i];
      ratio /= were[i];
      if (!(ratio > 0) || !std::isfinite(ratio)) ratio = none;
    }
  }
  return ratios;
}

WallReport WallSurvey::report() {
  WallReport report;
  std::vector<double> all_heights, all_tilts, all_growths;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    WallMeasures& of = report.walls.emplace_back();
    of.wall = walls_[w];
    of.first_height = heights()[w];
    of.tilt = tilts()[w];
    of.spacing = wall_spacings(mesh_, walls_[w]);
    const std::vector<double> growth = values_of(growths()[w]);
    of.growth = quantiles_of(growth);
    append(all_heights, of.first_height);
    append(all_tilts, of.tilt);
    append(all_growths, growth);
  }
  report.first_height = quantiles_of(std::move(all_heights));
  report.tilt = quantiles_of(std::move(all_tilts));
  report.growth = quantiles_of(std::move(all_growths));
  report.size_ratio = quantiles_of(values_of(sizes()));
  return report;
}

std::vector<double> WallSurvey::element_values(WallField field, const Coordinates* before) {
  std::vector<double> values = empty_values(mesh_);
  switch (field) {
    case WallField::first_height:
      return over_walls(mesh_, walls_, heights(), {mean_of_values, larger});
    case WallField::first_height_ratio:
      if (!before || before->size() != mesh_.coordinates.size()) return values;
      return over_walls(mesh_, walls_, height_ratios(*before),
                        {furthest_from_one, further_from_one});
    case WallField::first_edge_tilt:
      return over_walls(mesh_, walls_, tilts(), {largest_of, larger});
    case WallField::growth:
      for (const auto& of_wall : growths()) add_largest(of_wall, values);
      return values;
    case WallField::size_ratio:
      add_largest(sizes(), values);
      return values;
  }
  return values;
}

}  // namespace winslow
