#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/layers/layer_stack.h"
#include "gui/files/assets.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

LayersCommand four_layers() {
  LayersCommand command;
  LayerWall wall{{"flap"}, {}};
  wall.spacing.count = 4;
  wall.spacing.first = 0.01;
  command.layers.walls = {wall};
  return command;
}

void insert(Rig& rig) {
  rig.bench->apply(action::RunCommand{four_layers(), false});
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().state().layers != nullptr);
}

/// All that is drawn: colours, comparison, ids, pins.
void show_everything(Rig& rig, Comparison comparison, const ElementField& field) {
  set_view(rig, [&](ViewOptions& view) {
    view.comparison = comparison;
    view.color = field;
    view.node_ids = view.element_ids = view.rim_nodes = view.nodes = true;
  });
  rig.bench->pictures().picture();
}

void check_same_mesh(const MeshState& a, const MeshState& b) {
  const Topology &s = *a.mesh.topology, &t = *b.mesh.topology;
  CHECK(a.mesh.coordinates == b.mesh.coordinates);
  REQUIRE(s.element_count() == t.element_count());
  CHECK(s.elements().values == t.elements().values);
  CHECK(s.neighbour_rows().values == t.neighbour_rows().values);
  CHECK(s.boundary_loops() == t.boundary_loops());
  REQUIRE(a.vcvs.plane()->edits().size() == b.vcvs.plane()->edits().size());
  for (const auto& [node, stencil] : a.vcvs.plane()->edits()) {
    REQUIRE(b.vcvs.plane()->edited(node));
    CHECK(std::ranges::equal(b.vcvs.plane()->angles(node), stencil.angles));
    CHECK(std::ranges::equal(b.vcvs.plane()->lengths(node), stencil.lengths));
  }
  REQUIRE((a.layers == nullptr) == (b.layers == nullptr));
  if (!a.layers) return;
  CHECK(a.layers->layer_of_element == b.layers->layer_of_element);
  CHECK(a.layers->held == b.layers->held);
  REQUIRE(a.layers->columns.size() == b.layers->columns.size());
  for (std::size_t c = 0; c < a.layers->columns.size(); ++c) {
    CHECK(a.layers->columns[c].heights == b.layers->columns[c].heights);
    CHECK(a.layers->columns[c].corrections == b.layers->columns[c].corrections);
    CHECK(a.layers->columns[c].nodes == b.layers->columns[c].nodes);
    CHECK(a.layers->columns[c].direction == b.layers->columns[c].direction);
  }
}

}  // namespace

TEST_CASE("the studio follows layers in, back and forth, whatever is drawn") {
  Rig rig(800, 560);  // many pictures are drawn
  rig.open(ring_mesh());
  const Index nodes = rig.mesh().topology->node_count();
  for (const Comparison comparison : {Comparison::ghost, Comparison::split, Comparison::none}) {
    show_everything(rig, comparison, Metric::normalized_jacobian);
    insert(rig);
    CHECK(rig.session().topology() == rig.mesh().topology);
    CHECK(rig.session().mesh().boundary()->topology() == rig.mesh().topology);
    CHECK(rig.mesh().topology->node_count() > nodes);
    rig.bench->pictures().picture();
    for (const ElementField& field : all_element_fields()) {
      show_everything(rig, comparison, field);
      const auto& measured = rig.session().quality().latest();
      REQUIRE(measured != nullptr);
      CHECK(static_cast<Index>(measured->values.size()) == rig.mesh().topology->element_count());
    }
    rig.key(keys::z, {keys::control});
    REQUIRE(rig.settle());
    CHECK(rig.mesh().topology->node_count() == nodes);
    rig.bench->pictures().picture();
    rig.key(keys::z, {keys::control, keys::shift});
    REQUIRE(rig.settle());
    CHECK(rig.mesh().topology->node_count() > nodes);
    rig.bench->pictures().picture();
    rig.bench->apply(action::GoToStep{0});
    REQUIRE(rig.settle());
    CHECK(rig.session().mesh().boundary()->topology() == rig.mesh().topology);
    rig.bench->pictures().picture();
  }
}

