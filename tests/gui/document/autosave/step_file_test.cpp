#include "gui/document/autosave/step_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "core/error.h"
#include "gui/document/autosave/step_checks.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;
using Damage = std::function<void(LayerStack&)>;

LayersCommand three_layers() {
  LayersCommand command;
  LayerWall wall{{"flap"}, {}};
  wall.spacing.count = 3;
  wall.spacing.first = 0.01;
  command.layers.walls = {wall};
  return command;
}

MeshState damaged(MeshState state, const Damage& damage) {
  LayerStack stack = *state.layers;
  damage(stack);
  state.layers = std::make_shared<const LayerStack>(std::move(stack));
  return state;
}

/// One wrong value each; of a stack with columns of three layers.
std::vector<Damage> damages() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {
      [](LayerStack& s) { s.columns.clear(); },
      [](LayerStack& s) { s.columns[1].wall_node = 1 << 30; },
      [](LayerStack& s) { s.columns[1].wall_node = -1; },
      [](LayerStack& s) { s.columns[1].wall = -1; },
      [](LayerStack& s) { s.columns[1].direction.x() = nan; },
      [](LayerStack& s) { s.columns[1].slant = 0; },
      [](LayerStack& s) { s.columns[1].asked = nan; },
      [](LayerStack& s) { s.columns[1].limit = static_cast<LayerLimit>(99); },
      [](LayerStack& s) { s.columns[1].heights[0] = -1; },
      [](LayerStack& s) { s.columns[1].heights.push_back(1); },
      [](LayerStack& s) { s.columns[1].corrections = {1}; },
      [](LayerStack& s) { s.columns[1].nodes[2] = 1 << 30; },
      [](LayerStack& s) { s.columns[1].nodes.pop_back(); },
      [](LayerStack& s) { s.columns[1].nodes.clear(); },
      [](LayerStack& s) { s.pairs[0].left = s.columns.size(); },
      [](LayerStack& s) { s.layer_of_element.pop_back(); },
      [](LayerStack& s) { s.layer_of_element[0] = 3; },
      [](LayerStack& s) { s.layer_of_element[0] = -2; },
  };
}

}  // namespace

TEST_CASE("a step whose layers make no sense is refused") {
  TemporaryFolder folder;
  const auto path = folder / "step.bin";
  const MeshState before = make_state(ring_mesh());
  const CommandResult result = execute(three_layers(), before);
  write_step(path, result.state, before, result.smooth);
  CHECK(read_step(path, before).state.layers->columns.size() ==
        result.state.layers->columns.size());
  const auto all = damages();
  for (std::size_t k = 0; k < all.size(); ++k) {
    INFO("damage ", k);
    write_step(path, damaged(result.state, all[k]), before, result.smooth);
    CHECK_THROWS_AS(read_step(path, before), InputError);
  }
  // Layers and control volumes of other elements than those that the step has.
  MeshState mixed = result.state;
  mixed.vcv = before.vcv;
  write_step(path, mixed, before, result.smooth);
  CHECK_THROWS_AS(read_step(path, before), InputError);
}

TEST_CASE("elements that make no sense are refused before a mesh is built of them") {
  MeshData good;
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
    good.coordinates.push_xy(p);
  good.add_element(ElementType::triangle, std::array<Index, 3>{0, 1, 2});
  good.add_element(ElementType::triangle, std::array<Index, 3>{0, 2, 3});
  good.markers = {{"all", 1, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}};
  REQUIRE(fault_of(good).empty());
  const std::vector<std::function<void(MeshData&)>> all{
      [](MeshData& d) { d.element_offsets[1] = 1 << 30; },
      [](MeshData& d) { d.element_offsets[1] = -1; },
      [](MeshData& d) { d.element_offsets.pop_back(); },
      [](MeshData& d) { d.element_offsets.clear(); },
      [](MeshData& d) { d.element_nodes.pop_back(); },
      [](MeshData& d) { d.types[0] = ElementType::quadrilateral; },
      [](MeshData& d) { d.types[0] = static_cast<ElementType>(7); },
      [](MeshData& d) { d.markers[0].faces[0] = Face(0, 9); },
      [](MeshData& d) {
        d.element_region = {0, 0};
      },
      [](MeshData& d) { d.element_region = {-1}; },
  };
  for (std::size_t k = 0; k < all.size(); ++k) {
    INFO("damage ", k);
    MeshData data = good;
    all[k](data);
    CHECK_FALSE(fault_of(data).empty());
  }
}

TEST_CASE("a session whose layers were damaged is restored up to them, and it is said") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  {
    Rig rig(1280, 720, profile.path());
    rig.bench->apply(action::OpenMesh{write(meshes, ring_mesh(), "wing.su2")});
    REQUIRE(rig.settle());
    rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
    rig.bench->apply(action::ApplyMotion{{10, Vec2(0, 0), Vec2(0, 0)}});
    REQUIRE(rig.settle());
    rig.bench->apply(action::RunCommand{three_layers(), false});
    REQUIRE(rig.settle());
    REQUIRE(rig.wait([&] { return !rig.bench->autosave().busy(); }));
    const History& history = rig.document().history();
    REQUIRE(history.size() == 3);
    std::vector<fs::path> steps;
    for (const auto& entry : fs::recursive_directory_iterator(profile / "autosave"))
      if (entry.path().filename().string().starts_with("step-")) steps.push_back(entry.path());
    std::sort(steps.begin(), steps.end());
    REQUIRE(steps.size() == 2);
    write_step(
        steps[1],
        damaged(history.state(2), [](LayerStack& s) { s.columns[0].nodes.back() = 1 << 30; }),
        history.state(1), history.result(2));
  }
  Rig rig(1280, 720, profile.path());
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  rig.frames(3);
  rig.click("prompt/Restore");
  REQUIRE(rig.wait([&] { return rig.session().document() && rig.session().messages().prompt(); }));
  CHECK(rig.session().messages().prompt()->text.find("lost") != std::string::npos);
  CHECK(rig.document().history().size() == 2);
  CHECK(rig.session().mesh().layers() == nullptr);
  rig.bench->pictures().picture();
}

}  // namespace winslow::gui::test
