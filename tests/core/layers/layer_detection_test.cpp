#include "core/layers/layer_detection.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/command/command.h"
#include "core/error.h"
#include "core/layers/layer_stack.h"
#include "support/layered_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr Cut all_cuts[] = {Cut::none, Cut::forward, Cut::backward, Cut::alternating};

LayerOptions at_walls(std::vector<std::string> markers, int most = 1000) {
  LayerOptions options;
  LayerSpacing spacing;
  spacing.count = most;
  options.walls.push_back({std::move(markers), spacing});
  return options;
}

/// Rows of a grid around a unit circle until one is less than twice as wide as high.
std::size_t stretched_rows(const std::vector<double>& distance, int sectors) {
  std::size_t k = 0;
  for (; k + 1 < distance.size(); ++k) {
    const double chord = 2 * std::sin(pi / sectors);  // of the unit circle
    const double width = chord * (1 + 0.5 * (distance[k] + distance[k + 1]));
    if (width < 2 * (distance[k + 1] - distance[k])) break;
  }
  return k;
}

/// Nodes of all columns.
std::set<std::vector<Index>> columns_of(const LayerStack& stack) {
  std::set<std::vector<Index>> nodes;
  for (const LayerColumn& column : stack.columns) nodes.insert(column.nodes);
  return nodes;
}

std::map<LayerEnd, int> ends_of(const LayerStack& stack) {
  std::map<LayerEnd, int> ends;
  for (const LayerColumn& column : stack.columns) ++ends[column.end];
  return ends;
}

/// The state after the layers were held and the wall was turned.
CommandResult turned(const Mesh& mesh, double degrees) {
  LayersCommand hold;
  hold.task = LayerTask::hold;
  hold.layers = at_walls({"wall"});
  MoveCommand move;
  move.bodies[0].markers = {"wall"};
  move.bodies[0].motion.rotate = degrees;
  return execute(move, execute(hold, make_state(mesh)).state);
}

}  // namespace

TEST_CASE("the layers of an O-grid are found up to where cells are no longer stretched") {
  const auto distance = distances(32, 1e-3, 1.3, 32);
  const std::size_t rows = stretched_rows(distance, 64);
  REQUIRE(rows > 8);
  REQUIRE(rows < 24);
  for (const Cut cut : all_cuts) {
    CAPTURE(name_of(cut));
    const Mesh mesh = make_mesh(o_grid(64, distance, cut));
    const LayerStack found = climb_layers(mesh, at_walls({"wall"}), LayerExtent::stretched);
    REQUIRE(found.columns.size() == 64);
    for (const LayerColumn& column : found.columns) {
      REQUIRE(column.nodes.size() == rows + 1);
      CHECK(column.end == LayerEnd::isotropic);
      for (std::size_t k = 0; k <= rows; ++k) {
        CHECK(column.nodes[k] == column.wall_node + 64 * static_cast<Index>(k));
      }
    }
    const auto in_layers =
        std::ranges::count_if(found.layer_of_element, [](int l) { return l >= 0; });
    CHECK(in_layers == static_cast<std::ptrdiff_t>(rows * 64 * (cut == Cut::none ? 1 : 2)));
  }
}

TEST_CASE("where cells along the wall are of different lengths, columns have different rows") {
  const auto distance = distances(36, 5e-4, 1.25, 36);
  const Mesh quads = make_mesh(o_grid(80, distance, Cut::none, 0.2));
  const LayerStack found = climb_layers(quads, at_walls({"wall"}), LayerExtent::stretched);
  std::set<std::size_t> counts;
  std::size_t fewest = 100;
  for (const LayerColumn& column : found.columns) {
    counts.insert(column.nodes.size() - 1);
    fewest = std::min(fewest, column.nodes.size() - 1);
  }
  CHECK(counts.size() > 3);
  CHECK(fewest > 0);
  for (const ColumnPair& pair : found.pairs) {  // no step of more than two rows, of strips
    const auto a = static_cast<int>(found.columns[pair.left].nodes.size());
    const auto b = static_cast<int>(found.columns[pair.right].nodes.size());
    CHECK(std::abs(a - b) <= 4);
  }
  for (const Cut cut : all_cuts) {
    CAPTURE(name_of(cut));
    const Mesh mesh = make_mesh(o_grid(80, distance, cut, 0.2));
    CHECK(columns_of(climb_layers(mesh, at_walls({"wall"}), LayerExtent::stretched)) ==
          columns_of(found));
  }
}

