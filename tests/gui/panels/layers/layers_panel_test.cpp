#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// Selects a marker in the list and sees to it that the panel is open.
void open_panel(Rig& rig, const std::string& marker) {
  rig.click("marker/" + marker);
  rig.frames(3);
  if (!rig.visible("layers/insert") && !rig.visible("layers/status")) rig.click("section/layers");
  REQUIRE(rig.settle());  // what the plan comes to takes a line or two, above buttons
  // Where there are layers already, a card says so, and the settings are folded.
  if (!rig.visible("layers/insert")) {
    CHECK(rig.visible("layers/status"));
    rig.click("layers/open_insert");
    REQUIRE(rig.settle());
  }
  REQUIRE(rig.visible("layers/insert"));
}

void fill_spacing(Rig& rig, const std::string& count, const std::string& first) {
  rig.fill("layers/count", count);
  rig.fill("layers/first", first);
  REQUIRE(rig.settle());
}

void add_wall(Rig& rig, const std::string& marker, const std::string& count,
              const std::string& first) {
  open_panel(rig, marker);
  fill_spacing(rig, count, first);
  rig.click("layers/add_wall");
  rig.frames(3);
}

/// The tallest column on a marker; null: there is none with layers.
const LayerColumn* tallest(const Rig& rig, const LayerStack& stack, const std::string& marker) {
  const auto nodes = rig.session().topology()->markers().nodes(rig.marker(marker));
  const LayerColumn* found = nullptr;
  for (const LayerColumn& column : stack.columns)
    if (std::ranges::binary_search(nodes, column.wall_node) && column.count() > 0 &&
        (!found || column.count() > found->count()))
      found = &column;
  return found;
}

void check_layers(const Rig& rig, const LayerStack* stack, const std::string& marker,
                  std::size_t count, double first) {
  INFO(marker);
  REQUIRE(stack != nullptr);
  const LayerColumn* column = tallest(rig, *stack, marker);
  REQUIRE(column != nullptr);
  CHECK(column->count() == count);
  CHECK(column->heights.front() == doctest::Approx(first));
}

void insert(Rig& rig, const std::vector<std::string>& markers) {
  LayersCommand command;
  for (const std::string& marker : markers) {
    LayerWall wall{{marker}, {}};
    wall.spacing.count = 4;
    wall.spacing.first = 0.01;
    command.layers.walls.push_back(wall);
  }
  rig.bench->apply(action::RunCommand{command, false});
  REQUIRE(rig.settle());
  REQUIRE(rig.document().state().layers != nullptr);
}

const LayerStack* layers(const Rig& rig) { return rig.document().state().layers.get(); }

bool enabled(const Rig& rig, const std::string& widget) {
  const auto found = rig.bench->widgets().find(widget);
  return found && found->enabled;
}

}  // namespace

TEST_CASE("walls of a list have layers of their own, inserted together") {
  Rig rig(1280, 1500);
  rig.open(two_body_mesh());
  add_wall(rig, "left", "4", "0.01");
  add_wall(rig, "right", "3", "0.02");
  REQUIRE(rig.visible("layers/wall/1"));
  REQUIRE(rig.settle());
  check_layers(rig, rig.session().layers().preview().plan(), "left", 4, 0.01);
  check_layers(rig, rig.session().layers().preview().plan(), "right", 3, 0.02);

  // A wall of the list is selected by a click, and its settings can be changed again.
  rig.click("layers/wall/0");
  rig.frames(3);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("left")});
  CHECK_FALSE(rig.visible("layers/add_wall"));
  REQUIRE(rig.settle());
  check_layers(rig, rig.session().layers().preview().plan(), "left", 4, 0.01);
  rig.fill("layers/count", "5");
  REQUIRE(rig.settle());
  check_layers(rig, rig.session().layers().preview().plan(), "left", 5, 0.01);
  check_layers(rig, rig.session().layers().preview().plan(), "right", 3, 0.02);
  rig.bench->pictures().picture();

  rig.click("layers/insert");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  check_layers(rig, layers(rig), "left", 5, 0.01);
  check_layers(rig, layers(rig), "right", 3, 0.02);
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  CHECK(layers(rig) == nullptr);
}

