#include "gui/document/history/edit_history.h"

#include <doctest/doctest.h>

#include "gui/support/meshes.h"

namespace winslow::gui::test {

namespace {

/// The flap moved so far to the right.
CommandResult moved(const EditHistory& edits, double by) {
  CommandResult result;
  result.state = edits.history().state();
  auto& coordinates = result.state.mesh.coordinates;
  coordinates.set_xy(0, coordinates.xy(0) + Vec2(by, 0));
  return result;
}

EditHistory make_history(int steps = 0) {
  EditHistory edits(make_state(ring_mesh()));
  for (int k = 1; k <= steps; ++k) edits.push(SmoothCommand{}, moved(edits, 0.001 * k), k);
  return edits;
}

}  // namespace

TEST_CASE("Every mesh of a history has a revision of its own, redone or replaced") {
  EditHistory edits = make_history(2);
  CHECK(edits.revision() == 2);
  edits.undo();
  CHECK(edits.revision() == 1);
  edits.redo();
  CHECK(edits.revision() == 2);
  edits.undo();
  edits.push(SmoothCommand{}, moved(edits, 1), 5);
  CHECK(edits.revision() == 3);
  REQUIRE(edits.tags().size() == 3);
  CHECK(edits.tags()[2].seconds == 5);
}

TEST_CASE("Undo and redo stop at the ends, and a jump beyond them goes nowhere") {
  EditHistory edits = make_history(1);
  edits.redo();
  edits.go_to(7);
  CHECK(edits.history().position() == 1);
  edits.undo();
  edits.undo();
  CHECK(edits.history().position() == 0);
  edits.forget_redo();
  CHECK(edits.history().size() == 1);
  CHECK(edits.tags().size() == 1);
}

TEST_CASE("A history that is kept changes places with the present one, or takes its place") {
  EditHistory edits = make_history(2);
  edits.keep("Before step 2 was changed");
  edits.undo();
  edits.push(SmoothCommand{}, moved(edits, 1), 1);
  edits.bring_back(0);
  CHECK(edits.revision() == 2);
  REQUIRE(edits.kept().size() == 1);
  CHECK(edits.kept()[0].tags.back().revision == 3);
  edits.take_back();
  CHECK(edits.revision() == 3);
  CHECK(edits.kept().empty());
}

TEST_CASE("Of the histories that are kept the oldest goes") {
  EditHistory edits = make_history(1);
  for (std::size_t k = 0; k <= EditHistory::most_kept; ++k) edits.keep(std::to_string(k));
  REQUIRE(edits.kept().size() == EditHistory::most_kept);
  CHECK(edits.kept().front().why == "1");
}

}  // namespace winslow::gui::test