TEST_CASE("a C-grid: at the trailing edge a column for either side, none along the wake") {
  const auto distance = distances(40, 2e-4, 1.25, 40);
  std::set<std::vector<Index>> of_quads;
  for (const Cut cut : all_cuts) {
    CAPTURE(name_of(cut));
    const Mesh mesh = make_mesh(c_grid(60, distance, cut));
    REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
    const LayerStack found = climb_layers(mesh, at_walls({"wall"}), LayerExtent::stretched);
    CHECK(found.columns.size() == 61);  // 60 nodes of the wall, the sharp one twice
    CHECK(found.pairs.size() == 60);
    std::map<Index, int> columns;
    for (const LayerColumn& column : found.columns) {
      ++columns[column.wall_node];
      CHECK(column.nodes.size() > 3);
    }
    CHECK(columns.size() == 60);
    if (cut == Cut::none) of_quads = columns_of(found);
    CHECK(columns_of(found) == of_quads);
  }
}

TEST_CASE("layers end where heights stop growing") {
  const auto distance = distances(40, 1e-3, 1.3, 7);  // rows 0 to 6 grow, those above do not
  for (const Cut cut : all_cuts) {
    CAPTURE(name_of(cut));
    const Mesh mesh = make_mesh(o_grid(48, distance, cut));
    const LayerStack found = climb_layers(mesh, at_walls({"wall"}), LayerExtent::stretched);
    for (const LayerColumn& column : found.columns) CHECK(column.nodes.size() == 7 + 1);
    CHECK(ends_of(found) == std::map<LayerEnd, int>{{LayerEnd::growth, 48}});
  }
}

TEST_CASE("layers between two walls take no more than their share of the gap") {
  MeshData data;
  const auto half = distances(6, 0.01, 1.3, 6);
  constexpr Index cells = 12;
  const double height = 2 * half.back();
  std::vector<double> y(half);
  for (std::size_t k = half.size() - 1; k-- > 0;) y.push_back(height - half[k]);
  for (const double v : y) {
    for (Index i = 0; i <= cells; ++i) data.coordinates.push_xy({0.5 * i, v});
  }
  for (Index k = 0; k + 1 < static_cast<Index>(y.size()); ++k) {
    for (Index i = 0; i < cells; ++i) {
      const Index a = k * (cells + 1) + i, b = a + cells + 1;
      add_quad(data, a, a + 1, b + 1, b);
    }
  }
  mark_boundary(data, [&](const Vec2& p) {
    return p.y() < 1e-9 ? "low" : p.y() > height - 1e-9 ? "high" : "ends";
  });
  const Mesh mesh = make_mesh(data);
  for (const auto& walls : {std::vector<std::string>{"low", "high"}, {"low"}}) {
    LayerOptions options = at_walls(walls);
    std::map<Index, int> uses;
    const auto rows_with = [&](double clearance) {
      options.clearance = clearance;
      uses.clear();
      const LayerStack found = climb_layers(mesh, options, LayerExtent::stretched);
      std::set<std::size_t> rows;
      for (const LayerColumn& column : found.columns) {
        rows.insert(column.nodes.size() - 1);
        for (const Index node : column.nodes) ++uses[node];
      }
      return rows;
    };
    // Four rows are .0619 thick, five .0904, the gap is .2551 wide: .35 of it are .0893.
    CHECK(*rows_with(0.35).begin() == 4);
    // Up to the middle, where heights begin to shrink, or the other wall's layers are met.
    const auto most = rows_with(0.499);
    CHECK(*most.begin() >= 5);
    CHECK(*most.rbegin() <= 6);
    for (const auto& [node, count] : uses) CHECK(count == 1);
  }
}

