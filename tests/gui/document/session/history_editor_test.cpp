#include "gui/document/session/history_editor.h"

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

namespace {

/// Two motions of the flap.
struct TwoMotions : SessionParts {
  TwoMotions() : SessionParts(ring_mesh()) {
    meshes.push_back(mesh.coordinates());
    for (const double degrees : {10.0, -25.0}) {
      selection.apply(action::SelectMarkers{{marker("flap")}});
      motions.apply(action::ApplyMotion{{degrees, Vec2(0, 0), Vec2(0, 0)}});
      finish();
      meshes.push_back(mesh.coordinates());
    }
  }
  std::vector<Coordinates> meshes;
};

}  // namespace

TEST_CASE("undo, redo and a jump show the mesh of that position") {
  TwoMotions parts;
  parts.history.apply(action::Undo{});
  CHECK(parts.mesh.coordinates() == parts.meshes[1]);
  parts.history.apply(action::Undo{});
  parts.history.apply(action::Undo{});  // there is no more
  CHECK(parts.mesh.coordinates() == parts.meshes[0]);
  parts.history.apply(action::Redo{});
  CHECK(parts.mesh.coordinates() == parts.meshes[1]);
  parts.history.apply(action::GoToStep{2});
  CHECK(parts.mesh.coordinates() == parts.meshes[2]);
  CHECK(parts.notice().find("The mesh is as it was after: ") == 0);
  parts.history.apply(action::GoToStep{0});
  CHECK(parts.notice() == "The mesh is as it was opened.");
}

TEST_CASE("undo takes back the drag under the mouse, or else the command under way") {
  TwoMotions parts;
  parts.motions.apply(action::BeginDrag{});
  parts.motions.apply(action::DragTo{{0, Vec2(0, 0), Vec2(0.1, 0)}});
  parts.history.apply(action::Undo{});
  CHECK_FALSE(parts.mesh.held().body);
  CHECK(parts.done().position() == 2);
  parts.jobs.apply(action::StepSolver{1});
  REQUIRE(parts.mesh.job().active());
  parts.history.apply(action::Undo{});
  CHECK_FALSE(parts.mesh.job().active());
  CHECK(parts.done().position() == 2);
  CHECK(parts.mesh.coordinates() == parts.meshes[2]);
}

TEST_CASE("a step is deleted, those after it run again, and the history before can be had back") {
  TwoMotions parts;
  parts.history.apply(action::DeleteStep{1});
  parts.finish();
  CHECK(parts.done().size() == 2);
  REQUIRE(parts.mesh.document()->edits().kept().size() == 1);
  CHECK(parts.mesh.coordinates() != parts.meshes[2]);
  parts.history.apply(action::BringBack{0});
  CHECK(parts.done().size() == 3);
  CHECK(parts.mesh.coordinates() == parts.meshes[2]);
}

TEST_CASE("a step is changed while nothing moves, and not otherwise") {
  TwoMotions parts;
  auto changed = std::get<MoveCommand>(parts.done().command(1));
  changed.motion.rotate = 15;
  parts.jobs.apply(action::StepSolver{1});
  parts.history.apply(action::EditStep{1, changed});
  CHECK(parts.notice().find("Wait until the solver is done") == 0);
  parts.jobs.apply(action::CancelSolver{});
  parts.history.apply(action::EditStep{1, changed});
  CHECK(parts.jobs.queue().active());
  parts.finish();
  REQUIRE(parts.done().size() == 3);
  CHECK(std::get<MoveCommand>(parts.done().command(1)).motion.rotate == 15);
  CHECK(parts.done().position() == 2);
}

}  // namespace winslow::gui::test