TEST_CASE("markers stay selected by name; nodes whose star changed are let go of") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  const Topology& before = *rig.mesh().topology;
  const Index far = 24 * 4 + 3, near = 24 + 3;
  rig.bench->apply(action::PinNodes{{near, far}, true});
  rig.bench->apply(action::InspectNode{far});
  CHECK(rig.session().nodes().pinned().size() == 2);
  insert(rig);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("flap")});
  const bool kept =
      std::ranges::equal(before.neighbours(near), rig.mesh().topology->neighbours(near));
  CHECK(rig.session().nodes().pinned(near) == kept);
  CHECK(rig.session().nodes().pinned(far));
  const Index last = rig.mesh().topology->node_count() - 1;
  rig.bench->apply(action::PinNodes{{last}, true});
  rig.bench->apply(action::InspectNode{last});
  rig.bench->apply(action::GoTo{MeshItem{MeshItem::Kind::node, last}});
  rig.frames();
  REQUIRE(rig.session().nodes().inspected() == last);
  rig.bench->apply(action::Undo{});
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.session().nodes().inspected());
  CHECK_FALSE(rig.session().nodes().pinned(last));
}

TEST_CASE("a body dragged with the mouse keeps its layers") {
  Rig rig;
  rig.open(ring_mesh());
  insert(rig);
  const ScreenPoint from = rig.pixel(Vec2(0, 0));
  rig.drag(from, rig.pixel(Vec2(0.3, 0.2)));
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().position() == 2);
  REQUIRE(rig.document().state().layers != nullptr);
  const auto measured = measure_layers(*rig.document().state().layers, rig.mesh().coordinates);
  CHECK(measured.spacing_error.max < 0.02);
  CHECK(rig.document().history().result(2).inverted == 0);
}

TEST_CASE("Esc while layers are being inserted leaves the mesh as it was, pins and all") {
  Rig rig;
  rig.open(ring_mesh());
  const MeshState before = rig.document().state();
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  const Index near = 24 + 3, far = 24 * 4 + 3;
  rig.bench->apply(action::PinNodes{{near, far}, true});
  rig.bench->apply(action::InspectNode{near});
  rig.bench->apply(action::RunCommand{four_layers(), true});
  rig.bench->apply(action::StepSolver{1});
  REQUIRE(rig.wait([&] { return rig.session().topology() != before.mesh.topology; }));
  rig.frames(4);
  rig.bench->pictures().picture();
  CHECK(rig.session().topology()->node_count() > before.mesh.topology->node_count());
  CHECK(rig.session().coordinates().size() == rig.session().topology()->node_count());
  CHECK(rig.session().nodes().pinned() == std::vector<Index>{far});
  REQUIRE(rig.session().job().active());
  rig.key(keys::escape);
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 1);
  CHECK(rig.session().topology() == before.mesh.topology);
  CHECK(rig.session().coordinates() == before.mesh.coordinates);
  CHECK(rig.session().vcv() == before.vcvs.plane());
  CHECK(rig.session().mesh().boundary()->topology() == before.mesh.topology);
  CHECK(rig.session().nodes().pinned() == std::vector<Index>{near, far});
  CHECK(rig.session().nodes().inspected() == near);
  rig.bench->pictures().picture();
}

TEST_CASE("a past insertion is changed in the history, and what came after it runs again") {
  Rig rig;
  rig.open(ring_mesh());
  insert(rig);
  turn_flap(rig, 10);
  rig.click("tab/history");
  rig.frames(3);
  const ScreenPoint step = rig.bench->widgets().find("history/1")->centre();
  rig.move(step);
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(3);
  rig.click("history/menu/edit");
  rig.frames(4);
  rig.fill("edit/wall0/count", "6");
  rig.fill("edit/wall0/first", "0.008");
  rig.click("edit/run");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().size() == 3);
  for (const std::size_t k : {1u, 2u}) {
    const auto& stack = rig.document().history().state(k).layers;
    REQUIRE(stack != nullptr);
    CHECK(stack->columns.front().count() == 6);
    CHECK(stack->columns.front().heights.front() == doctest::Approx(0.008));
  }
  CHECK(rig.session().topology()->node_count() == 24 * 7 + 24 * 6);
  rig.bench->pictures().picture();
  rig.bench->apply(action::BringBack{0});
  REQUIRE(rig.settle());
  CHECK(rig.document().state().layers->columns.front().count() == 4);
}

