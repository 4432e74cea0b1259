#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

TEST_CASE("a motion in space that ends on the way stands in the history as far as it came") {
  Rig rig;
  rig.open(make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::tetrahedra)));
  const Index cavity = rig.marker("cavity");
  rig.bench->apply(action::SelectMarkers{{cavity}});
  // Through the outer wall: it cannot come there.
  rig.bench->apply(action::ApplyMotion{SpaceMotion{0, {0, 0, 1}, {0.5, 0.5, 0.5}, {0.9, 0, 0}}});
  REQUIRE(rig.wait([&] { return !rig.session().job().active() && rig.bench->settled(); }));
  REQUIRE(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.document().history().position() == 1);
  const auto& move = std::get<MoveCommand>(rig.document().history().command(1));
  CHECK(move.motion.rotate == 0);
  CHECK(move.motion.translate.y() == 0);
  CHECK(move.motion.translate_z == 0);
  CHECK(move.motion.translate.x() < 0.9);
  CHECK(move.motion.translate.x() > 0);
  const Index node = rig.mesh().topology->markers().nodes(cavity).front();
  const Coordinates& rest = rig.document().history().state(0).mesh.coordinates;
  CHECK((rig.mesh().coordinates.xyz(node) - rest.xyz(node)).x() ==
        doctest::Approx(move.motion.translate.x()));
}

namespace {

double distance(const Coordinates& a, const Coordinates& b) {
  double largest = 0;
  for (Index i = 0; i < a.size(); ++i) largest = std::max(largest, (a.xy(i) - b.xy(i)).norm());
  return largest;
}

}  // namespace

TEST_CASE("the Smooth button runs to convergence and adds to the history") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.click("tool/run");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(rig.document().history().result(1).converged);
  CHECK(distance(rig.mesh().coordinates, before.coordinates) > 1e-3);
  CHECK(rig.session().mesh().convergence().size() > 3);
}

TEST_CASE("each step is one outer iteration, then the solver waits") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::n);
  REQUIRE(rig.wait([&] { return solver_paused(rig) && iterations(rig) == 1; }));
  CHECK(rig.session().job().paused());
  const Coordinates first = rig.session().coordinates();
  rig.frames(20);
  CHECK(iterations(rig) == 1);
  rig.click("tool/step");
  REQUIRE(rig.wait([&] { return iterations(rig) == 2; }));
  CHECK(distance(first, rig.session().coordinates()) > 0);
  CHECK(rig.document().history().size() == 1);
  rig.key(keys::space);
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("pause stops the solver, resume ends at the mesh of an uninterrupted run") {
  Rig straight;
  straight.open(ring_mesh());
  straight.click("tool/run");
  REQUIRE(straight.settle());

  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::n);
  REQUIRE(rig.wait([&] { return solver_paused(rig); }));
  REQUIRE(rig.visible("tool/run"));
  rig.click("tool/run");
  rig.bench->apply(action::PauseSolver{});
  REQUIRE(rig.wait([&] { return solver_paused(rig) || !rig.session().job().active(); }));
  rig.bench->apply(action::ResumeSolver{});
  REQUIRE(rig.settle());
  CHECK(rig.mesh().coordinates == straight.mesh().coordinates);
}

TEST_CASE("cancel puts the mesh back as it was") {
  Rig rig;
  rig.open(ring_mesh());
  SmoothOptions slow;
  slow.formulation = "pointwise";
  slow.outer = OuterMethod::picard;
  slow.damping = 0.01;
  rig.bench->apply(action::EditSmoothOptions{whole(slow)});
  const Mesh before = rig.mesh();
  rig.key(keys::n, {keys::shift});
  REQUIRE(rig.wait([&] { return iterations(rig) >= 1; }));
  CHECK(distance(rig.session().coordinates(), before.coordinates) > 0);
  rig.click("tool/cancel");
  CHECK_FALSE(rig.session().job().active());
  CHECK(rig.session().coordinates() == before.coordinates);
  CHECK(rig.document().history().size() == 1);
}

TEST_CASE("reset goes back to the mesh as opened and redo returns") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh before = rig.mesh();
  rig.click("tool/run");
  REQUIRE(rig.settle());
  const Mesh smoothed = rig.mesh();
  rig.key(keys::r, {keys::control});
  CHECK(rig.session().coordinates() == before.coordinates);
  rig.key(keys::z, {keys::control, keys::shift});
  CHECK(rig.session().coordinates() == smoothed.coordinates);
}

TEST_CASE("undo and redo walk the history, by keys and by the list") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  std::vector<Coordinates> meshes{rig.mesh().coordinates};
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  for (double dx : {0.2, 0.1}) {
    rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(dx, 0)}});
    REQUIRE(rig.settle());
    meshes.push_back(rig.mesh().coordinates);
  }
  REQUIRE(rig.document().history().size() == 3);
  CHECK((rig.session().selection().pivot() - Vec2(0.3, 0)).norm() < 1e-9);
  rig.key(keys::z, {keys::control});
  CHECK(rig.session().coordinates() == meshes[1]);
  CHECK((rig.session().selection().pivot() - Vec2(0.2, 0)).norm() < 1e-9);
  rig.click("tool/undo");
  CHECK(rig.session().coordinates() == meshes[0]);
  rig.click("tool/redo");
  CHECK(rig.session().coordinates() == meshes[1]);
  rig.click("tab/history");
  REQUIRE(rig.visible("history/2"));
  rig.click("history/2");
  CHECK(rig.session().coordinates() == meshes[2]);
}

