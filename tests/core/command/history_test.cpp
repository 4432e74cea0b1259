#include "core/command/history.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

void apply(History& history, const Command& command) {
  history.push(command, execute(command, history.state()));
}

MoveCommand shift(double by) {
  MoveCommand command;
  command.bodies[0].markers = {"hole"};
  command.bodies[0].motion.translate = {by, 0};
  command.smooth.threads = 1;
  return command;
}

MeshState square_state() { return make_state(make_mesh(square_with_hole(10, Cells::triangles))); }

std::vector<std::string> names(const std::vector<Command>& commands) {
  std::vector<std::string> result;
  for (const Command& command : commands) result.push_back(describe(command));
  return result;
}

}  // namespace

TEST_CASE("a new history has nothing to undo or redo") {
  const MeshState state = square_state();
  History history(state);
  CHECK(history.size() == 1);
  CHECK(history.position() == 0);
  CHECK_FALSE(history.can_undo());
  CHECK_FALSE(history.can_redo());
  CHECK(history.recipe().empty());
  CHECK(history.state().mesh.coordinates == state.mesh.coordinates);
  CHECK_THROWS_AS(history.undo(), UsageError);
  CHECK_THROWS_AS(history.redo(), UsageError);
  CHECK_THROWS_AS(history.go_to(1), UsageError);
  CHECK_THROWS_AS(history.command(0), UsageError);
  CHECK_THROWS_AS(history.command(1), UsageError);
  CHECK_THROWS_AS(history.result(1), UsageError);
}

TEST_CASE("undo, redo and go_to restore states to the bit, topology is shared") {
  History history(square_state());
  std::vector<Coordinates> states{history.state().mesh.coordinates};
  for (const double by : {0.05, 0.03, -0.1}) {
    apply(history, shift(by));
    states.push_back(history.state().mesh.coordinates);
    CHECK(history.state().mesh.topology == history.initial().mesh.topology);
  }
  CHECK(history.size() == 4);
  CHECK(history.position() == 3);
  for (std::size_t k = 3; k > 0; --k) {
    CHECK(history.can_undo());
    history.undo();
    CHECK(history.position() == k - 1);
    CHECK(history.state().mesh.coordinates == states[k - 1]);
  }
  CHECK_FALSE(history.can_undo());
  history.redo();
  CHECK(history.state().mesh.coordinates == states[1]);
  for (const std::size_t k : {3u, 0u, 2u}) {
    history.go_to(k);
    CHECK(history.state().mesh.coordinates == states[k]);
    CHECK(history.can_redo() == (k < 3));
  }
  CHECK(history.initial().mesh.coordinates == states[0]);
  CHECK(history.result(2).converged);
  CHECK(describe(history.command(2)) == "Move hole by (0.03, 0)");
}

TEST_CASE("a new command forgets what could have been redone") {
  History history(square_state());
  for (const double by : {0.01, 0.02, 0.03}) apply(history, shift(by));
  history.go_to(1);
  apply(history, shift(-0.04));
  CHECK(history.size() == 3);
  CHECK(history.position() == 2);
  CHECK_FALSE(history.can_redo());
  CHECK(names(history.recipe()) ==
        std::vector<std::string>{"Move hole by (0.01, 0)", "Move hole by (-0.04, 0)"});
  history.go_to(0);
  apply(history, SmoothCommand{});
  CHECK(history.size() == 2);
  CHECK(names(history.recipe()) == std::vector<std::string>{"Smooth"});
}

TEST_CASE("a recipe goes up to the present position, and repeats to the bit") {
  History history(square_state());
  apply(history, shift(0.05));
  apply(history, ScrambleCommand{4});
  apply(history, SmoothCommand{});
  apply(history, shift(-0.02));
  history.undo();
  const auto recipe = history.recipe();
  CHECK(names(recipe) ==
        std::vector<std::string>{"Move hole by (0.05, 0)", "Scramble, seed 4", "Smooth"});
  MeshState state = history.initial();
  for (const Command& command : recipe) state = execute(command, state).state;
  CHECK(state.mesh.coordinates == history.state().mesh.coordinates);
}

TEST_CASE("a copy of a history goes its own way; its steps are shared") {
  History history(square_state());
  for (const double by : {0.01, 0.02, 0.03}) apply(history, shift(by));
  const History copy = history;
  CHECK(&copy.state(2) == &history.state(2));
  history.go_to(1);
  history.forget_redo();
  CHECK_FALSE(history.can_redo());
  CHECK(history.size() == 2);
  apply(history, shift(-0.04));
  CHECK(copy.size() == 4);
  CHECK(copy.position() == 3);
  CHECK(describe(copy.command(2)) == "Move hole by (0.02, 0)");
  CHECK(&copy.state(1) == &history.state(1));
  CHECK_THROWS_AS(history.state(3), UsageError);
}

TEST_CASE("motions keep the mesh of the last command that is none") {
  History history(square_state());
  CHECK(history.reference_position() == 0);
  apply(history, shift(0));  // moves nothing
  apply(history, shift(0.05));
  apply(history, ScrambleCommand{4});
  CHECK(history.reference_position() == 0);
  REQUIRE(history.state().reference);
  CHECK(*history.state().reference == history.initial().mesh.coordinates);
  apply(history, SmoothCommand{});
  CHECK(history.reference_position() == 4);
  apply(history, shift(-0.02));
  apply(history, shift(-0.03));
  CHECK(history.position() == 6);
  CHECK(history.reference_position() == 4);
  CHECK(*history.state().reference == history.state(4).mesh.coordinates);
  history.go_to(3);
  CHECK(history.reference_position() == 0);
  history.go_to(5);
  CHECK(history.reference_position() == 4);
}
