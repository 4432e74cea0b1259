#include "gui/document/session/body_plan.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "core/motion/rigid_motion.h"
#include "gui/support/session_parts.h"
#include "support/meshes.h"

namespace winslow::gui::test {

namespace {

/// Bodies left, at [-2.5, -1.5], and right, at [1.5, 2.5], both 1 high, in a box.
struct TwoBodies : SessionParts {
  TwoBodies() : SessionParts(two_body_mesh(2)) {}

  void list(const std::vector<std::string>& names, const RigidMotion& motion) {
    std::vector<Index> markers;
    for (const std::string& name : names) markers.push_back(marker(name));
    selection.on(action::SelectMarkers{markers});
    selection.on(action::PlanBody{motion});
  }
  void list_both() {
    list({"left"}, {.rotate = 10});
    list({"right"}, {-20, Vec2(1.5, 0), Vec2(0.1, 0)});
  }
  void apply() {
    motions.on(action::ApplyBodyPlan{});
    finish();
  }
  const BodyPlan& plan() const { return selection.plan(); }
};

}  // namespace

TEST_CASE("listed bodies move together, each by its own motion, as one command") {
  TwoBodies parts;
  const Mesh before = parts.mesh.document()->state().mesh;
  parts.list_both();
  REQUIRE(parts.plan().bodies().size() == 2);
  CHECK(parts.plan().fault().empty());
  parts.motions.on(action::ApplyBodyPlan{});
  CHECK(parts.mesh.in_motion());
  CHECK(parts.plan().outline().empty());
  parts.finish();
  REQUIRE(parts.done().size() == 2);
  const auto& move = std::get<MoveCommand>(parts.done().command(1));
  REQUIRE(move.bodies.size() == 2);
  CHECK(move.bodies[0] == MovingBody{{"left"}, {10, Vec2(-2, 0), Vec2(0, 0)}});
  CHECK(move.bodies[1] == MovingBody{{"right"}, {-20, Vec2(1.5, 0), Vec2(0.1, 0)}});
  const Coordinates& now = parts.mesh.coordinates();
  for (const MovingBody& body : move.bodies)
    for (const Index node : before.topology->markers().nodes_of(body.markers))
      CHECK((now.xy(node) - transform(body.motion, before.coordinates.xy(node))).norm() < 1e-12);
  CHECK(check_validity(*before.topology, now).inverted == 0);
  CHECK(parts.plan().empty());
}

TEST_CASE("undo brings the list back as it was, and redo ends it") {
  TwoBodies parts;
  parts.list_both();
  const std::vector<MovingBody> listed = parts.plan().bodies();
  parts.apply();
  REQUIRE(parts.plan().empty());
  parts.history.on(action::Undo{});
  CHECK(parts.plan().bodies() == listed);
  CHECK_FALSE(parts.plan().bodies()[0].motion.pivot);
  parts.history.on(action::Redo{});
  CHECK(parts.plan().empty());
  parts.history.on(action::GoToStep{0});
  REQUIRE(parts.plan().bodies() == listed);
  // Changed, it is another list, and its command another one.
  parts.list({"left"}, {.rotate = 5});
  parts.apply();
  REQUIRE(parts.done().size() == 2);
  CHECK(std::get<MoveCommand>(parts.done().command(1)).bodies[0].motion.rotate == 5);
  CHECK(parts.plan().empty());
  // What was cleared does not return.
  parts.history.on(action::Undo{});
  REQUIRE(parts.plan().bodies().size() == 2);
  parts.selection.on(action::ClearBodyPlan{});
  parts.history.on(action::Redo{});
  parts.history.on(action::Undo{});
  CHECK(parts.plan().empty());
}

TEST_CASE("a list outlives a cancelled command and the motion of one of its bodies") {
  TwoBodies parts;
  parts.list_both();
  parts.motions.on(action::ApplyBodyPlan{});
  parts.history.on(action::Undo{});  // cancels
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK(parts.done().size() == 1);
  REQUIRE(parts.plan().bodies().size() == 2);
  // The right body is selected: its listed pivot goes with it, that of the left one stays its
  // centre.
  parts.motions.on(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0, 0.25)}});
  parts.finish();
  REQUIRE(parts.done().size() == 2);
  REQUIRE(parts.plan().bodies().size() == 2);
  CHECK(parts.plan().bodies()[1].motion.pivot == Vec2(1.5, 0.25));
  CHECK_FALSE(parts.plan().bodies()[0].motion.pivot);
  // A list of one body is no exception.
  parts.selection.on(action::UnplanBody{0});
  parts.motions.on(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0, 0.25)}});
  parts.finish();
  REQUIRE(parts.plan().bodies().size() == 1);
  CHECK(parts.plan().bodies()[0].motion.pivot == Vec2(1.5, 0.5));
}

TEST_CASE("a marker is in one listed body, and outlines show where the bodies go") {
  TwoBodies parts;
  parts.selection.on(action::PlanBody{{.rotate = 10}});
  CHECK(parts.plan().empty());  // nothing is selected
  parts.motions.on(action::ApplyBodyPlan{});
  CHECK_FALSE(parts.mesh.in_motion());

  parts.list({"left", "right"}, {.translate = Vec2(0, 0.5)});
  const auto highest = [&] {
    double most = -1e9;
    for (const auto& [a, b] : parts.plan().outline()) most = std::max({most, a.y(), b.y()});
    return most;
  };
  CHECK(parts.plan().outline().size() == 32);
  CHECK(highest() == doctest::Approx(1));
  parts.list({"left"}, {.translate = Vec2(0, 0.75)});
  REQUIRE(parts.plan().bodies().size() == 2);
  CHECK(parts.plan().bodies()[0].markers == std::vector<std::string>{"right"});
  CHECK(parts.plan().find({"left"})->translate == Vec2(0, 0.75));
  CHECK(parts.plan().find({"left", "right"}) == nullptr);
  CHECK(parts.plan().contains("right"));
  CHECK_FALSE(parts.plan().contains("outer"));
  CHECK(parts.plan().outline().size() == 32);
  CHECK(highest() == doctest::Approx(1.25));
  parts.list({"left"}, {});
  CHECK(parts.plan().bodies().size() == 2);
  CHECK(highest() == doctest::Approx(1));
  CHECK(parts.plan().moves());
  parts.selection.on(action::UnplanBody{0});
  CHECK_FALSE(parts.plan().moves());
  parts.selection.on(action::UnplanBody{7});
  CHECK(parts.plan().bodies().size() == 1);
  parts.selection.on(action::ClearBodyPlan{});
  CHECK(parts.plan().empty());
  CHECK(parts.plan().outline().empty());
}

TEST_CASE("listed bodies that would tear a node apart say so") {
  namespace meshes = winslow::test;
  SessionParts parts(make_mesh(meshes::square(4, meshes::Cells::quads)));
  const auto list = [&](const char* name, const Vec2& by) {
    parts.selection.on(action::SelectMarkers{{parts.marker(name)}});
    parts.selection.on(action::PlanBody{{.translate = by}});
  };
  list("bottom", Vec2(0, 0.1));
  list("left", Vec2(0.1, 0));
  CHECK(parts.selection.plan().fault().starts_with("the markers bottom and left share node "));
  CHECK(parts.selection.plan().outline().empty());
  list("left", Vec2(0, 0.1));
  CHECK(parts.selection.plan().fault().empty());
  CHECK_FALSE(parts.selection.plan().outline().empty());
}

}  // namespace winslow::gui::test