TEST_CASE("a recording goes on while layers are inserted") {
  Rig rig(600, 400);
  rig.open(ring_mesh());
  const auto before = rig.session().topology();
  rig.bench->apply(action::SetRecordingSpec{{.picture = {.size = {}, .panels = false}}});
  rig.bench->apply(action::StartRecording{rig.folder / "film", std::nullopt});
  rig.frames(3);
  const Recorder& recorder = rig.bench->capture().recorder();
  REQUIRE(recorder.frames() == 1);
  rig.bench->apply(action::RunCommand{four_layers(), true});
  rig.bench->apply(action::StepSolver{1});
  REQUIRE(rig.wait([&] { return rig.session().topology() != before; }));
  REQUIRE(rig.wait([&] { return recorder.frames() >= 2; }));
  rig.bench->apply(action::ResumeSolver{});
  REQUIRE(rig.settle());
  rig.frames(3);
  REQUIRE(rig.document().state().layers != nullptr);
  const int inserted = recorder.frames();
  CHECK(inserted > 2);
  rig.bench->apply(action::Undo{});
  REQUIRE(rig.wait([&] { return recorder.frames() > inserted; }));
  rig.bench->apply(action::StopRecording{});
  REQUIRE(rig.settle());
  std::vector<std::string> pictures;
  for (const auto& entry : fs::directory_iterator(rig.folder / "film")) {
    std::ifstream in(entry.path(), std::ios::binary);
    pictures.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  std::sort(pictures.begin(), pictures.end());
  const auto same = std::unique(pictures.begin(), pictures.end());
  CHECK(same - pictures.begin() >= 3);  // without layers, on the way, and with them
}

TEST_CASE("layers in a mesh of many nodes") {
  Rig rig(800, 600);
  rig.open(ring_mesh(200, 60));
  const Index nodes = rig.mesh().topology->node_count();
  REQUIRE(nodes >= 12000);
  LayersCommand command = four_layers();
  command.layers.walls[0].spacing.first = 0.001;
  for (int round = 0; round < 2; ++round) {
    show_everything(rig, Comparison::ghost, Metric::normalized_jacobian);
    if (round == 0)
      rig.bench->apply(action::RunCommand{command, false});
    else
      rig.bench->apply(action::Redo{});
    REQUIRE(rig.wait([&] { return !rig.session().in_motion(); }, 200));
    REQUIRE(rig.settle());
    REQUIRE(rig.session().mesh().layers() != nullptr);
    CHECK(rig.mesh().topology->node_count() >= nodes + 4 * 200);
    CHECK(rig.document().history().result(1).inverted == 0);
    show_everything(rig, Comparison::split, Metric::normalized_jacobian);
    const auto& measured = rig.session().quality().latest();
    REQUIRE(measured != nullptr);
    CHECK(static_cast<Index>(measured->values.size()) == rig.mesh().topology->element_count());
    rig.bench->apply(action::Undo{});
    REQUIRE(rig.settle());
    CHECK(rig.session().topology()->node_count() == nodes);
    rig.bench->pictures().picture();
  }
}

TEST_CASE("a mesh with layers is saved in the format of its source, and its recipe replays") {
  for (const char* name : {"mesh.su2", "mesh.msh", "mesh.vtu", "mesh.vtk"}) {
    INFO(name);
    Rig rig;
    rig.open(ring_mesh(), name);
    rig.bench->apply(action::SelectMarkers{{0}});
    insert(rig);
    const Mesh layered = rig.mesh();
    const auto recipe = rig.folder / "recipe.json";
    rig.bench->apply(action::ExportRecipe{recipe, true});
    rig.bench->apply(action::SaveMesh{rig.folder / (std::string("out-") + name), true});
    REQUIRE(rig.wait([&] { return !rig.session().files().saving(); }));
    rig.bench->apply(action::GoToStep{0});
    rig.bench->apply(action::ReplayRecipe{recipe});
    REQUIRE(rig.settle());
    CHECK(rig.mesh().coordinates == layered.coordinates);
    rig.bench->apply(action::DismissPrompt{});
    rig.bench->apply(action::OpenMesh{rig.folder / (std::string("out-") + name), true});
    REQUIRE(rig.wait([&] { return rig.document().source().path != rig.folder / name; }));
    CHECK(rig.mesh().topology->element_count() == layered.topology->element_count());
    CHECK(rig.mesh().topology->node_count() == layered.topology->node_count());
  }
}

TEST_CASE("steps before and after layers can be changed and deleted") {
  Rig rig;
  rig.open(ring_mesh());
  turn_flap(rig, 10);
  insert(rig);
  turn_flap(rig, -5);
  rig.bench->apply(action::DeleteStep{1});
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 3);
  CHECK(rig.document().state().layers != nullptr);
  rig.bench->apply(action::DeleteStep{1});
  REQUIRE(rig.settle());
  CHECK(rig.document().state().layers == nullptr);
  rig.bench->apply(action::BringBack{0});
  REQUIRE(rig.settle());
  CHECK(rig.document().state().layers != nullptr);
  rig.bench->pictures().picture();
}

