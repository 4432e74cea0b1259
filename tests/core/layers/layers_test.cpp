#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/command/command.h"
#include "core/command/history.h"
#include "core/error.h"
#include "core/layers/layer_detection.h"
#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

LayersCommand layers_at(const std::string& marker, const LayerSpacing& spacing) {
  LayersCommand command;
  command.layers.walls.push_back({{marker}, spacing});
  return command;
}

MeshState ring() { return make_state(make_mesh(annulus(32, 10, 1.2, Cells::triangles))); }

LayerSpacing thin() { return {8, 0.002, 1.3, 1.0, {}, false}; }

double area(const MeshState& state) {
  double sum = 0;
  for (Index e = 0; e < state.mesh.topology->element_count(); ++e) {
    sum += element_value(state.mesh, e, Metric::area);
  }
  return sum;
}

Index inverted(const MeshState& state) {
  return check_validity(*state.mesh.topology, state.mesh.coordinates).inverted;
}

/// Boundary edges, as they are in markers.
std::map<std::string, std::set<std::array<Index, 2>>> edges_of(const Topology& topology) {
  std::map<std::string, std::set<std::array<Index, 2>>> all;
  for (const Marker& marker : topology.markers()) {
    for (const Face& edge : marker.faces) all[marker.name].insert(edge.edge());
  }
  return all;
}

}  // namespace

TEST_CASE("layers around a circle: heights and angles as asked, the boundary as it was") {
  const MeshState before = ring();
  const CommandResult result = execute(layers_at("inner", thin()), before);
  const Topology& topology = *result.state.mesh.topology;
  CHECK(result.smooth.converged);
  CHECK(inverted(result.state) == 0);
  CHECK(topology.node_count() == before.mesh.topology->node_count() + 32 * 8);
  CHECK(topology.element_count() == before.mesh.topology->element_count() + 32 * 8);
  CHECK(edges_of(topology) == edges_of(*before.mesh.topology));
  for (const auto& loop : before.mesh.topology->boundary_loops()) {
    for (const Index node : loop) {
      CHECK(result.state.mesh.coordinates.xy(node) == before.mesh.coordinates.xy(node));
    }
  }
  CHECK(area(result.state) == doctest::Approx(area(before)).epsilon(1e-12));
  REQUIRE(result.state.layers);
  const LayerMeasures measures =
      measure_layers(*result.state.layers, result.state.mesh.coordinates);
  CHECK(measures.columns.size() == 32);
  CHECK(measures.spacing_error.max < 0.01);
  CHECK(measures.orthogonality.max < 1);
  CHECK(measures.cut_short == 0);
}

TEST_CASE("the tail of the solve with layers is quadratic") {
  const CommandResult result = execute(layers_at("inner", thin()), ring());
  const auto& history = result.smooth.history;
  int squared = 0;
  for (std::size_t k = 1; k < history.size(); ++k) {
    const double a = history[k - 1].residual, b = history[k].residual;
    // Within a run, not over the start of the next one.
    if (history[k].iteration != history[k - 1].iteration + 1) continue;
    if (a < 1e-2 && a > 1e-6 && b < 10 * a * a + 1e-12) ++squared;
  }
  CHECK(squared >= 1);
}

TEST_CASE("a sharp corner has a fan: several columns, triangles at the wall, none inverted") {
  const MeshState before = make_state(make_mesh(square_with_hole(20, Cells::triangles)));
  const CommandResult result = execute(layers_at("hole", {6, 0.002, 1.3, 1, {}, false}), before);
  CHECK(inverted(result.state) == 0);
  std::map<Index, int> columns;
  for (const LayerColumn& column : result.state.layers->columns) ++columns[column.wall_node];
  int fans = 0;
  for (const auto& [node, count] : columns) fans += count == 3 ? 1 : 0;
  CHECK(fans == 4);  // the corners of the hole turn by 90 degrees: two sectors of 45
  CHECK(measure_layers(*result.state.layers, result.state.mesh.coordinates).first_error.max < 0.02);

  LayersCommand plain = layers_at("hole", {6, 0.002, 1.3, 1, {}, false});
  plain.layers.fans = false;
  const CommandResult without = execute(plain, before);
  CHECK(inverted(without.state) == 0);
  CHECK(without.state.layers->columns.size() == columns.size());
}

