#include "gui/document/session/motions.h"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "core/command/command.h"
#include "core/motion/rigid_motion.h"
#include "gui/support/moving_rig.h"
#include "gui/support/session_parts.h"

namespace winslow::gui::test {

namespace {

/// The parts with the flap selected.
struct Flap : SessionParts {
  Flap() : SessionParts(ring_mesh()) { selection.on(action::SelectMarkers{{marker("flap")}}); }
  const MoveCommand& last() const {
    return std::get<MoveCommand>(done().command(done().position()));
  }
};

}  // namespace

TEST_CASE("a motion by numbers becomes one command of what is selected") {
  Flap parts;
  parts.motions.on(action::ApplyMotion{{10, Vec2(0, 0), Vec2(0.1, 0)}});
  parts.finish();
  REQUIRE(parts.done().position() == 1);
  CHECK(parts.last().bodies[0].markers == std::vector<std::string>{"flap"});
  CHECK(parts.last().bodies[0].motion.rotate == 10);
  CHECK(parts.selection.pivot().isApprox(Vec2(0.1, 0)));
}

TEST_CASE("a motion by nothing is no step of the history, and leaves the mesh as it is") {
  Flap parts;
  const Coordinates before = parts.mesh.coordinates();
  parts.motions.on(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0, 0)}});
  parts.finish();
  CHECK(parts.done().position() == 0);
  CHECK(parts.mesh.coordinates() == before);
}

