#include "gui/document/session/solver_settings.h"

#include "gui/support/session_parts.h"
#include "support/paths.h"

namespace winslow::gui::test {

namespace {

/// Settings of a ring, whose flap slides.
struct SlidingFlap : SessionParts {
  SlidingFlap() : SessionParts(ring_mesh()) {
    SmoothOptions options;
    options.slide.markers = {"flap"};
    options.keep_outside.radius = 3;
    settings.on(action::EditSmoothOptions{whole(options)});
  }
};

}  // namespace

TEST_CASE("a marker that a motion takes along does not slide meanwhile") {
  const SlidingFlap parts;
  CHECK(parts.settings.smooth_in_place().slide.markers == std::vector<std::string>{"flap"});
  CHECK(parts.settings.smooth_for_motion({"flap"}).slide.markers.empty());
  const MoveCommand move = parts.settings.move_command({"flap"}, {10, Vec2(0, 0), Vec2(0, 0)});
  CHECK(move.bodies[0].markers == std::vector<std::string>{"flap"});
  CHECK(move.smooth.slide.markers.empty());
  CHECK(move.smooth.keep_outside.radius == 3);
}

TEST_CASE("what was set for one mesh is forgotten for the next") {
  SlidingFlap parts;
  SmoothOptions options = parts.settings.smooth_options();
  options.tolerance = 1e-3;
  parts.settings.on(
      action::EditSmoothOptions{difference(parts.settings.smooth_options(), options)});
  parts.settings.forget_mesh();
  CHECK_FALSE(parts.settings.smooth_options().slide.given());
  CHECK_FALSE(parts.settings.smooth_options().keep_outside.given());
  CHECK(parts.settings.smooth_options().tolerance == 1e-3);
}

TEST_CASE("a mesh opens with what its file says of its boundary") {
  SessionParts parts(ring_mesh());
  parts.mesh.open(
      std::make_unique<Document>(Document::load(winslow::test::test_data("openfoam/cyclic"))));
  parts.settings.forget_mesh();
  CHECK(parts.settings.smooth_options().slide.markers == std::vector<std::string>{"top"});
  CHECK(parts.settings.smooth_options().slide.periodic_from_file);
}

TEST_CASE("an override of a node is taken back and made again, until a command begins") {
  SlidingFlap parts;
  const Index node = parts.mesh.topology()->markers().nodes(parts.marker("flap")).front();
  const auto revision = parts.mesh.document()->edits().revision();
  parts.settings.on(action::OverrideNode{node, NodeOverride::hold});
  const auto& held = parts.settings.smooth_options().slide.hold_nodes;
  CHECK(held == std::vector<Index>{node});
  parts.settings.on(action::StepOverride{false});
  CHECK(held.empty());
  CHECK_FALSE(parts.settings.overrides().redoable(revision).empty());
  REQUIRE(parts.jobs.start(ScrambleCommand{1}, true));
  CHECK(parts.settings.overrides().redoable(revision).empty());
  parts.jobs.stop();
}

}  // namespace winslow::gui::test