TEST_CASE(
    "single columns: a corner without its fan, one with more, one without layers, a thinner one") {
  const MeshState before = make_state(make_mesh(square_with_hole(20, Cells::triangles)));
  LayersCommand command = layers_at("hole", {6, 0.002, 1.3, 1, {}, false});
  std::map<Index, int> by_rules;
  for (const LayerColumn& c : plan_layers(before.mesh, command.layers).columns)
    ++by_rules[c.wall_node];
  std::vector<Index> corners, others;
  for (const auto& [node, count] : by_rules) (count == 3 ? corners : others).push_back(node);
  REQUIRE(corners.size() == 4);
  command.layers.overrides = {{corners[0], 1, std::nullopt},
                              {corners[1], 5, std::nullopt},
                              {corners[2], 1, 0.0},
                              {others[0], std::nullopt, 0.004}};
  const CommandResult result = execute(command, before);
  CHECK(inverted(result.state) == 0);
  std::map<Index, std::vector<double>> thicknesses;
  for (const LayerColumn& c : result.state.layers->columns)
    thicknesses[c.wall_node].push_back(c.thickness());
  CHECK(thicknesses[corners[0]].size() == 1);
  CHECK(thicknesses[corners[1]].size() == 5);
  CHECK(thicknesses[corners[2]] == std::vector<double>{0});
  CHECK(thicknesses[corners[3]].size() == 3);
  CHECK(thicknesses[others[0]][0] == doctest::Approx(0.004));
  CHECK(thicknesses[corners[1]][0] > 0.02);  // 6 layers of .002 / 1.3 are .0255 thick
}

TEST_CASE("part of a marker: layers where both ends of an edge are in the box, none elsewhere") {
  const MeshState before = ring();
  LayersCommand command = layers_at("inner", thin());
  command.layers.walls[0].part.xmin = -1e-9;
  const CommandResult result = execute(command, before);
  CHECK(inverted(result.state) == 0);
  const Coordinates& x = result.state.mesh.coordinates;
  int with = 0;
  for (const LayerColumn& column : result.state.layers->columns) {
    CHECK(x.xy(column.wall_node).x() >= -1e-9);
    with += column.count() > 0 ? 1 : 0;
  }
  CHECK(with == 15);  // of 32 nodes 17 lie in the half plane; layers run out at the two ends
  CHECK(result.state.mesh.topology->markers().unmarked_faces() == 0);
  CHECK(edges_of(*result.state.mesh.topology).at("inner") ==
        edges_of(*before.mesh.topology).at("inner"));

  // The other half with layers of its own: the same marker twice.
  LayersCommand both = command;
  both.layers.walls.push_back({{"inner"}, {4, 0.004, 1.2, 1, {}, false}, {-9, 1e-9, -9, 9}});
  const CommandResult whole = execute(both, before);
  CHECK(inverted(whole.state) == 0);
  CHECK(whole.state.layers->columns.size() == 32);
  std::set<std::size_t> counts;
  for (const LayerColumn& column : whole.state.layers->columns) counts.insert(column.count());
  CHECK(counts == std::set<std::size_t>{4, 8});

  command.layers.walls[0].part.xmin = 100;
  CHECK_THROWS_WITH_AS(execute(command, before),
                       "no edge of marker 'inner' lies in the part of it that is to have layers",
                       UsageError);
  command.layers.walls[0].part.xmax = 99;
  CHECK_THROWS_AS(execute(command, before), UsageError);
}

TEST_CASE("a column may be thicker than the room that the rules see; its neighbours follow rules") {
  const MeshState before = ring();
  LayersCommand command = layers_at("inner", thin());
  command.layers.clearance = 0.005;  // hardly any room
  const LayerStack tight = plan_layers(before.mesh, command.layers);
  const LayerColumn& first = tight.columns.front();
  REQUIRE(first.limit == LayerLimit::clearance);
  const double wanted = 4 * first.thickness();
  command.layers.overrides = {{first.wall_node, std::nullopt, wanted}};
  const LayerStack plan = plan_layers(before.mesh, command.layers);
  CHECK(plan.columns[0].thickness() == doctest::Approx(wanted));
  CHECK(plan.columns[0].limit == LayerLimit::none);
  CHECK(plan.columns[1].thickness() == doctest::Approx(tight.columns[1].thickness()));
}

