#include "gui/document/session/history_editor.h"

#include <doctest/doctest.h>

#include <fstream>

#include "gui/support/rig.h"
#include "gui/support/session_parts.h"
#include "io/recipe/recipe.h"

namespace winslow::gui::test {

namespace {

/// Two motions of the flap.
struct TwoMotions : SessionParts {
  TwoMotions() : SessionParts(ring_mesh()) {
    meshes.push_back(mesh.coordinates());
    for (const double degrees : {10.0, -25.0}) {
      selection.on(action::SelectMarkers{{marker("flap")}});
      motions.on(action::ApplyMotion{{degrees, Vec2(0, 0), Vec2(0, 0)}});
      finish();
      meshes.push_back(mesh.coordinates());
    }
  }
  std::vector<Coordinates> meshes;
};

}  // namespace

TEST_CASE("undo, redo and a jump show the mesh of that position") {
  TwoMotions parts;
  parts.history.on(action::Undo{});
  CHECK(parts.mesh.coordinates() == parts.meshes[1]);
  parts.history.on(action::Undo{});
  parts.history.on(action::Undo{});  // there is no more
  CHECK(parts.mesh.coordinates() == parts.meshes[0]);
  parts.history.on(action::Redo{});
  CHECK(parts.mesh.coordinates() == parts.meshes[1]);
  parts.history.on(action::GoToStep{2});
  CHECK(parts.mesh.coordinates() == parts.meshes[2]);
  CHECK(parts.notice().find("The mesh is as it was after: ") == 0);
  parts.history.on(action::GoToStep{0});
  CHECK(parts.notice() == "The mesh is as it was opened.");
}

TEST_CASE("undo takes back the drag under the mouse, or else the command under way") {
  TwoMotions parts;
  parts.motions.on(action::BeginDrag{});
  parts.motions.on(action::DragTo{{0, Vec2(0, 0), Vec2(0.1, 0)}});
  parts.history.on(action::Undo{});
  CHECK_FALSE(parts.work.held().body);
  CHECK(parts.done().position() == 2);
  parts.jobs.on(action::StepSolver{1});
  REQUIRE(parts.work.job().active());
  parts.history.on(action::Undo{});
  CHECK_FALSE(parts.work.job().active());
  CHECK(parts.done().position() == 2);
  CHECK(parts.mesh.coordinates() == parts.meshes[2]);
}

TEST_CASE("a step is deleted, those after it run again, and the history before can be had back") {
  TwoMotions parts;
  parts.history.on(action::DeleteStep{1});
  parts.finish();
  CHECK(parts.done().size() == 2);
  REQUIRE(parts.mesh.document()->edits().kept().size() == 1);
  CHECK(parts.mesh.coordinates() != parts.meshes[2]);
  parts.history.on(action::BringBack{0});
  CHECK(parts.done().size() == 3);
  CHECK(parts.mesh.coordinates() == parts.meshes[2]);
}

TEST_CASE("a step is changed while nothing moves, and not otherwise") {
  TwoMotions parts;
  auto changed = std::get<MoveCommand>(parts.done().command(1));
  changed.bodies[0].motion.rotate = 15;
  parts.jobs.on(action::StepSolver{1});
  parts.history.on(action::EditStep{1, changed});
  CHECK(parts.notice().find("Wait until the solver is done") == 0);
  parts.jobs.on(action::CancelSolver{});
  parts.history.on(action::EditStep{1, changed});
  CHECK(parts.jobs.queue().active());
  parts.finish();
  REQUIRE(parts.done().size() == 3);
  CHECK(std::get<MoveCommand>(parts.done().command(1)).bodies[0].motion.rotate == 15);
  CHECK(parts.done().position() == 2);
}

namespace {

/// Three motions; the mesh of each position.
std::vector<Coordinates> three_motions(Rig& rig) {
  rig.open(ring_mesh());
  std::vector<Coordinates> meshes{rig.mesh().coordinates};
  for (double degrees : {10.0, -25.0, 5.0}) {
    turn_flap(rig, degrees);
    meshes.push_back(rig.mesh().coordinates);
  }
  rig.click("tab/history");
  rig.frames(2);
  return meshes;
}

void right_click(Rig& rig, const std::string& widget) {
  const auto rect = rig.bench->widgets().find(widget);
  REQUIRE(rect.has_value());
  rig.move(rect->centre());
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(2);
}

/// The mesh of these rotations, one after the other, done by hand.
Coordinates by_hand(const std::vector<double>& rotations) {
  Rig rig;
  rig.open(ring_mesh());
  for (double degrees : rotations) turn_flap(rig, degrees);
  return rig.mesh().coordinates;
}

}  // namespace

TEST_CASE("the status line says where in the history the mesh is") {
  Rig rig(1300, 900);
  three_motions(rig);
  const auto said = [&] { return rig.session().messages().notice()->text; };
  rig.key(keys::z, {keys::control});
  CHECK(said() == "Undone: Rotate flap by 5 deg");
  rig.key(keys::z, {keys::control, keys::shift});
  CHECK(said() == "Done again: Rotate flap by 5 deg");
  rig.click("history/1");
  CHECK(said() == "The mesh is as it was after: Rotate flap by 10 deg");
  rig.click("history/0");
  CHECK(said() == "The mesh is as it was opened.");
}

TEST_CASE("editing a past command gives the mesh that doing it by hand gives") {
  Rig rig(1300, 900);
  const auto meshes = three_motions(rig);
  right_click(rig, "history/2");
  rig.click("history/menu/edit");
  rig.frames(3);
  REQUIRE(rig.visible("edit/rotate"));
  rig.fill("edit/rotate", "-12");
  rig.click("edit/run");
  REQUIRE(rig.settle());
  const History& history = rig.document().history();
  REQUIRE(history.size() == 4);
  CHECK(history.position() == 3);
  CHECK(std::get<MoveCommand>(history.command(2)).bodies[0].motion.rotate == -12);
  CHECK(rig.mesh().coordinates == by_hand({10, -12, 5}));
  CHECK(history.state(1).mesh.coordinates == meshes[1]);
  CHECK(history.initial().mesh.coordinates == meshes[0]);
}

TEST_CASE("what an edit replaced can be brought back, every position to the bit") {
  Rig rig(1300, 1000);
  const auto meshes = three_motions(rig);
  Command command = rig.document().history().command(1);
  std::get<MoveCommand>(command).bodies[0].motion.rotate = 30;
  rig.bench->apply(action::EditStep{1, command});
  REQUIRE(rig.settle());
  const Coordinates edited = rig.mesh().coordinates;
  CHECK(edited != meshes[3]);
  REQUIRE(rig.document().edits().kept().size() == 1);
  rig.frames(2);
  rig.click("history/kept/0");
  for (std::size_t k = meshes.size(); k-- > 0;) {
    rig.bench->apply(action::GoToStep{k});
    CHECK(rig.session().coordinates() == meshes[k]);
  }
  // The two have changed places.
  rig.bench->apply(action::BringBack{0});
  CHECK(rig.session().coordinates() == edited);
}

TEST_CASE("options of a past command are edited in the form of the solver panel") {
  Rig rig(1300, 1000);
  rig.open(ring_mesh());
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.click("tab/history");
  rig.frames(2);
  rig.click("history/edit");
  rig.frames(3);
  REQUIRE(rig.visible("edit/max_iterations"));
  rig.fill("edit/max_iterations", "-4");
  rig.frames(2);
  CHECK_FALSE(rig.bench->widgets().find("edit/run")->enabled);
  rig.fill("edit/max_iterations", "2");
  rig.click("edit/run");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(rig.document().history().result(1).outer_iterations <= 2);
  CHECK_FALSE(rig.document().history().result(1).converged);
  CHECK(rig.session().solver_settings().smooth_options().max_iterations ==
        SmoothOptions{}.max_iterations);
}

TEST_CASE("deleting a step runs those after it again without it") {
  Rig rig(1300, 900);
  three_motions(rig);
  right_click(rig, "history/2");
  rig.click("history/menu/delete");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 3);
  CHECK(rig.document().history().position() == 2);
  CHECK(rig.mesh().coordinates == by_hand({10, 5}));
  rig.frames(2);
  rig.click("history/delete");
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 2);
  CHECK(rig.mesh().coordinates == by_hand({10}));
}

