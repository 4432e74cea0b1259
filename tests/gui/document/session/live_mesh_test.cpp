#include "gui/document/session/live_mesh.h"

#include <set>

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

TEST_CASE("without a document there is nothing on screen") {
  const NothingOpen nothing;
  const LiveMesh& mesh = nothing.mesh;
  CHECK(mesh.document() == nullptr);
  CHECK(mesh.topology() == nullptr);
  CHECK(mesh.coordinates().size() == 0);
  CHECK(mesh.vcv() == nullptr);
  CHECK(mesh.boundary() == nullptr);
  CHECK(mesh.convergence().empty());
  CHECK_FALSE(mesh.in_motion());
}

TEST_CASE("opening and closing another mesh is told, and counted") {
  SessionParts parts(ring_mesh());
  int closed = 0;
  parts.mesh.when_rebuilt([&](const auto&, const auto& now) { closed += now ? 0 : 1; });
  const auto generation = parts.mesh.generation();
  const auto first = parts.mesh.topology();
  parts.mesh.open(std::make_unique<Document>(
      Document::load(write(parts.folder, two_body_mesh(), "other.su2"))));
  CHECK(parts.mesh.generation() == generation + 1);
  CHECK(parts.mesh.topology() != first);
  CHECK(parts.mesh.boundary()->topology() == parts.mesh.topology());
  CHECK(closed == 1);
  parts.mesh.close();
  CHECK(closed == 2);
  CHECK(parts.mesh.generation() == generation + 2);
  CHECK(parts.mesh.document() == nullptr);
}

TEST_CASE("the mesh on screen is the job's while there is one, and the document's again after it") {
  SessionParts parts(ring_mesh());
  const Coordinates before = parts.mesh.document()->state().mesh.coordinates;
  const auto shape = parts.mesh.shape();
  parts.selection.on(action::SelectMarkers{{parts.marker("flap")}});
  REQUIRE(parts.jobs.start(
      parts.settings.move_command(parts.selection.names(), {20, Vec2(0, 0), Vec2(0, 0)}), true));
  CHECK(parts.mesh.in_motion());
  CHECK(parts.mesh.shape() > shape);
  REQUIRE(parts.mesh.live_motion().has_value());
  CHECK(parts.mesh.live_motion()->rotate == 20);
  CHECK(parts.mesh.motion_base().mesh.coordinates == before);
  parts.jobs.stop();
  CHECK_FALSE(parts.mesh.live_motion().has_value());
  CHECK(parts.mesh.coordinates() == before);
}

TEST_CASE("layers that are inserted make a mesh of another connectivity, which is told once") {
  SessionParts parts(ring_mesh());
  std::shared_ptr<const Topology> told_before, told_now;
  int told = 0;
  parts.mesh.when_rebuilt([&](const auto& before, const auto& now) {
    ++told;
    told_before = before;
    told_now = now;
  });
  const auto opened = parts.mesh.topology();
  LayersCommand layers;
  LayerWall wall{{"flap"}, {}};
  wall.spacing.count = 4;
  wall.spacing.first = 0.01;
  layers.layers.walls = {wall};
  REQUIRE(parts.jobs.start(layers, false));
  parts.finish();
  REQUIRE(parts.done().position() == 1);
  CHECK(told == 1);
  CHECK(told_before == opened);
  CHECK(told_now == parts.mesh.topology());
  CHECK(parts.mesh.layers() != nullptr);
}

TEST_CASE("a mesh that is shared stays as it is, and is made anew only when nodes have moved") {
  CHECK(NothingOpen().mesh.shared() == nullptr);
  SessionParts parts(ring_mesh());
  const auto given = parts.mesh.shared();
  CHECK(given->topology == parts.mesh.topology());
  CHECK(given->coordinates == parts.mesh.coordinates());
  parts.mesh.changed();  // to the same nodes
  CHECK(parts.mesh.shared() == given);
  const Coordinates before = given->coordinates;
  parts.selection.on(action::SelectMarkers{{parts.marker("flap")}});
  parts.work.job().wait_for_viewer(true);  // however fast the solver is, its meshes are seen
  REQUIRE(parts.jobs.start(
      parts.settings.move_command(parts.selection.names(), {10, Vec2(0, 0), Vec2(0, 0)}), false));
  std::set<std::shared_ptr<const Mesh>> of_solver;
  while (parts.mesh.in_motion()) {
    if (const auto& snapshot = parts.work.job().snapshot()) of_solver.insert(snapshot->mesh);
    const auto shared = parts.mesh.shared();
    CHECK(shared->coordinates == parts.mesh.coordinates());
    // None of the solver's meshes is copied.
    CHECK((shared == given || of_solver.contains(shared)));
    parts.jobs.poll();
    parts.work.job().wait_for_viewer(true);
  }
  CHECK(of_solver.size() > 1);
  CHECK(parts.mesh.shared()->coordinates == parts.mesh.coordinates());
  CHECK(parts.mesh.shared() != given);
  CHECK(given->coordinates == before);
  parts.mesh.close();
  CHECK(parts.mesh.shared() == nullptr);
}

TEST_CASE("nothing is under way at first") {
  const NothingOpen nothing;
  CHECK_FALSE(nothing.work.active());
  CHECK(nothing.work.coordinates() == nullptr);
  CHECK(nothing.work.topology() == nullptr);
  CHECK(nothing.work.base() == nullptr);
  CHECK(nothing.work.body_drag() == nullptr);
  CHECK(nothing.work.edited_vcvs() == nullptr);
}

TEST_CASE("of a job and a drag the drag is what is seen") {
  SessionParts parts(ring_mesh());
  REQUIRE(parts.jobs.start(ScrambleCommand{1}, true));
  CHECK(parts.work.active());
  CHECK(parts.work.coordinates() == &parts.work.job().coordinates());
  CHECK(*parts.work.topology() == parts.mesh.document()->topology());
  const MeshState& opened = parts.mesh.document()->state();
  parts.work.begin_drag(opened, DragGrip{{"flap"}, {}, {}}, {}, {});
  REQUIRE(parts.work.body_drag() != nullptr);
  CHECK(parts.work.coordinates() == &parts.work.body_drag()->coordinates());
  CHECK(parts.work.base()->mesh.coordinates == opened.mesh.coordinates);
  parts.jobs.stop();
  CHECK_FALSE(parts.work.active());
}

TEST_CASE("VCVs are edited ones only while a job edits them") {
  SessionParts parts(ring_mesh());
  parts.work.set_edited_vcvs({parts.mesh.vcv(), {}});
  CHECK(parts.work.edited_vcvs() == nullptr);
  REQUIRE(parts.jobs.start(ScrambleCommand{1}, true));
  CHECK(parts.work.edited_vcvs() == nullptr);
  parts.jobs.stop();
}

}  // namespace winslow::gui::test