TEST_CASE("nothing selected, nothing moves") {
  SessionParts parts(ring_mesh());
  parts.motions.on(action::ApplyMotion{{10, Vec2(0, 0), Vec2(0, 0)}});
  parts.motions.on(action::BeginDrag{});
  parts.motions.on(action::ApplyDeformation{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK_FALSE(parts.work.held().body);
}

TEST_CASE(
    "nodes move by a file that is read first, on the boundary and inside, with nothing selected") {
  SessionParts parts(ring_mesh());
  const Coordinates before = parts.mesh.coordinates();
  const Index inside = parts.free_node();
  const Index wall = parts.mesh.topology()->markers().nodes(parts.marker("flap")).front();
  const auto carry_out = [&](const std::string& text, bool positions) {
    const auto file = parts.folder / "nodes.csv";
    std::ofstream(file) << text;
    parts.motions.on(action::MoveNodesOfFile{file, positions});
    while (!parts.motions.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    parts.finish();
  };
  std::ostringstream ways;
  ways << "node,dx,dy\n" << inside << ",0.003,0.002\n" << wall << ",0.002,0\n";
  carry_out(ways.str(), false);
  REQUIRE(parts.done().position() == 1);
  CHECK(describe(parts.done().command(1)) == "Displace 2 nodes");
  CHECK(parts.done().result(1).inverted == 0);
  const Coordinates after = parts.mesh.coordinates();
  CHECK(after.xy(inside) == Vec2(before.xy(inside) + Vec2(0.003, 0.002)));
  CHECK(after.xy(wall) == Vec2(before.xy(wall) + Vec2(0.002, 0)));
  // Back to where they were.
  std::ostringstream places;
  places.precision(17);
  places << "node,x,y\n";
  for (const Index node : {inside, wall})
    places << node << ',' << before.xy(node).x() << ',' << before.xy(node).y() << '\n';
  carry_out(places.str(), true);
  REQUIRE(parts.done().position() == 2);
  CHECK(describe(parts.done().command(2)) == "Put 2 nodes to given positions");
  for (const Index node : {inside, wall})
    CHECK(parts.mesh.coordinates().xy(node) == before.xy(node));
  // Neither file is what the other is, and a node that is not there is none.
  carry_out(places.str(), false);
  CHECK(parts.done().position() == 2);
  REQUIRE(parts.messages.prompt());
  CHECK(parts.messages.prompt()->title == "Cannot read nodes.csv");
  parts.messages.on(action::DismissPrompt{});
  carry_out("node,dx,dy\n100000,0,0\n", false);
  CHECK(parts.done().position() == 2);
  REQUIRE(parts.messages.prompt());
  CHECK(parts.messages.prompt()->title == "These nodes cannot be moved");
}

TEST_CASE("a drag shows the mesh where the mouse is and ends as the command of its whole way") {
  Flap parts;
  parts.motions.on(action::BeginDrag{});
  CHECK(parts.work.held().body);
  REQUIRE(parts.work.body_drag() != nullptr);
  parts.motions.on(action::DragTo{{0, Vec2(0, 0), Vec2(0.05, 0)}});
  parts.motions.on(action::DragTo{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  CHECK(parts.mesh.live_motion()->translate == Vec2(0.2, 0));
  parts.motions.on(action::EndDrag{});
  CHECK_FALSE(parts.work.held().body);
  parts.finish();
  REQUIRE(parts.done().size() == 2);
  CHECK(parts.last().bodies[0].motion.translate.isApprox(Vec3(0.2, 0, 0)));
}

TEST_CASE("a cancelled drag has never been") {
  Flap parts;
  const Coordinates before = parts.mesh.coordinates();
  parts.motions.on(action::BeginDrag{});
  parts.motions.on(action::DragTo{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  parts.motions.on(action::CancelDrag{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK(parts.mesh.coordinates() == before);
  CHECK(parts.done().size() == 1);
  CHECK(parts.notice() == "Drag cancelled");
}

TEST_CASE("a drag that goes nowhere leaves no command and what was to be said of the mesh") {
  Flap parts;
  parts.motions.on(action::BeginDrag{});
  parts.motions.on(action::EndDrag{});
  CHECK_FALSE(parts.mesh.in_motion());
  CHECK(parts.done().size() == 1);
}

TEST_CASE("shape editing begins with a radius of its own and lets go of its arc when it ends") {
  Flap parts;
  parts.motions.on(action::SetShapeEdit{true, 0});
  const ShapeEdit& edit = parts.selection.shape_edit();
  CHECK(edit.active);
  CHECK(edit.radius > 0);
  parts.selection.on(action::SelectArc{BoundaryArc{0, 1, 3}});
  parts.motions.on(action::BeginDrag{true});
  CHECK(parts.work.held().body);
  // Not under the mouse.
  parts.motions.on(action::SetShapeEdit{false, 0});
  CHECK(edit.active);
  parts.motions.on(action::CancelDrag{});
  parts.motions.on(action::SetShapeEdit{false, 0});
  CHECK_FALSE(edit.active);
  CHECK_FALSE(edit.arc.has_value());
}

namespace {

/// Drags from a place to others one after the other, waits for the mesh there, and goes back to the
/// first place, whence the mouse lets go. The mesh is then the one before, to the bit, and the
/// history what it was.
void drag_and_return(Rig& rig, const ScreenPoint& from, const std::vector<ScreenPoint>& there) {
  const Coordinates before = rig.session().coordinates();
  const std::size_t steps = rig.document().history().size();
  const bool banner = rig.session().messages().banner().has_value();
  rig.drag(from, there.front(), 5);
  for (const ScreenPoint& place : there) rig.move(place);
  REQUIRE(rig.session().dragging());
  REQUIRE(rig.wait([&] {
    const BodyDrag* drag = rig.session().mesh().work().body_drag();
    return rig.session().coordinates() != before && (!drag || drag->settled());
  }));
  for (std::size_t k = there.size(); k-- > 0;) rig.move(there[k] + ScreenVector(1.5, 0.25));
  rig.move(from);
  rig.frames();
  CHECK(rig.session().dragging());
  if (rig.session().mesh().work().body_drag()) CHECK(rig.session().coordinates() == before);
  rig.release();
  REQUIRE(rig.settle());
  CHECK(rig.session().coordinates() == before);
  CHECK(rig.mesh().coordinates == before);
  CHECK(rig.document().history().size() == steps);
  CHECK(rig.session().messages().banner().has_value() == banner);
}

/// Places on the ring of a gizmo, from the knob on.
std::vector<ScreenPoint> around_ring(const Gizmo& gizmo, const ScreenPoint& from, double degrees) {
  std::vector<ScreenPoint> places;
  constexpr int count = 12;
  for (int k = 1; k <= count; ++k)
    places.push_back(around(gizmo.centre, from, degrees * k / count));
  return places;
}

Mesh moved_by(Mesh mesh, const Vec2& way) {
  for (Index node = 0; node < mesh.coordinates.size(); ++node)
    mesh.coordinates.set_xy(node, mesh.coordinates.xy(node) + way);
  return mesh;
}

}  // namespace

TEST_CASE("a drag that returns to where it began leaves the mesh as opened, to the bit") {
  for (const Vec2& far : {Vec2(0, 0), Vec2(4.5e5, 5.1e6)}) {
    Rig rig;
    rig.open(moved_by(ring_mesh(), far));
    // A strip with a message above the mesh takes the picture elsewhere.
    const auto drag = [&](const Vec2& body, const std::vector<ScreenVector>& ways) {
      const ScreenPoint from = rig.pixel(far + body);
      std::vector<ScreenPoint> there;
      for (const ScreenVector& way : ways) there.push_back(from + way);
      drag_and_return(rig, from, there);
    };
    const Vec2 opened(0, 0), moved(0.05, 0);
    drag(opened, {{31, -17}, {44, 9}, {12, -38}, {27, 3}});
    const Gizmo gizmo = rig.gizmo();
    drag_and_return(rig, *gizmo.knob, around_ring(gizmo, *gizmo.knob, 35));
    // At once, by jobs.
    rig.bench->apply(action::EditMotionOptions{whole(MotionOptions{1, true})});
    drag(opened, {{20, -11}});
    rig.bench->apply(action::EditMotionOptions{whole(MotionOptions{})});
    // After a smoothing it is that mesh, and after a motion the mesh of that.
    rig.bench->apply(action::RunSmooth{});
    REQUIRE(rig.settle());
    rig.frames();
    drag(opened, {{-25, 12}, {-13, 30}});
    rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), moved}});
    REQUIRE(rig.settle());
    rig.frames();
    drag(moved, {{-25, 12}});
  }
}

TEST_CASE(
    "an arc of a boundary that is dragged and returns leaves the mesh as opened, to the bit") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::e);
  rig.bench->apply(action::SetShapeEdit{true, 0.3});
  const ScreenPoint top = rig.pixel(Vec2(0, 0.15));  // a node of the ellipse
  drag_and_return(rig, top, {top + ScreenVector(3, -14), top + ScreenVector(1, -8)});
}

TEST_CASE("bodies in space that are dragged and return leave the mesh as opened, to the bit") {
  for (const bool stands : {false, true}) {
    MovingStudio studio(
        make_mesh(stands ? winslow::test::box_with_body_on_two_planes(
                               6, winslow::test::Volumes::tetrahedra)
                         : winslow::test::cube_with_cavity(6, winslow::test::Volumes::mixed)),
        stands ? "body" : "cavity");
    const ScreenPoint along = studio.handle("arrow/x");
    drag_and_return(studio, along, {along + ScreenVector(14, 9), along + ScreenVector(22, 13)});
    studio.key(GLFW_KEY_5);  // from +z
    studio.frames();
    const ScreenPoint ring = studio.handle("ring/z");
    if (!stands) drag_and_return(studio, ring, around_ring(studio.gizmo(), ring, 25));
  }
}

TEST_CASE("a second drag back to where the first began gives the mesh as opened again") {
  Rig rig;
  rig.open(ring_mesh());
  const Coordinates before = rig.mesh().coordinates;
  for (const double by : {37.0, -37.0}) {
    const ScreenPoint at = rig.pixel(Vec2(0, 0)) + ScreenVector(by > 0 ? 0 : 37, 0);
    rig.drag(at, at + ScreenVector(by, 0));
    rig.release();
    REQUIRE(rig.settle());
  }
  REQUIRE(rig.document().history().size() == 3);
  double apart = 0;
  for (Index node = 0; node < before.size(); ++node)
    apart = std::max(apart, (rig.mesh().coordinates.xy(node) - before.xy(node)).norm());
  CHECK(apart < 1e-9);
}

namespace {

/// How far the left body came along x.
double way_of(const Rig& rig, const Mesh& before) {
  const Index node = before.topology->markers().nodes(*before.topology->markers().find("left"))[0];
  return rig.session().coordinates().xy(node).x() - before.coordinates.xy(node).x();
}

}  // namespace

TEST_CASE(
    "a fast drag into another body shows valid meshes on the way, and keeps the last on release") {
  const Mesh before = two_body_mesh(4);
  Rig rig;
  rig.open(before);
  const double asked = 4;  // to the middle of the right body: they touch after 3
  rig.drag(rig.pixel(Vec2(-2, 0)), rig.pixel(Vec2(asked - 2, 0)), 3);
  const auto reach = [&] { return rig.session().mesh().work().body_drag()->reach(); };
  // Long before it is known how far the body can go.
  REQUIRE(rig.wait([&] {
    CHECK(check_validity(*before.topology, rig.session().coordinates()).inverted == 0);
    return way_of(rig, before) > 0 && rig.bench->pane().mesh_view().shown()->shape > 0;
  }));
  CHECK(reach() == BodyDrag::Reach::catching_up);
  REQUIRE(rig.wait([&] { return reach() == BodyDrag::Reach::limit; }));
  const DragFrame& frame = rig.session().mesh().work().body_drag()->frame();
  CHECK(frame.share == doctest::Approx(way_of(rig, before) / asked).epsilon(1e-6));
  REQUIRE(frame.contact);
  CHECK(describe_touch(*frame.contact) == "left would touch right");
  const double held = way_of(rig, before);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(way_of(rig, before) > held - 1e-6);
  CHECK(check_validity(*before.topology, rig.mesh().coordinates).inverted == 0);
  const auto& banner = rig.session().messages().banner();
  REQUIRE(banner);
  CHECK(banner->text.starts_with("Blocked by \"right\" after "));
  MoveCommand command;
  command.bodies[0].markers = {"left"};
  command.bodies[0].motion.translate = {asked, 0};
  const CommandResult path = execute(command, make_state(before));
  CHECK(held > 0.9 * asked * path.smooth.fraction_reached);
}

TEST_CASE("a drag that is let go while the mesh is on its way goes as far as it can") {
  const Mesh before = two_body_mesh(4);
  Rig rig;
  rig.open(before);
  rig.drag(rig.pixel(Vec2(-2, 0)), rig.pixel(Vec2(2, 0)), 3);
  REQUIRE(rig.wait([&] { return way_of(rig, before) > 0; }, 60));
  const double shown = way_of(rig, before);
  rig.release();
  double least = shown;
  while (rig.session().in_motion()) {
    rig.frames(1);
    least = std::min(least, way_of(rig, before));
  }
  REQUIRE(rig.settle());
  CHECK(least > 0.99 * shown);
  CHECK(way_of(rig, before) > 0.99 * shown);
  REQUIRE(rig.document().history().size() == 2);
  REQUIRE(rig.session().messages().banner());
  // How far it came of what was asked, not of what was left when the mouse let go.
  const std::string& text = rig.session().messages().banner()->text;
  const std::string told = "Blocked by \"right\" after ";
  REQUIRE(text.starts_with(told));
  const double asked = (rig.pixel(Vec2(2, 0)) - rig.pixel(Vec2(-2, 0))).norm() *
                       rig.bench->view_control().camera().units_per_pixel();
  CHECK(std::stod(text.substr(told.size())) ==
        doctest::Approx(100 * way_of(rig, before) / asked).epsilon(0.01));
}

namespace {

VcvEdit long_edge(const SessionParts& parts, double length) {
  const Index node = parts.free_node();
  std::vector<double> lengths(parts.mesh.topology()->neighbours(node).size(), 1);
  lengths[0] = length;
  return {node, {}, {}, lengths};
}

}  // namespace

TEST_CASE("an edit is shown at once and stands in the history when the mesh is smoothed") {
  SessionParts parts(ring_mesh());
  const auto before = parts.mesh.vcv();
  parts.vcvs.on(action::EditVcvs{{long_edge(parts, 2)}});
  CHECK(parts.mesh.vcv() != before);
  parts.finish();
  REQUIRE(parts.done().position() == 1);
  CHECK(std::holds_alternative<EditVcvCommand>(parts.done().command(1)));
}

TEST_CASE("under the mouse the last edit counts; cancelled, none does") {
  SessionParts parts(ring_mesh());
  const auto before = parts.mesh.vcv();
  parts.vcvs.on(action::EditVcvs{{long_edge(parts, 2)}, true});
  CHECK(parts.work.held().vcv);
  CHECK(parts.work.job().held());
  SUBCASE("let go") {
    parts.vcvs.on(action::EditVcvs{{long_edge(parts, 3)}, true});
    parts.vcvs.on(action::EndVcvEdit{});
    parts.finish();
    REQUIRE(parts.done().size() == 2);
    const auto& command = std::get<EditVcvCommand>(parts.done().command(1));
    REQUIRE(command.edits.size() == 1);
    CHECK(command.edits[0].lengths[0] == 3);
  }
  SUBCASE("cancelled") {
    parts.vcvs.on(action::CancelVcvEdit{});
    CHECK_FALSE(parts.mesh.in_motion());
    CHECK(parts.done().size() == 1);
    CHECK(parts.mesh.vcv() == before);
    CHECK(parts.notice() == "Edit cancelled");
  }
  CHECK_FALSE(parts.work.held().vcv);
}

TEST_CASE("numbers that are no VCV are said, and nothing begins") {
  SessionParts parts(ring_mesh());
  parts.vcvs.on(action::EditVcvs{{long_edge(parts, -1)}});
  CHECK_FALSE(parts.mesh.in_motion());
  REQUIRE(parts.messages.prompt() != nullptr);
  CHECK(parts.messages.prompt()->title == "This is no virtual control volume");
}

}  // namespace winslow::gui::test