TEST_CASE("an edit ends where the user was in the history") {
  Rig rig(1300, 900);
  three_motions(rig);
  rig.bench->apply(action::GoToStep{1});
  rig.bench->apply(action::DeleteStep{2});
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 3);
  CHECK(rig.document().history().position() == 1);
  rig.bench->apply(action::Redo{});
  CHECK(rig.mesh().coordinates == by_hand({10, 5}));
}

TEST_CASE("a cancelled edit leaves the history as it was") {
  Rig rig(1300, 900);
  const auto meshes = three_motions(rig);
  Command endless = rig.document().history().command(2);
  auto& move = std::get<MoveCommand>(endless);
  move.how.increments = 1;
  move.smooth.formulation = Formulation::pointwise;
  move.smooth.outer = OuterMethod::picard;
  move.smooth.damping = 1e-6;
  move.smooth.adapt_damping = false;
  move.smooth.acceleration = 0;
  move.smooth.max_iterations = 10000000;
  rig.bench->apply(action::EditStep{2, endless});
  REQUIRE(rig.wait([&] { return rig.session().mesh().convergence().size() > 3; }));
  CHECK(rig.session().jobs().queue().active());
  rig.frames(2);
  REQUIRE(rig.visible("history/cancel"));
  CHECK(rig.visible("history/progress"));
  rig.click("history/cancel");
  CHECK_FALSE(rig.session().job().active());
  CHECK_FALSE(rig.session().jobs().queue().active());
  REQUIRE(rig.document().history().size() == 4);
  CHECK(rig.document().history().position() == 3);
  for (std::size_t k = 0; k < meshes.size(); ++k)
    CHECK(rig.document().history().state(k).mesh.coordinates == meshes[k]);
  CHECK(rig.document().edits().kept().empty());
}