TEST_CASE("overrides that cannot be are refused, and say of which node") {
  const MeshState before = make_state(make_mesh(square_with_hole(12, Cells::triangles)));
  const auto says = [&](std::vector<ColumnOverride> overrides, const char* what) {
    LayersCommand command = layers_at("hole", thin());
    command.layers.overrides = std::move(overrides);
    CHECK_THROWS_WITH_AS(plan_layers(before.mesh, command.layers), what, UsageError);
  };
  const LayerStack plan = plan_layers(before.mesh, layers_at("hole", thin()).layers);
  std::map<Index, int> count;
  for (const LayerColumn& c : plan.columns) ++count[c.wall_node];
  const auto flat = std::ranges::find_if(count, [](const auto& c) { return c.second == 1; })->first;
  const std::string node = "node " + std::to_string(flat);
  says({{flat, 3, std::nullopt}},
       (node + " cannot have several columns: the wall is not a convex corner there").c_str());
  says({{flat, std::nullopt, std::nullopt}},
       (node + ": neither a number of columns nor a thickness is given").c_str());
  says({{flat, 0, std::nullopt}}, (node + ": the number of columns must be 1 to 20").c_str());
  says({{flat, std::nullopt, -1.0}},
       (node + ": the thickness of a column must be finite and not negative").c_str());
  says({{flat, 1, std::nullopt}, {flat, std::nullopt, 0.1}},
       (node + " is given columns of its own twice").c_str());
  const Index far = before.mesh.topology->markers()[0].name == "hole"
                        ? before.mesh.topology->markers()[1].faces[0][0]
                        : before.mesh.topology->markers()[0].faces[0][0];
  says({{far, 1, std::nullopt}},
       ("node " + std::to_string(far) + " is given columns of its own, but is on none of the walls")
           .c_str());
}

TEST_CASE("a wall that ends at other boundaries: its end columns lie on them") {
  for (const Cells cells : {Cells::triangles, Cells::quads}) {
    CAPTURE(name_of(cells));
    const MeshState before = make_state(make_mesh(square(10, cells)));
    const CommandResult result =
        execute(layers_at("bottom", {5, 0.004, 1.2, 1, {}, false}), before);
    CHECK(inverted(result.state) == 0);
    CHECK(area(result.state) == doctest::Approx(1).epsilon(1e-12));
    const auto edges = edges_of(*result.state.mesh.topology);
    CHECK(edges.at("bottom") == edges_of(*before.mesh.topology).at("bottom"));
    CHECK(edges.at("left").size() == 15);
    CHECK(edges.at("right").size() == 15);
    for (const auto& [a, b] : edges.at("left")) {
      CHECK(result.state.mesh.coordinates.xy(a).x() == 0);
      CHECK(result.state.mesh.coordinates.xy(b).x() == 0);
    }
    CHECK(result.state.mesh.topology->markers().unmarked_faces() == 0);
    CHECK(measure_layers(*result.state.layers, result.state.mesh.coordinates).first_error.max <
          0.01);
  }
}

TEST_CASE("walls in a narrow gap share it") {
  const MeshState before = make_state(make_mesh(square(10, Cells::triangles)));
  LayersCommand command;
  command.layers.walls.push_back({{"bottom", "top"}, {10, 0.01, 1.3, 1, {}, false}});  // 0.43 thick
  const CommandResult result = execute(command, before);
  CHECK(inverted(result.state) == 0);
  for (const LayerColumn& column : result.state.layers->columns) {
    CHECK(column.thickness() <= 0.35 + 1e-9);
    if (column.count() > 0) CHECK(column.heights[0] == doctest::Approx(0.01));
  }
  CHECK(measure_layers(*result.state.layers, result.state.mesh.coordinates).cut_short > 0);
}