TEST_CASE("a session with layers is restored to the bit") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  std::vector<MeshState> states;
  {
    Rig rig(1280, 720, profile.path());
    rig.bench->apply(action::OpenMesh{write(meshes, ring_mesh(), "wing.su2")});
    REQUIRE(rig.settle());
    turn_flap(rig, 5);
    insert(rig);
    turn_flap(rig, -10);
    REQUIRE(rig.wait([&] { return !rig.bench->autosave().busy(); }));
    for (std::size_t k = 0; k < 4; ++k) states.push_back(rig.document().history().state(k));
  }
  Rig rig(1280, 720, profile.path());
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  rig.frames(3);
  rig.click("prompt/Restore");
  REQUIRE(rig.wait([&] { return rig.session().document() != nullptr; }));
  REQUIRE(rig.settle());
  const History& history = rig.document().history();
  REQUIRE(history.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) check_same_mesh(states[k], history.state(k));
  // Work goes on as it would have.
  turn_flap(rig, 3);
  CHECK(rig.document().history().result(4).converged);
  CHECK(rig.document().state().layers != nullptr);
}

TEST_CASE("the panel plans layers, shows them and inserts them") {
  Rig rig(1280, 1400);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  if (!rig.visible("layers/insert")) rig.click("section/layers");
  rig.frames();
  rig.fill("layers/count", "3");
  rig.fill("layers/first", "0.02");
  REQUIRE(rig.settle());
  const LayerStack* plan = rig.session().layers().preview().plan();
  REQUIRE(plan != nullptr);
  CHECK(plan->columns.size() >= 24);
  CHECK(plan->columns.front().heights.front() == doctest::Approx(0.02));
  CHECK(rig.visible("layers/summary"));
  CHECK(rig.visible("layers/plot"));
  rig.bench->pictures().picture();
  rig.click("layers/insert");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().state().layers != nullptr);
  CHECK(rig.document().history().size() == 2);
  rig.frames();
  CHECK(rig.visible("layers/result"));
  CHECK(rig.visible("layers/realised"));
  rig.bench->pictures().picture();
  // A plan for the same once more would only hide the layers; another one is shown.
  CHECK_FALSE(rig.session().layers().preview().wanted());
  rig.fill("layers/count", "2");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().layers().preview().wanted());
  CHECK(rig.session().layers().preview().wanted()->walls.front().spacing.count == 2);
}

TEST_CASE("a mesh that comes with the program is never written over") {
  const fs::path path = assets_folder() / "coarse" / "circle.su2";
  const auto content = [&] {
    std::ifstream in(path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  };
  const std::string before = content();
  REQUIRE(!before.empty());
  Rig rig;
  rig.bench->apply(action::OpenMesh{path});
  REQUIRE(rig.settle());
  rig.bench->apply(action::SaveMesh{path, true, true});
  rig.bench->apply(action::ExportMesh{path, true});
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.session().files().saving());
  REQUIRE(rig.session().messages().notice());
  CHECK(rig.session().messages().notice()->text == bundled_text);
  rig.key(keys::s, {keys::control});
  rig.frames(3);
  CHECK(rig.bench->dialogs().file_dialog().is_open());
  CHECK(content() == before);
}

}  // namespace winslow::gui::test