TEST_CASE("an edit that fails on the way says where and keeps what was there") {
  Rig rig(1300, 900);
  const auto meshes = three_motions(rig);
  Command wrong = rig.document().history().command(2);
  std::get<MoveCommand>(wrong).bodies[0].markers = {"nobody"};
  rig.bench->apply(action::EditStep{2, wrong});
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  CHECK(rig.session().messages().prompt()->text.find("Step 2") != std::string::npos);
  CHECK(rig.session().messages().prompt()->text.find("nobody") != std::string::npos);
  CHECK(rig.document().history().size() == 2);
  CHECK(rig.mesh().coordinates == meshes[1]);
  rig.frames(3);
  rig.click("prompt/Bring it back");
  CHECK(rig.mesh().coordinates == meshes[3]);
  CHECK(rig.document().history().size() == 4);
}

TEST_CASE("a recipe that is saved and replayed gives the same mesh") {
  Rig rig(1300, 900);
  const auto meshes = three_motions(rig);
  const auto path = rig.folder / "turns.json";
  rig.click("history/save_recipe");
  rig.frames(2);
  rig.fill("dialog/name", path.string());
  rig.click("dialog/accept");
  REQUIRE(std::filesystem::exists(path));
  rig.bench->apply(action::GoToStep{0});
  rig.click("history/replay");
  rig.frames(2);
  rig.fill("dialog/name", path.string());
  rig.click("dialog/accept");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 4);
  for (std::size_t k = 0; k < meshes.size(); ++k)
    CHECK(rig.document().history().state(k).mesh.coordinates == meshes[k]);
  // What could have been redone before is not lost either.
  CHECK(rig.document().edits().kept().size() == 1);
}

TEST_CASE("a recipe with an error is refused with its line, one that fails stops there") {
  Rig rig(1300, 900);
  rig.open(ring_mesh());
  const auto path = rig.folder / "wrong.json";
  std::ofstream(path) << "{\n\"winslow_recipe\": 1,\n\"commands\": [{\"command\": \"fly\"}]\n}\n";
  rig.bench->apply(action::ReplayRecipe{path});
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  CHECK(rig.session().messages().prompt()->text.find("wrong.json:3") != std::string::npos);
  rig.frames(2);
  rig.click("prompt/OK");
  MoveCommand first{{{{"flap"}, {10, Vec2(0, 0), Vec2(0, 0)}}}, {}, {}};
  MoveCommand second = first;
  second.bodies[0].markers = {"wing"};
  io::write_recipe(path, {"", "", {first, second, first}});
  rig.bench->apply(action::ReplayRecipe{path});
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  CHECK(rig.session().messages().prompt()->text.find("Step 2") != std::string::npos);
  CHECK(rig.session().messages().prompt()->text.find("wing") != std::string::npos);
  CHECK(rig.document().history().size() == 2);
  CHECK(rig.document().history().position() == 1);
}

}  // namespace winslow::gui::test
