#include "gui/document/session/jobs.h"

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

TEST_CASE("a command that is done stands in the history; a second one has to wait for it") {
  SessionParts parts(tangled_mesh());
  REQUIRE(parts.jobs.start(SmoothCommand{}, true));
  CHECK(parts.mesh.in_motion());
  CHECK_FALSE(parts.jobs.start(SmoothCommand{}, false));
  CHECK(parts.notice().find("The solver is at work on") != std::string::npos);
  parts.jobs.on(action::ResumeSolver{});
  parts.finish();
  CHECK(parts.done().size() == 2);
  CHECK(parts.notice().find("converged in") != std::string::npos);
  CHECK_FALSE(parts.jobs.working());
}

TEST_CASE("settings that cannot be used are said, and nothing begins") {
  SessionParts parts(ring_mesh());
  SmoothOptions bad;
  bad.tolerance = -1;
  parts.settings.on(action::EditSmoothOptions{whole(bad)});
  parts.jobs.on(action::RunSmooth{});
  CHECK_FALSE(parts.mesh.in_motion());
  REQUIRE(parts.messages.prompt() != nullptr);
  CHECK(parts.messages.prompt()->kind == Prompt::Kind::error);
}

TEST_CASE("a cancelled command leaves the mesh and the history as they were") {
  SessionParts parts(tangled_mesh());
  const Coordinates before = parts.mesh.coordinates();
  parts.jobs.on(action::StepSolver{2});
  CHECK(parts.mesh.in_motion());
  parts.jobs.on(action::CancelSolver{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK(parts.done().size() == 1);
  CHECK(parts.mesh.coordinates() == before);
  CHECK(parts.notice().find("Cancelled: ") == 0);
  // The banner of the mesh as it was opened is back.
  CHECK(parts.messages.banner().has_value());
}

TEST_CASE("the commands of a plan follow each other; a bad one ends it and says which") {
  SessionParts parts(ring_mesh());
  CommandQueue::Plan plan;
  plan.title = "Replaying a recipe";
  plan.commands = {ScrambleCommand{3}, SmoothCommand{}, MoveCommand{{{{"nowhere"}, {}}}, {}, {}}};
  parts.jobs.start(plan);
  CHECK(parts.jobs.queue().active());
  parts.finish();
  CHECK_FALSE(parts.jobs.queue().active());
  CHECK(parts.done().size() == 3);
  REQUIRE(parts.messages.prompt() != nullptr);
  CHECK(parts.messages.prompt()->title == "Replaying a recipe stopped");
  CHECK(parts.messages.prompt()->text.find("Step 3") == 0);
}

TEST_CASE("a step that is carried out again leaves the history as it is") {
  SessionParts parts(ring_mesh());
  parts.jobs.on(action::Scramble{1});
  parts.finish();
  parts.jobs.on(action::RunSmooth{});
  parts.finish();
  const Coordinates after = parts.mesh.coordinates();
  parts.jobs.on(action::RerunStep{2});
  CHECK(parts.work.job().paused());
  CHECK(parts.done().position() == 1);
  parts.jobs.on(action::ResumeSolver{});
  parts.finish();
  CHECK(parts.done().size() == 3);
  CHECK(parts.done().position() == 2);
  CHECK(parts.mesh.coordinates() == after);
}

TEST_CASE("only the direct method is slowed down, and not below standing still") {
  SessionParts parts(ring_mesh());
  parts.jobs.on(action::SetPace{-3});
  CHECK(parts.jobs.pace() == 0);
  parts.jobs.on(action::SetPace{4});
  CHECK(parts.jobs.pace() == 4);
}

TEST_CASE("a recipe's rotation without a pivot is about the point that the studio would take") {
  SessionParts parts(two_body_mesh());
  parts.selection.on(action::SelectMarkers{{parts.marker("left")}});
  MoveCommand open{{{{"left"}, {}}}, {}, {}};
  open.bodies[0].motion.rotate = 10;
  CommandQueue::Plan plan;
  plan.commands = {open};
  const Vec2 pivot = parts.selection.pivot();
  parts.jobs.start(plan);
  parts.finish();
  REQUIRE(parts.done().size() == 2);
  CHECK(std::get<MoveCommand>(parts.done().command(1)).bodies[0].motion.pivot == pivot);
  CHECK((parts.selection.pivot() - pivot).norm() < 1e-9);
}

}  // namespace winslow::gui::test