TEST_CASE("two walls with layers of their own go over into one another") {
  const MeshState before = make_state(make_mesh(square(20, Cells::triangles)));
  LayersCommand command;
  command.layers.walls.push_back({{"bottom"}, {6, 0.001, 1.2, 1, {}, false}});
  command.layers.walls.push_back({{"right"}, {4, 0.004, 1.2, 1, {}, false}});
  const CommandResult result = execute(command, before);
  CHECK(inverted(result.state) == 0);
  const auto& columns = result.state.layers->columns;
  CHECK(columns[2].heights[0] == doctest::Approx(0.001).epsilon(0.01));
  CHECK(columns[columns.size() - 3].heights[0] == doctest::Approx(0.004).epsilon(0.01));
  for (std::size_t c = 1; c < columns.size(); ++c) {
    if (columns[c].count() == 0 || columns[c - 1].count() == 0) continue;
    CHECK(columns[c].heights[0] / columns[c - 1].heights[0] < 1.5);
  }
}

TEST_CASE("layers are kept when the wall moves and when its shape changes") {
  const MeshState layered = execute(layers_at("inner", thin()), ring()).state;
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.rotate = 40;
  move.bodies[0].motion.translate = Vec2(0.5, 0.2);
  const CommandResult moved = execute(move, layered);
  CHECK(inverted(moved.state) == 0);
  CHECK(measure_layers(*moved.state.layers, moved.state.mesh.coordinates).spacing_error.max < 0.01);
  DeformCommand deform;
  deform.markers = {"inner"};
  SineDeformation sine;
  sine.amplitude = 0.15;
  deform.shape = sine;
  const CommandResult deformed = execute(deform, layered);
  CHECK(inverted(deformed.state) == 0);
  CHECK(measure_layers(*deformed.state.layers, deformed.state.mesh.coordinates).first_error.max <
        0.05);
}

TEST_CASE("a motion of held layers ends before a limit of the quality, too") {
  const MeshState layered = execute(layers_at("inner", thin()), ring()).state;
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.rotate = 60;
  const auto sine = [](const MeshState& state) {
    return check_validity(*state.mesh.topology, state.mesh.coordinates).min_sine;
  };
  const CommandResult whole = execute(move, layered);
  REQUIRE(whole.smooth.fraction_reached == 1);
  const double limit = 0.5 * (sine(layered) + sine(whole.state));
  REQUIRE(limit > sine(whole.state));
  move.how.floor.set(Metric::normalized_jacobian, limit);
  const CommandResult limited = execute(move, layered);
  CHECK(limited.smooth.fraction_reached > 0.05);
  CHECK(limited.smooth.fraction_reached < 1);
  CHECK_FALSE(limited.smooth.limited_by.empty());
  CHECK(sine(limited.state) >= limit);
}

TEST_CASE("undo of an insertion gives back the mesh without layers, to the bit") {
  const MeshState before = ring();
  History history(before);
  const Command command = layers_at("inner", thin());
  history.push(command, execute(command, history.state()));
  CHECK(history.state().layers);
  history.undo();
  CHECK(history.state().mesh.topology == before.mesh.topology);
  CHECK(history.state().mesh.coordinates == before.mesh.coordinates);
  CHECK(!history.state().layers);
}

TEST_CASE("the same layers at one and at several threads") {
  LayersCommand command = layers_at("inner", thin());
  command.smooth.threads = 1;
  const CommandResult one = execute(command, ring());
  command.smooth.threads = 3;
  const CommandResult three = execute(command, ring());
  CHECK(one.state.mesh.coordinates == three.state.mesh.coordinates);
}

TEST_CASE("what cannot have layers is refused, and said why") {
  CHECK_THROWS_AS(execute(layers_at("nothing", thin()), ring()), UsageError);
  CHECK_THROWS_AS(execute(LayersCommand{}, ring()), UsageError);
  LayersCommand twice = layers_at("inner", thin());
  twice.layers.walls.push_back({{"inner"}, thin()});
  CHECK_THROWS_AS(execute(twice, ring()), UsageError);
  LayersCommand thick = layers_at("inner", {5, 100, 1.2, 1, {}, false});
  CHECK_THROWS_AS(execute(thick, ring()), UsageError);
  MeshState tangled = ring();
  Random random(7);
  tangle(tangled.mesh, random);
  CHECK_THROWS_AS(execute(layers_at("inner", thin()), tangled), UsageError);
}

