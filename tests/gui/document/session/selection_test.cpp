#include "gui/document/session/selection.h"

#include "gui/support/session_parts.h"

namespace winslow::gui::test {

TEST_CASE("markers are selected alone or in addition; those that do not exist are left out") {
  SessionParts parts(two_body_mesh());
  Selection& selection = parts.selection;
  const Index left = parts.marker("left"), right = parts.marker("right");
  selection.on(action::SelectMarkers{{left, left, -1, 99}});
  CHECK(selection.markers() == std::vector<Index>{left});
  CHECK(selection.names() == std::vector<std::string>{"left"});
  selection.on(action::SelectMarkers{{right}, true});
  CHECK(selection.markers().size() == 2);
  CHECK(selection.contains(right));
  selection.on(action::SelectMarkers{{left}, true});
  CHECK(selection.markers() == std::vector<Index>{right});
  selection.on(action::SelectMarkers{{}});
  CHECK(selection.empty());
}

TEST_CASE("the pivot is the centre of what is selected until it is put elsewhere") {
  SessionParts parts(two_body_mesh());
  Selection& selection = parts.selection;
  selection.on(action::SelectMarkers{{parts.marker("left")}});
  CHECK(selection.pivot().isApprox(Vec2(-2, 0)));
  CHECK(selection.pivot_place() == PivotPlace::centre);
  selection.on(action::SetPivot{Vec2(1, 1), {}});
  CHECK(selection.pivot() == Vec2(1, 1));
  CHECK_FALSE(selection.pivot_place().has_value());
  // A refresh leaves a pivot where the user has put it; a new selection does not.
  selection.refresh();
  CHECK(selection.pivot() == Vec2(1, 1));
  selection.on(action::SelectMarkers{{parts.marker("right")}});
  CHECK(selection.pivot().isApprox(Vec2(2, 0)));
  // It goes with a body that is moved.
  MoveCommand up;
  up.bodies[0].motion = RigidMotion{0, Vec2(0, 0), Vec2(0, 1)};
  selection.moved(up);
  CHECK(selection.pivot().isApprox(Vec2(2, 1)));
}

TEST_CASE("nodes: one that does not exist is said, one without a VCV is not pinned") {
  SessionParts parts(ring_mesh());
  Selection& selection = parts.selection;
  const Index node = parts.free_node();
  const Index on_wall = parts.mesh.topology()->markers().nodes(parts.marker("flap"))[0];
  selection.on(action::SelectNode{node});
  CHECK(selection.nodes().inspected() == node);
  selection.on(action::SelectNode{123456});
  CHECK(selection.nodes().inspected() == node);
  CHECK(parts.notice().find("no node 123456") != std::string::npos);
  selection.on(action::HoverNode{123456});
  CHECK_FALSE(selection.nodes().hovered().has_value());
  selection.on(action::PinNodes{{node, on_wall}});
  CHECK(selection.nodes().pinned() == std::vector<Index>{node});
  selection.on(action::PinNodes{{node}, false});
  CHECK(selection.nodes().pinned().empty());
}

TEST_CASE("a deformation is shown as an outline, and not where its numbers make no sense") {
  SessionParts parts(two_body_mesh());
  Selection& selection = parts.selection;
  SineDeformation wave;
  wave.amplitude = 0.1;
  wave.waves = 1;
  selection.on(action::PreviewDeformation{wave});
  CHECK_FALSE(selection.deformation_preview().has_value());  // of nothing
  selection.on(action::SelectMarkers{{parts.marker("left")}});
  selection.on(action::PreviewDeformation{wave});
  REQUIRE(selection.deformation_preview().has_value());
  CHECK(selection.deformation_preview()->outline.size() == 8);
  wave.direction = Vec2(0, 0);
  selection.on(action::PreviewDeformation{wave});
  CHECK_FALSE(selection.deformation_preview().has_value());
}

TEST_CASE("markers are followed by name to a mesh of another connectivity") {
  SessionParts parts(two_body_mesh());
  Selection& selection = parts.selection;
  selection.on(action::SelectMarkers{{parts.marker("left")}});
  selection.on(action::PinNodes{{parts.free_node()}});
  REQUIRE(selection.nodes().pinned().size() == 1);
  const std::shared_ptr<const Topology> other = ring_mesh().topology;
  const auto before = parts.mesh.topology();
  selection.carry_over(before, other);
  CHECK(selection.empty());
  CHECK(selection.nodes().pinned().empty());
  // Back again, the nodes that were let go of are taken up.
  selection.carry_over(other, before);
  CHECK(selection.nodes().pinned().size() == 1);
}

}  // namespace winslow::gui::test
