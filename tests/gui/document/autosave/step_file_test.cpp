#include "gui/document/autosave/step_file.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "core/command/command.h"
#include "core/error.h"
#include "core/vcv/sphere/node_vcv.h"
#include "gui/document/autosave/archive.h"
#include "gui/document/history/document.h"
#include "gui/support/meshes.h"
#include "gui/support/rig.h"
#include "support/random.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

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
      [](LayerStack& s) {
        s.faces = {{{0, 1, 2}, 5}};
      },
      [](LayerStack& s) {
        s.faces = {{{0, 1, 1 << 30}, 3}};
      },
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
  REQUIRE(result.state.roles);
  write_step(path, result.state, before, result.smooth);
  CHECK(*read_step(path, before).state.roles == *result.state.roles);
  ElementRoles roles = *result.state.roles;
  roles.front() = static_cast<ElementRole>(4);
  MeshState unknown = result.state;
  unknown.roles = std::make_shared<const ElementRoles>(roles);
  write_step(path, unknown, before, result.smooth);
  CHECK_THROWS_AS(read_step(path, before), InputError);
  // Layers and control volumes of other elements than those that the step has.
  MeshState mixed = result.state;
  mixed.vcvs = before.vcvs.plane();
  write_step(path, mixed, before, result.smooth);
  CHECK_THROWS_AS(read_step(path, before), InputError);
}

TEST_CASE("a step keeps the reference mesh: another one, the same as before, or none") {
  TemporaryFolder folder;
  const auto path = folder / "step.bin";
  const MeshState opened = make_state(ring_mesh());
  MoveCommand command;
  command.bodies[0].markers = {"flap"};
  command.bodies[0].motion.rotate = 5;
  const CommandResult once = execute(command, opened);
  write_step(path, once.state, opened, once.smooth);
  const MeshState read = read_step(path, opened).state;
  REQUIRE(read.reference);
  CHECK(*read.reference == opened.mesh.coordinates);
  const CommandResult twice = execute(command, read);
  write_step(path, twice.state, read, twice.smooth);
  CHECK(read_step(path, read).state.reference == read.reference);
  const CommandResult smoothed = execute(SmoothCommand{}, twice.state);
  write_step(path, smoothed.state, twice.state, smoothed.smooth);
  CHECK_FALSE(read_step(path, twice.state).state.reference);
  MeshState wrong = once.state;
  wrong.reference = std::make_shared<const Coordinates>(2, 3);
  write_step(path, wrong, opened, once.smooth);
  CHECK_THROWS_AS(read_step(path, opened), InputError);
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
      [](MeshData& d) { d.types[0] = static_cast<ElementType>(element_type_count); },
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

TEST_CASE("a step of a surface mesh comes back, with the shape that its nodes stay on") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(winslow::test::octasphere(4));
  Document::Loaded loaded;
  loaded.state = make_state(mesh);
  examine(loaded);
  REQUIRE(loaded.state.surface);
  REQUIRE(loaded.given);
  REQUIRE(loaded.boundary);
  CHECK(loaded.given->to(Vec3(0, 0, 1)) < 1e-15);
  MeshState second = loaded.state;
  second.mesh.coordinates.set_xyz(3, Vec3(0, 0, 2));
  write_step(folder / "second.bin", second, loaded.state, {});
  const MeshState next = read_step(folder / "second.bin", loaded.state).state;
  CHECK(next.mesh.coordinates == second.mesh.coordinates);
  CHECK(next.surface == loaded.state.surface);
  CHECK(next.vcvs.plane() == loaded.state.vcvs.plane());
}

TEST_CASE("a step on a reference surface comes back with it, though its file has gone") {
  const TemporaryFolder folder;
  Document::Loaded loaded;
  loaded.state = make_state(make_mesh(winslow::test::octasphere(4)));
  examine(loaded);
  auto fine = std::make_shared<ReferenceSurface>();
  fine->source = "fine.obj";
  const MeshData ball = winslow::test::octasphere(12);
  for (Index i = 0; i < ball.node_count(); ++i)
    fine->points.emplace_back(1.1 * ball.coordinates.xyz(i));
  for (Index e = 0; e < ball.element_count(); ++e) fine->faces.emplace_back(ball.element(e));
  SmoothCommand command;
  command.smooth.slide.reference = "/nowhere/fine.obj";
  command.smooth.slide.feature_angle = 55;
  command.smooth.slide.hold_nodes = {7};
  const SlideFiles files{.reference = fine};
  const CommandResult result = execute(ResolvedCommand(command, files), loaded.state);
  REQUIRE(result.state.surface != loaded.state.surface);
  write_step(folder / "one.bin", result.state, loaded.state, result.smooth);
  const MeshState back = read_step(folder / "one.bin", loaded.state).state;
  CHECK(back.mesh.coordinates == result.state.mesh.coordinates);
  REQUIRE(back.surface);
  CHECK(back.surface->rules == result.state.surface->rules);
  CHECK(back.surface->given == loaded.state.mesh.coordinates);
  REQUIRE(back.surface->reference);
  CHECK(back.surface->reference->source == "fine.obj");
  CHECK(back.surface->reference->points == fine->points);
  CHECK(back.surface->reference->faces == fine->faces);

  // The next command goes on from it just as it would have without the crash: on the reference
  // surface, and back onto the mesh's own.
  for (const bool on : {true, false}) {
    SmoothCommand without = command;
    without.smooth.slide.reference.clear();
    const ResolvedCommand next = on ? ResolvedCommand(command, files) : without;
    CHECK(execute(next, back).state.mesh.coordinates ==
          execute(next, result.state).state.mesh.coordinates);
  }
  // A second step on it does not hold it again.
  write_step(folder / "two.bin", result.state, result.state, result.smooth);
  CHECK(std::filesystem::file_size(folder / "two.bin") * 2 <
        std::filesystem::file_size(folder / "one.bin"));
  CHECK(read_step(folder / "two.bin", back).state.surface == back.surface);
}