TEST_CASE("walls are taken out of the list, and a marker is in one of them only") {
  Rig rig(1280, 1500);
  rig.open(two_body_mesh());
  const auto planned = [&] { return rig.session().layers().preview().wanted().value().walls; };
  add_wall(rig, "left", "4", "0.01");
  rig.bench->apply(action::SelectMarkers{{rig.marker("left"), rig.marker("right")}});
  rig.frames(3);
  fill_spacing(rig, "3", "0.01");
  rig.click("layers/add_wall");
  rig.frames(3);
  REQUIRE(planned().size() == 1);
  CHECK(planned()[0].markers.size() == 2);
  CHECK(planned()[0].spacing.count == 3);
  rig.click("layers/wall/0/remove");
  rig.frames(3);
  // The selection is the wall again.
  CHECK_FALSE(rig.visible("layers/wall/0"));
  CHECK(rig.visible("layers/add_wall"));
  rig.click("marker/right");
  rig.frames(3);
  REQUIRE(planned().size() == 1);
  CHECK(planned()[0].markers == std::vector<std::string>{"right"});
  // Another mesh has other walls.
  rig.click("layers/add_wall");
  rig.open(ring_mesh(), "ring.su2");
  open_panel(rig, "flap");
  CHECK_FALSE(rig.visible("layers/wall/0"));
}

TEST_CASE(
    "part of a wall: the box begins as that of the marker, and only what lies in it has layers") {
  Rig rig(1280, 1500);
  rig.open(two_body_mesh());
  open_panel(rig, "left");
  fill_spacing(rig, "4", "0.01");
  CHECK_FALSE(rig.visible("layers/xmin"));
  rig.click("layers/part");
  rig.frames(3);
  REQUIRE(rig.visible("layers/xmin"));
  const Mesh& mesh = rig.mesh();
  const auto nodes = mesh.topology->markers().nodes(rig.marker("left"));
  double low = 1e9, high = -1e9;
  for (const Index node : nodes) {
    low = std::min(low, mesh.coordinates.xy(node).y());
    high = std::max(high, mesh.coordinates.xy(node).y());
  }
  const WallPart whole = rig.session().layers().preview().wanted()->walls[0].part;
  CHECK(whole.ymin == low);
  CHECK(whole.ymax == high);
  REQUIRE(rig.settle());
  CHECK(rig.session().layers().preview().plan()->columns.size() >= nodes.size());
  const double middle = 0.5 * (low + high);
  rig.fill("layers/ymin", std::to_string(middle));
  REQUIRE(rig.settle());
  rig.click("layers/insert");
  REQUIRE(rig.settle());
  REQUIRE(layers(rig) != nullptr);
  CHECK(layers(rig)->columns.size() > 2);
  for (const LayerColumn& column : layers(rig)->columns)
    CHECK(rig.mesh().coordinates.xy(column.wall_node).y() >= middle - 1e-6);
}

TEST_CASE("layers that a wall has are spaced anew; those of other walls stay held") {
  Rig rig(1280, 1500);
  rig.open(two_body_mesh());
  insert(rig, {"left", "right"});
  open_panel(rig, "left");
  fill_spacing(rig, "15", "0.015");
  rig.click("layers/respace");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().size() == 3);
  check_layers(rig, layers(rig), "left", 4, 0.015);
  check_layers(rig, layers(rig), "right", 4, 0.01);
  CHECK(layers(rig)->held);
  CHECK(measure_layers(*layers(rig), rig.mesh().coordinates).spacing_error.max < 0.02);
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  check_layers(rig, layers(rig), "left", 4, 0.01);
}

TEST_CASE("spacing that there is no room for is refused, and the mesh stays as it is") {
  Rig rig(1280, 1500);
  rig.open(ring_mesh());
  insert(rig, {"flap"});
  const Coordinates before = rig.mesh().coordinates;
  open_panel(rig, "flap");
  fill_spacing(rig, "4", "5");
  rig.click("layers/respace");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->text.find("room") != std::string::npos);
  CHECK(rig.mesh().coordinates == before);
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("layers that come in a file are found and held while their body turns") {
  Rig rig(1280, 1500);
  rig.open(ring_mesh());
  open_panel(rig, "flap");
  CHECK_FALSE(rig.visible("layers/hold"));  // triangles alone
  insert(rig, {"flap"});
  rig.frames(3);
  CHECK_FALSE(enabled(rig, "layers/hold"));  // held already
  rig.bench->apply(action::OpenMesh{write(rig.folder, rig.mesh(), "layered.su2"), true});
  REQUIRE(rig.wait([&] { return layers(rig) == nullptr; }));
  REQUIRE(rig.settle());
  open_panel(rig, "flap");
  REQUIRE(enabled(rig, "layers/hold"));
  rig.click("layers/hold");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() == nullptr);
  check_layers(rig, layers(rig), "flap", 4, 0.01);
  CHECK(layers(rig)->held);
  rig.bench->apply(action::ApplyMotion{{20, Vec2(0, 0), Vec2(0, 0)}});
  REQUIRE(rig.settle());
  REQUIRE(layers(rig) != nullptr);
  CHECK(measure_layers(*layers(rig), rig.mesh().coordinates).spacing_error.max < 0.02);
  rig.bench->apply(action::GoToStep{0});
  REQUIRE(rig.settle());
  CHECK(layers(rig) == nullptr);
}