TEST_CASE("a hybrid mesh: layers end at the triangles") {
  LayersCommand insert;
  insert.layers = at_walls({"inner"});
  insert.layers.walls[0].spacing = {8, 0.002, 1.3, 1.0, {}, false};
  const MeshState layered =
      execute(insert, make_state(make_mesh(annulus(32, 10, 1.2, Cells::triangles)))).state;
  const LayerStack found = climb_layers(layered.mesh, at_walls({"inner"}), LayerExtent::stretched);
  CHECK(found.layer_of_element == layered.layers->layer_of_element);
  for (const LayerColumn& column : found.columns) CHECK(column.nodes.size() == 8 + 1);
}

TEST_CASE("a mesh without layers has none, and it is said why") {
  const auto says = [](const MeshData& data, const std::string& marker, const char* what) {
    CHECK_THROWS_WITH_AS(detect_layers(make_mesh(data), at_walls({marker})), what, UsageError);
  };
  says(annulus(32, 8, 1.2, Cells::quads), "inner",
       "the mesh has no layers at 'inner': its elements are less than twice as long as high");
  for (const MeshData& data : {annulus(32, 8, 1.2, Cells::triangles), conformal_annulus(24, 6)}) {
    CHECK_THROWS_WITH_AS(detect_layers(make_mesh(data), at_walls({"inner"})),
                         doctest::Contains("the mesh has no layers at 'inner': "), UsageError);
  }
  says(o_grid(24, distances(60, 0.02, 1, 1), Cut::none), "wall",
       "the mesh has no layers at 'wall': the heights of its elements do not grow from there");
}

TEST_CASE("layers that are held keep all heights while their wall turns") {
  struct Case {
    const char* name;
    MeshData data;
  };
  const auto distance = distances(40, 2e-4, 1.25, 40);
  for (const Cut cut : all_cuts) {
    for (const Case& c : {Case{"circle", o_grid(48, distance, cut)},
                          Case{"ellipse", o_grid(80, distance, cut, 0.2)},
                          Case{"C-grid", c_grid(60, distance, cut)}}) {
      const std::string name = c.name;
      CAPTURE(name);
      CAPTURE(name_of(cut));
      const Mesh mesh = make_mesh(c.data);
      REQUIRE(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
      const CommandResult result = turned(mesh, 20);
      CHECK(result.smooth.converged);
      CHECK(check_validity(*mesh.topology, result.state.mesh.coordinates).inverted == 0);
      const Coordinates& before = mesh.coordinates;
      const Coordinates& after = result.state.mesh.coordinates;
      double worst = 0;
      for (const LayerColumn& column : result.state.layers->columns) {
        for (std::size_t k = 0; k + 1 < column.nodes.size(); ++k) {
          const Index a = column.nodes[k], b = column.nodes[k + 1];
          const double was = (before.xy(b) - before.xy(a)).norm();
          worst = std::max(worst, std::abs((after.xy(b) - after.xy(a)).norm() / was - 1));
        }
      }
      CHECK(worst < 0.01);
    }
  }
}

TEST_CASE("holding layers leaves the mesh as it is, to the bit") {
  const Mesh mesh = make_mesh(o_grid(48, distances(30, 1e-3, 1.25, 30), Cut::none, 0.3));
  LayersCommand hold;
  hold.task = LayerTask::hold;
  hold.layers = at_walls({"wall"});
  const CommandResult held = execute(hold, make_state(mesh));
  CHECK(held.state.mesh.coordinates == mesh.coordinates);
  CHECK(held.smooth.converged);
  CHECK(measure_layers(*held.state.layers, mesh.coordinates).spacing_error.max < 1e-12);
  const Coordinates laid_out = straight_columns(*held.state.layers, mesh.coordinates);
  CHECK(largest_difference(laid_out, mesh.coordinates) < 1e-12);
}