TEST_CASE("no damaged step of a surface does anything but give a state or an InputError") {
  const TemporaryFolder folder;
  Document::Loaded loaded;
  loaded.state = make_state(make_mesh(winslow::test::octasphere(2)));
  examine(loaded);
  auto fine = std::make_shared<ReferenceSurface>();
  fine->source = "fine.obj";
  const MeshData ball = winslow::test::octasphere(3);
  for (Index i = 0; i < ball.node_count(); ++i) fine->points.emplace_back(ball.coordinates.xyz(i));
  for (Index e = 0; e < ball.element_count(); ++e) fine->faces.emplace_back(ball.element(e));
  SmoothCommand command;
  command.smooth.slide.reference = "fine.obj";
  const CommandResult result = execute(ResolvedCommand(command, {.reference = fine}), loaded.state);
  write_step(folder / "one.bin", result.state, loaded.state, result.smooth);
  std::ifstream in(folder / "one.bin", std::ios::binary);
  const std::string good{std::istreambuf_iterator<char>(in), {}};
  winslow::test::Random random(5);
  int refused = 0, read = 0;
  for (int k = 0; k < 300; ++k) {
    // The checksum is made to fit again, so that the numbers themselves are looked at.
    std::string bytes = good.substr(0, good.size() - sizeof(std::uint64_t));
    for (Index n = 1 + random.index(3); n > 0; --n)
      bytes[at(random.index(static_cast<Index>(bytes.size())))] =
          static_cast<char>(random.index(256));
    Checksum sum;
    sum.add(bytes.data(), bytes.size());
    const std::uint64_t value = sum.value();
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    std::ofstream(folder / "bad.bin", std::ios::binary) << bytes;
    try {
      read_step(folder / "bad.bin", loaded.state);
      ++read;
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 0);
  CHECK(read > 0);
}

TEST_CASE("a step of a volume mesh comes back, alone and after another") {
  using winslow::test::Volumes;
  const TemporaryFolder folder;
  const MeshState first = make_state(make_mesh(winslow::test::cube_with_cavity(6, Volumes::mixed)));
  write_step(folder / "first.bin", first, MeshState{}, {});
  const MeshState read = read_step(folder / "first.bin", MeshState{}).state;
  CHECK(read.mesh.coordinates == first.mesh.coordinates);
  CHECK(read.mesh.topology->element_count() == first.mesh.topology->element_count());
  CHECK(read.mesh.topology->markers().size() == first.mesh.topology->markers().size());
  CHECK(read.vcvs.plane() == nullptr);

  MeshState second = first;
  const Index node = first.mesh.topology->interior_nodes().front();
  second.mesh.coordinates.set_xyz(node, first.mesh.coordinates.xyz(node) + Vec3(0.01, 0, 0));
  write_step(folder / "second.bin", second, first, {});
  const MeshState next = read_step(folder / "second.bin", first).state;
  CHECK(next.mesh.coordinates == second.mesh.coordinates);
  CHECK(next.mesh.topology == first.mesh.topology);
}

TEST_CASE("VCVs of a volume mesh by hand come back with a step to the bit, and go with the next") {
  const TemporaryFolder folder;
  const MeshState first = make_state(winslow::test::shaken_box(3, 0.1, 3));
  const Topology& topology = *first.mesh.topology;
  const Index node = topology.interior_nodes().front();
  SphereStencil stencil = make_node_vcv(topology, first.mesh.coordinates, node, {}).stencil;
  stencil.lengths[1] = 0.1 + 0.2;
  const VcvEdit edit = edit_of(topology, node, stencil);
  MeshState second = first;
  second.vcvs = edit_vcvs(topology, nullptr, std::span(&edit, 1));
  write_step(folder / "first.bin", first, MeshState{}, {});
  write_step(folder / "second.bin", second, first, {});
  const MeshState read = read_step(folder / "first.bin", MeshState{}).state;
  CHECK(read.vcvs.by_hand() == nullptr);
  const MeshState edited = read_step(folder / "second.bin", read).state;
  REQUIRE(edited.vcvs.by_hand());
  CHECK(*edited.vcvs.by_hand() == *second.vcvs.by_hand());
  // What did not change is that of the state before, and what was reset is gone.
  MeshState third = second;
  write_step(folder / "third.bin", third, second, {});
  CHECK(read_step(folder / "third.bin", edited).state.vcvs.by_hand() == edited.vcvs.by_hand());
  third.vcvs = {};
  write_step(folder / "fourth.bin", third, second, {});
  CHECK(read_step(folder / "fourth.bin", edited).state.vcvs.by_hand() == nullptr);
}

}  // namespace winslow::gui::test