TEST_CASE("a card says what layers came with the file, and folds the settings away") {
  Rig rig(1280, 1500);
  rig.open(ring_mesh());
  insert(rig, {"flap"});
  rig.bench->apply(action::OpenMesh{write(rig.folder, rig.mesh(), "layered.su2"), true});
  REQUIRE(rig.wait([&] { return layers(rig) == nullptr; }));
  REQUIRE(rig.settle());
  CHECK(rig.session().layers().found().at_markers() == std::map<std::string, int>{{"flap", 4}});
  if (!rig.visible("layers/status")) rig.click("section/layers");
  rig.frames(3);
  REQUIRE(rig.visible("layers/status"));
  CHECK_FALSE(rig.visible("layers/insert"));
  REQUIRE(enabled(rig, "layers/hold"));  // all that there are, with nothing selected
  rig.click("layers/hold");
  REQUIRE(rig.settle());
  REQUIRE(layers(rig) != nullptr);
  CHECK(layers(rig)->held);
  rig.frames(3);
  CHECK_FALSE(enabled(rig, "layers/hold"));
  rig.click("layers/open_insert");
  rig.bench->apply(action::SelectMarkers{{rig.marker("farfield")}});
  rig.frames(3);
  CHECK(rig.visible("layers/insert"));
  rig.open(two_body_mesh(), "plain.su2");  // quadrilaterals, but no layers at a smooth wall
  rig.frames(3);
  CHECK(rig.session().layers().found().looked_at(rig.session().topology()));
}

TEST_CASE("layers inserted at a second wall join those held at the first") {
  Rig rig;
  rig.open(two_body_mesh());
  insert(rig, {"left"});
  insert(rig, {"right"});
  check_layers(rig, layers(rig), "left", 4, 0.01);
  check_layers(rig, layers(rig), "right", 4, 0.01);
  CHECK(measure_layers(*layers(rig), rig.mesh().coordinates).spacing_error.max < 0.02);
  rig.bench->apply(action::SelectMarkers{{rig.marker("left")}});
  rig.bench->apply(action::ApplyMotion{{10, Vec2(-2, 0), Vec2(0, 0)}});
  REQUIRE(rig.settle());
  CHECK(measure_layers(*layers(rig), rig.mesh().coordinates).spacing_error.max < 0.02);
}

TEST_CASE("the plan that is shown is the one that is inserted") {
  Rig rig(1280, 1500);
  rig.open(two_body_mesh());
  open_panel(rig, "outer");
  fill_spacing(rig, "8", "0.03");
  REQUIRE(rig.settle());
  const LayerStack* plan = rig.session().layers().preview().plan();
  REQUIRE(plan != nullptr);
  std::vector<std::vector<double>> heights;
  for (const LayerColumn& column : plan->columns) heights.push_back(column.heights);
  rig.click("layers/insert");
  REQUIRE(rig.settle());
  REQUIRE(layers(rig) != nullptr);
  REQUIRE(layers(rig)->columns.size() == heights.size());
  for (std::size_t c = 0; c < heights.size(); ++c)
    CHECK(layers(rig)->columns[c].heights == heights[c]);
}

