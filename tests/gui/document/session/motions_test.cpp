#include "gui/document/session/motions.h"

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

namespace {

/// The parts with the flap selected.
struct Flap : SessionParts {
  Flap() : SessionParts(ring_mesh()) { selection.apply(action::SelectMarkers{{marker("flap")}}); }
  const MoveCommand& last() const {
    return std::get<MoveCommand>(done().command(done().position()));
  }
};

}  // namespace

TEST_CASE("a motion by numbers becomes one command of what is selected") {
  Flap parts;
  parts.motions.apply(action::ApplyMotion{{10, Vec2(0, 0), Vec2(0.1, 0)}});
  parts.finish();
  REQUIRE(parts.done().position() == 1);
  CHECK(parts.last().markers == std::vector<std::string>{"flap"});
  CHECK(parts.last().motion.rotate == 10);
  CHECK(parts.selection.pivot().isApprox(Vec2(0.1, 0)));
}

TEST_CASE("nothing selected, nothing moves") {
  SessionParts parts(ring_mesh());
  parts.motions.apply(action::ApplyMotion{{10, Vec2(0, 0), Vec2(0, 0)}});
  parts.motions.apply(action::BeginDrag{});
  parts.motions.apply(action::ApplyDeformation{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK_FALSE(parts.mesh.held().body);
}

TEST_CASE("a drag shows the mesh where the mouse is and ends as the command of its whole way") {
  Flap parts;
  parts.motions.apply(action::BeginDrag{});
  CHECK(parts.mesh.held().body);
  REQUIRE(parts.mesh.body_drag() != nullptr);
  parts.motions.apply(action::DragTo{{0, Vec2(0, 0), Vec2(0.05, 0)}});
  parts.motions.apply(action::DragTo{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  CHECK(parts.mesh.live_motion()->translate == Vec2(0.2, 0));
  parts.motions.apply(action::EndDrag{});
  CHECK_FALSE(parts.mesh.held().body);
  parts.finish();
  REQUIRE(parts.done().size() == 2);
  CHECK(parts.last().motion.translate.isApprox(Vec2(0.2, 0)));
}

TEST_CASE("a cancelled drag has never been") {
  Flap parts;
  const Coordinates before = parts.mesh.coordinates();
  parts.motions.apply(action::BeginDrag{});
  parts.motions.apply(action::DragTo{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  parts.motions.apply(action::CancelDrag{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK(parts.mesh.coordinates() == before);
  CHECK(parts.done().size() == 1);
  CHECK(parts.notice() == "Drag cancelled");
}

TEST_CASE("a drag that goes nowhere leaves no command and what was to be said of the mesh") {
  Flap parts;
  parts.motions.apply(action::BeginDrag{});
  parts.motions.apply(action::EndDrag{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK(parts.done().size() == 1);
}

TEST_CASE("shape editing begins with a radius of its own and lets go of its arc when it ends") {
  Flap parts;
  parts.motions.apply(action::SetShapeEdit{true, 0});
  const ShapeEdit& edit = parts.selection.shape_edit();
  CHECK(edit.active);
  CHECK(edit.radius > 0);
  parts.selection.apply(action::SelectArc{BoundaryArc{0, 1, 3}});
  parts.motions.apply(action::BeginDrag{true});
  CHECK(parts.mesh.held().body);
  // Not under the mouse.
  parts.motions.apply(action::SetShapeEdit{false, 0});
  CHECK(edit.active);
  parts.motions.apply(action::CancelDrag{});
  parts.motions.apply(action::SetShapeEdit{false, 0});
  CHECK_FALSE(edit.active);
  CHECK_FALSE(edit.arc.has_value());
}

}  // namespace winslow::gui::test