TEST_CASE("pure smoothing of inserted layers: valid, with all layers everywhere") {
  LayersCommand command;
  command.layers.walls.push_back({{"outer", "hole"}, {3, 0.05, 1, 1, {}, false}});
  command.control = false;
  const CommandResult result =
      execute(command, make_state(make_mesh(square_with_hole(10, Cells::quads))));
  CHECK(inverted(result.state) == 0);
  CHECK(result.smooth.converged);
  for (const LayerColumn& column : result.state.layers->columns) CHECK(column.count() == 3);
}

TEST_CASE("layers that a mesh has are found as they were inserted, fans included") {
  struct Case {
    MeshState state;
    std::string marker;
  };
  for (const Case& c : {Case{ring(), "inner"},
                        Case{make_state(make_mesh(square_with_hole(20, Cells::triangles))), "hole"},
                        Case{make_state(make_mesh(square(10, Cells::triangles))), "bottom"}}) {
    CAPTURE(c.marker);
    const LayersCommand command = layers_at(c.marker, {6, 0.002, 1.3, 1, {}, false});
    const MeshState layered = execute(command, c.state).state;
    const LayerStack found = detect_layers(layered.mesh, command.layers);
    REQUIRE(found.columns.size() == layered.layers->columns.size());
    CHECK(found.layer_of_element == layered.layers->layer_of_element);
    for (std::size_t k = 0; k < found.columns.size(); ++k) {
      CHECK(found.columns[k].nodes == layered.layers->columns[k].nodes);
      CHECK(found.columns[k].along_boundary == layered.layers->columns[k].along_boundary);
    }
  }
}

TEST_CASE("columns stand on the wall as it is, whichever way a body was turned") {
  const MeshState layered = execute(layers_at("hole", {6, 0.002, 1.3, 1, {}, false}),
                                    make_state(make_mesh(square_with_hole(20, Cells::triangles))))
                                .state;
  Coordinates turned = layered.mesh.coordinates;
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Index i = 0; i < turned.size(); ++i) {
    const Vec2 p = turned.xy(i);
    turned.set_xy(i, Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  }
  const auto before = column_stands(*layered.layers, layered.mesh.coordinates);
  const auto after = column_stands(*layered.layers, turned);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const Vec2 d = before[k].direction;
    CHECK((after[k].direction - Vec2(c * d.x() - s * d.y(), s * d.x() + c * d.y())).norm() < 1e-12);
    CHECK(after[k].slant == doctest::Approx(before[k].slant));
  }
}

TEST_CASE("layers of a mesh get other heights, and keep them while the wall moves") {
  const LayersCommand command = layers_at("inner", thin());
  MeshState read = make_state(execute(command, ring()).state.mesh);  // as from a file: no VCVs
  LayersCommand respace = layers_at("inner", {8, 0.0005, 1.4, 1, {}, false});
  respace.task = LayerTask::respace;
  const CommandResult finer = execute(respace, read);
  CHECK(inverted(finer.state) == 0);
  CHECK(finer.state.mesh.topology == read.mesh.topology);
  const LayerMeasures measures = measure_layers(*finer.state.layers, finer.state.mesh.coordinates);
  CHECK(measures.spacing_error.max < 0.01);
  CHECK(measures.first_height.avg == doctest::Approx(0.0005).epsilon(0.01));

  LayersCommand hold = layers_at("inner", thin());
  hold.task = LayerTask::hold;
  const MeshState held = execute(hold, read).state;
  MoveCommand move;
  move.bodies[0].markers = {"inner"};
  move.bodies[0].motion.rotate = 60;
  move.bodies[0].motion.translate = Vec2(0.5, 0);
  const CommandResult moved = execute(move, held);
  CHECK(inverted(moved.state) == 0);
  CHECK(measure_layers(*moved.state.layers, moved.state.mesh.coordinates).spacing_error.max < 0.01);
  // The heights that it keeps are those of the mesh as read.
  CHECK(moved.state.layers->columns[0].heights[0] == doctest::Approx(0.002).epsilon(0.01));

  LayersCommand none = layers_at("outer", thin());
  none.task = LayerTask::hold;
  CHECK_THROWS_AS(execute(none, read), UsageError);
}