TEST_CASE("scrambling tangles the mesh and smoothing recovers it") {
  Rig rig;
  rig.open(ring_mesh());
  SmoothOptions regular;  // targets that a scrambled mesh still has
  regular.targets = TargetBlend::regular();
  rig.bench->apply(action::EditSmoothOptions{whole(regular)});
  rig.click("tool/run");
  REQUIRE(rig.settle());
  const Mesh smoothed = rig.mesh();
  rig.click("menu/Edit");
  rig.click("menu/scramble");
  REQUIRE(rig.settle());
  CHECK(rig.session().quality().latest()->report.inverted > 0);
  rig.click("tool/run");
  REQUIRE(rig.settle());
  CHECK(rig.session().quality().latest()->report.inverted == 0);
  CHECK(distance(rig.mesh().coordinates, smoothed.coordinates) < 1e-6);
}

TEST_CASE("the convergence plot shows the run and reads out an iteration under the mouse") {
  Rig rig;
  rig.open(ring_mesh());
  const Image empty = rig.bench->pictures().picture();
  rig.click("tool/run");
  REQUIRE(rig.settle());
  const auto plot = rig.bench->widgets().find("convergence/plot");
  REQUIRE(plot.has_value());
  rig.move(rig.pixel(Vec2(1, 1)));
  rig.frames();
  const Image drawn = rig.bench->pictures().picture();
  int blue = 0;
  int blue_before = 0;
  const auto is_blue = [](const std::uint8_t* c) { return c[2] > 180 && c[0] < 110 && c[1] < 150; };
  for (int y = static_cast<int>(plot->min.y()) + 30; y < static_cast<int>(plot->max.y()) - 40; ++y)
    for (int x = static_cast<int>(plot->min.x()) + 60; x < static_cast<int>(plot->max.x()) - 60;
         ++x) {
      blue += is_blue(drawn.pixel(x, y));
      blue_before += is_blue(empty.pixel(x, y));
    }
  CHECK(blue_before == 0);
  CHECK(blue > 60);
  rig.move(plot->centre());
  rig.frames(3);
  CHECK(rig.bench->pictures().picture().rgba != drawn.rgba);
}

TEST_CASE("no frame waits for the solver") {
  // An iteration takes several times as long as a frame. If frames waited for iterations there
  // would be another one published after every frame.
  Rig rig;
  rig.open(ring_mesh(220, 90));
  rig.key(keys::space);
  int frames = 0;
  int within_an_iteration = 0;
  while (rig.session().job().active() && iterations(rig) < 4) {
    const int before = iterations(rig);
    rig.frames(1);
    ++frames;
    if (iterations(rig) == before && rig.session().job().active()) ++within_an_iteration;
  }
  rig.bench->apply(action::CancelSolver{});
  MESSAGE(within_an_iteration, " of ", frames, " frames within an iteration");
  CHECK(within_an_iteration > 0);
}

TEST_CASE("settings of the solver that make no sense are refused with a reason") {
  Rig rig;
  rig.open(ring_mesh());
  SmoothOptions bad;
  bad.tolerance = -1;
  rig.bench->apply(action::EditSmoothOptions{whole(bad)});
  rig.bench->apply(action::RunSmooth{});
  rig.frames();
  CHECK_FALSE(rig.session().job().active());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
  REQUIRE(rig.visible("prompt/OK"));
  rig.click("prompt/OK");
  CHECK(rig.session().messages().prompt() == nullptr);
}

TEST_CASE("an iteration limit that is too small is said, and going on converges") {
  Rig rig;
  rig.open(ring_mesh());
  SmoothOptions few;
  few.max_iterations = 2;
  rig.bench->apply(action::EditSmoothOptions{whole(few)});
  rig.click("tool/run");
  REQUIRE(rig.settle());
  rig.frames();
  REQUIRE(rig.session().messages().banner().has_value());
  CHECK(rig.session().messages().banner()->kind == Banner::Kind::not_converged);
  // A drag that is taken back, or moves nothing, leaves it said.
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  for (const bool moved : {true, false}) {
    rig.bench->apply(action::BeginDrag{});
    if (moved) rig.bench->apply(action::DragTo{{0, Vec2(0, 0), Vec2(0.1, 0)}});
    rig.frames();
    CHECK(rig.session().in_motion());
    rig.bench->apply(moved ? Action(action::CancelDrag{}) : Action(action::EndDrag{}));
    REQUIRE(rig.settle());
    REQUIRE(rig.session().messages().banner().has_value());
    CHECK(rig.session().messages().banner()->kind == Banner::Kind::not_converged);
  }
  rig.bench->apply(action::EditSmoothOptions{whole(SmoothOptions{})});
  rig.frames();
  rig.click("banner/smooth");
  REQUIRE(rig.settle());
  const auto& banner = rig.session().messages().banner();
  CHECK((!banner || banner->kind == Banner::Kind::damaged));
  CHECK(rig.document().history().result(2).converged);
}

}  // namespace winslow::gui::test
