#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "core/command/command.h"
#include "core/error.h"
#include "gui/document/autosave/archive.h"
#include "gui/document/autosave/step_file.h"
#include "gui/document/history/document.h"
#include "gui/support/meshes.h"
#include "support/random.h"
#include "support/surface_meshes.h"

namespace winslow::gui::test {

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
  CHECK(next.vcv == loaded.state.vcv);
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
  command.smooth.slide.reference = {"/nowhere/fine.obj", fine};
  command.smooth.slide.feature_angle = 55;
  command.smooth.slide.hold_nodes = {7};
  const CommandResult result = execute(command, loaded.state);
  REQUIRE(result.state.surface != loaded.state.surface);
  write_step(folder / "one.bin", result.state, loaded.state, result.smooth);
  const MeshState back = read_step(folder / "one.bin", loaded.state).state;
  CHECK(back.mesh.coordinates == result.state.mesh.coordinates);
  REQUIRE(back.surface);
  CHECK(back.surface->rules == result.state.surface->rules);
  CHECK(back.surface->given == loaded.state.mesh.coordinates);
  CHECK(same_surface(back.surface->reference, result.state.surface->reference));

  // The next command goes on from it just as it would have without the crash: on the reference
  // surface, and back onto the mesh's own.
  for (const bool on : {true, false}) {
    SmoothCommand next = command;
    if (!on) next.smooth.slide.reference = {};
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
  command.smooth.slide.reference = {"fine.obj", fine};
  const CommandResult result = execute(command, loaded.state);
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

}  // namespace winslow::gui::test