TEST_CASE("single columns are set by hand for a node that is inspected") {
  Rig rig(1280, 1500);
  rig.open(two_body_mesh());
  open_panel(rig, "left");
  fill_spacing(rig, "4", "0.01");
  rig.click("layers/columns");
  rig.frames(3);
  REQUIRE(rig.visible("layers/columns/add"));
  CHECK_FALSE(enabled(rig, "layers/columns/add"));  // no node is inspected
  const auto corner = [&]() -> Index {
    for (const Index node : rig.session().topology()->markers().nodes(rig.marker("left")))
      if ((rig.mesh().coordinates.xy(node) - Vec2(-2.5, -0.5)).norm() < 1e-9) return node;
    return -1;
  }();
  REQUIRE(corner >= 0);
  const auto columns_at_corner = [&](const LayerStack* stack) {
    REQUIRE(stack != nullptr);
    return std::ranges::count(stack->columns, corner, &LayerColumn::wall_node);
  };
  REQUIRE(rig.settle());
  CHECK(columns_at_corner(rig.session().layers().preview().plan()) > 1);  // a fan
  rig.bench->apply(action::InspectNode{corner});
  rig.frames(3);
  REQUIRE(enabled(rig, "layers/columns/add"));
  rig.click("layers/columns/add");
  rig.frames(3);
  CHECK_FALSE(enabled(rig, "layers/columns/add"));
  REQUIRE(rig.settle());
  CHECK(columns_at_corner(rig.session().layers().preview().plan()) == 1);
  rig.fill("layers/columns/count", "3");
  REQUIRE(rig.settle());  // what the plan comes to takes a line or two, above buttons
  rig.click("layers/columns/own");
  REQUIRE(rig.settle());
  rig.fill("layers/columns/thickness", "0.045");
  REQUIRE(rig.settle());
  rig.bench->pictures().picture();
  rig.click("layers/insert");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() == nullptr);
  CHECK(columns_at_corner(layers(rig)) == 3);
  for (const LayerColumn& column : layers(rig)->columns)
    if (column.wall_node == corner) CHECK(column.thickness() == doctest::Approx(0.045));
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  rig.frames(3);
  // Of walls that are not asked for there is nothing to set; taken out, the rules count again.
  rig.click("layers/column/0/remove");
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.visible("layers/column/0"));
  CHECK(rig.session().layers().preview().wanted()->overrides.empty());
}

TEST_CASE("columns that would cross are shown as thin as they will be") {
  const Mesh mesh = two_body_mesh();
  const auto node_at = [&](const Vec2& place) {
    Index node = 0;
    while ((mesh.coordinates.xy(node) - place).norm() > 1e-9) ++node;
    return node;
  };
  LayerOptions options;
  options.walls = {{{"outer"}, {}}};
  options.walls[0].spacing.first = 0.02;
  for (const Vec2& place : {Vec2(-4, -2), Vec2(-3.5, -2)}) {
    ColumnOverride own;
    own.node = node_at(place);
    own.thickness = 0.8;
    options.overrides.push_back(own);
  }
  const auto heights = [](const LayerStack& stack) {
    std::vector<std::vector<double>> all;
    for (const LayerColumn& column : stack.columns) all.push_back(column.heights);
    return all;
  };
  const auto wanted = heights(sound_plan(mesh, with_counts(options, mesh)));
  REQUIRE(wanted != heights(plan_layers(mesh, options)));
  LayerPreview preview;
  preview.want(options);
  while (!preview.plan() && preview.error().empty()) preview.update(&mesh);
  CHECK(preview.error() == "");
  REQUIRE(preview.plan() != nullptr);
  CHECK(heights(*preview.plan()) == wanted);
}

TEST_CASE("buttons stay in their places while a plan is made, arrives, and is carried out") {
  Rig rig(1280, 1500);
  rig.open(ring_mesh(240, 40));  // a plan takes longer than a frame
  rig.click("marker/flap");
  rig.frames(3);
  rig.click("section/layers");
  REQUIRE(rig.settle());
  REQUIRE(rig.visible("layers/insert"));
  const auto places = [&] {
    std::map<std::string, double> tops;
    for (const char* id :
         {"layers/count", "layers/control", "layers/preview", "layers/insert", "layers/corners"}) {
      INFO(id);
      const auto rect = rig.bench->widgets().find(id);
      REQUIRE(rect.has_value());
      tops[id] = rect->min.y();
    }
    return tops;
  };
  const auto there = places();
  REQUIRE(rig.session().layers().preview().plan() != nullptr);
  // Other settings: for some frames there is no plan, unless it is made within a frame.
  int without = 0;
  for (const char* first :
       {"0.013", "0.014", "0.015", "0.016", "0.017", "0.018", "0.019", "0.011"}) {
    rig.fill("layers/first", first);
    do {
      without += rig.session().layers().preview().plan() == nullptr;
      CHECK(places() == there);
      rig.frames(1);
    } while (rig.session().layers().preview().busy());
    if (without > 0) break;
  }
  CHECK(without > 0);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().layers().preview().plan() != nullptr);
  CHECK(places() == there);
}

}  // namespace winslow::gui::test
