#include "gui/demos/demo.h"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// A studio whose demos play on the coarse meshes.
struct DemoRig : Rig {
  DemoRig() {
    WorkbenchOptions options;
    options.demo_meshes = std::string(WINSLOW_ASSETS) + "/coarse";
    bench = std::make_unique<Workbench>(options);
    frames();
  }
  void begin(const std::string& id) {
    bench->apply(action::StartDemo{id});
    REQUIRE(wait([&] { return bench->demo().ready(session()); }));
  }
  void next() {
    const std::size_t before = bench->demo().step();
    click("demo/next");
    REQUIRE(wait([&] {
      return !bench->demo().demo() ||
             (bench->demo().step() == before + 1 && bench->demo().ready(session()));
    }));
  }
};

/// Such a demo strives for regular elements, whatever targets are set.
void check_regular_targets(const Rig& rig) {
  const auto& history = rig.document().history();
  Command last = history.command(history.size() - 1);
  CHECK(smooth_options(last)->targets == TargetBlend::regular());
  CHECK(rig.session().jobs().smooth_options().targets == TargetBlend{});
}

}  // namespace

TEST_CASE("demo E smooths the rings that its mesh has, as the README's case E does") {
  DemoRig rig;
  rig.begin("E");
  const Index elements = rig.mesh().topology->element_count();
  for (std::size_t k = 1; k < find_demo("E")->steps.size(); ++k) rig.next();
  CHECK(rig.mesh().topology->element_count() == elements);  // none are inserted
  REQUIRE(rig.document().history().size() == 2);
  CHECK(std::holds_alternative<SmoothCommand>(rig.document().history().command(1)));
}

TEST_CASE("demo F looks so closely at the layers that they can be told apart") {
  DemoRig rig;
  rig.begin("F");
  rig.next();
  rig.frames();
  const auto stack = rig.document().state().layers;
  REQUIRE(stack != nullptr);
  const Camera& camera = rig.bench->view_control().camera();
  const auto card = rig.bench->widgets().find("demo/card");
  REQUIRE(card.has_value());
  int seen = 0;
  for (const LayerColumn& column : stack->columns) {
    const ScreenPoint foot = camera.to_screen(rig.mesh().coordinates.xy(column.nodes.front()));
    const ScreenPoint top = camera.to_screen(rig.mesh().coordinates.xy(column.nodes.back()));
    const auto in_sight = [&](const ScreenPoint& p) {
      const ScreenVector q = p - camera.viewport_origin();
      const bool on_card = p.x() < card->max.x() && p.y() > card->min.y();
      return q.x() > 0 && q.y() > 0 && q.x() < camera.viewport_width() &&
             q.y() < camera.viewport_height() && !on_card;
    };
    if (!in_sight(foot) || !in_sight(top)) continue;
    ++seen;
    CHECK((top - foot).norm() > 15 * 5);  // pixels: five for each layer
  }
  CHECK(seen > 0);
}

TEST_CASE("a demo that nobody has touched is left without a question") {
  DemoRig rig;
  rig.begin("A");
  rig.next();
  rig.next();
  REQUIRE(rig.document().history().size() == 2);
  CHECK_FALSE(rig.document().modified());
  rig.bench->apply(action::StartDemo{"D"});
  rig.frames();
  CHECK(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.wait([&] { return rig.document().name() == "three_element.su2"; }));
  REQUIRE(rig.wait([&] { return rig.bench->demo().ready(rig.session()); }));
  // What the user does to the demo's mesh is the user's.
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{2, Vec2(0, 0), Vec2(0, 0)}});
  REQUIRE(rig.wait([&] { return rig.bench->demo().ready(rig.session()); }));
  CHECK(rig.document().modified());
  rig.bench->apply(action::StartDemo{"A"});
  rig.frames();
  CHECK(rig.session().messages().prompt() != nullptr);
}

TEST_CASE("each demo of the welcome page has a picture") {
  Rig rig(1100, 760);
  REQUIRE(rig.wait([&] { return rig.bench->settled(); }));
  rig.frames();
  for (const Demo& demo : demos()) {
    INFO("demo ", demo.id);
    CHECK(rig.visible("welcome/demo_picture/" + demo.id));
  }
}

TEST_CASE("each demo plays through to a valid mesh") {
  for (const Demo& demo : demos()) {
    INFO("case ", demo.id);
    DemoRig rig;
    rig.begin(demo.id);
    CHECK(rig.document().name() == demo.mesh);
    std::size_t commands = 0;
    for (std::size_t k = 1; k < demo.steps.size(); ++k) {
      rig.next();
      REQUIRE(rig.bench->demo().step() == k);
      const DemoStep& step = demo.steps[k];
      if (step.command) commands = step.afresh ? 1 : commands + 1;
      CHECK(rig.document().history().size() == commands + 1);
      for (const std::string& name : step.select)
        CHECK(rig.session().selection().contains(rig.marker(name)));
    }
    CHECK(commands > 0);
    const SmoothResult& result = rig.document().history().result(commands);
    CHECK(result.inverted == 0);
    CHECK(result.converged);
    CHECK(check_validity(*rig.mesh().topology, rig.mesh().coordinates).inverted == 0);
    if (demo.id == "C" || demo.id == "E") check_regular_targets(rig);
    rig.click("demo/next");  // "Finish"
    CHECK(rig.bench->demo().demo() == nullptr);
    CHECK(rig.session().document() != nullptr);
  }
}

TEST_CASE("a demo goes back to where the step before had ended") {
  DemoRig rig;
  rig.begin("F");
  const Coordinates opened = rig.mesh().coordinates;
  rig.next();
  CHECK_FALSE(rig.mesh().coordinates == opened);
  rig.key(GLFW_KEY_PAGE_UP);
  CHECK(rig.bench->demo().step() == 0);
  CHECK(rig.mesh().coordinates == opened);
  rig.key(GLFW_KEY_PAGE_DOWN);
  REQUIRE(rig.wait([&] { return rig.bench->demo().ready(rig.session()); }));
  CHECK_FALSE(rig.mesh().coordinates == opened);
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("the card of a demo covers neither the body nor where it goes") {
  DemoRig rig;
  rig.begin("A");
  for (int step = 0; step < 3; ++step) {
    INFO("step ", step);
    if (step > 0) rig.next();
    rig.frames(2);
    const auto card = rig.bench->widgets().find("demo/card");
    REQUIRE(card.has_value());
    for (const Index node : rig.mesh().topology->markers().nodes(rig.marker("airfoil")))
      CHECK(rig.pixel(rig.session().coordinates().xy(node)).y() < card->min.y());
  }
}

TEST_CASE("a demo that plays by itself takes its steps without a hand") {
  DemoRig rig;
  rig.begin("E");
  rig.click("demo/play");
  REQUIRE(rig.wait([&] { return rig.bench->demo().step() == 1; }));
  REQUIRE(rig.wait([&] { return !rig.bench->demo().automatic(); }));
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("Esc and opening another mesh end a demo; what is unsaved is asked for first") {
  DemoRig rig;
  rig.begin("E");
  rig.key(keys::escape);
  CHECK(rig.bench->demo().demo() == nullptr);
  CHECK_FALSE(rig.visible("demo/next"));
  rig.begin("E");
  rig.next();
  rig.bench->apply(action::RunSmooth{});  // by the user, not by the demo
  REQUIRE(rig.wait([&] { return rig.bench->demo().ready(rig.session()); }));
  rig.bench->apply(action::StartDemo{"B"});
  rig.frames();
  REQUIRE(rig.visible("prompt/Cancel"));
  rig.click("prompt/Cancel");
  CHECK(rig.document().name() == "quads.su2");
  rig.bench->apply(action::OpenMesh{write(rig.folder, ring_mesh()), true});
  REQUIRE(rig.wait([&] { return rig.document().name() == "mesh.su2"; }));
  rig.frames();
  CHECK(rig.bench->demo().demo() == nullptr);
  CHECK(find_demo("Z") == nullptr);
}

namespace {

/// A studio with the bundled meshes, whose frames are painted.
struct PaintedRig : Rig {
  PaintedRig() : Rig(900, 640) {
    WorkbenchOptions options;
    options.demo_meshes = WINSLOW_ASSETS;
    bench = std::make_unique<Workbench>(options);
    frames();
  }
  const ShownMesh* shown() const { return bench->pane().mesh_view().shown(); }
  bool ready() const { return bench->demo().ready(session()); }
  /// One frame; what stands beside the picture is of the mesh in it.
  void painted_frame() {
    checked_frame();
    bench->pictures().picture();
    ++painted;
  }
  /// Painted if there is another mesh in the picture: software would take the solver's time.
  void frame_as_needed() {
    const std::uint64_t before = shown() ? shown()->shape : 0;
    checked_frame();
    if (!shown() || shown()->shape == before) return;
    bench->pictures().picture();
    ++painted;
  }
  bool painted_until(const std::function<bool()>& wanted) {
    for (int k = 0; k < 1000; ++k) {
      painted_frame();
      if (shown() && wanted()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  int painted = 0;

 private:
  void checked_frame() {
    const std::uint64_t before = session().shape();
    frames(1);
    // What was done in this very frame is seen in the next.
    const bool follows = session().shape() != before || (shown() && shown()->shape == before);
    CHECK((follows || !visible("banner")));
    CHECK((follows || !visible("demo/inverted")));
  }
};

}  // namespace

TEST_CASE("case C: a scrambled mesh is seen at once, and the window lives on while it untangles") {
  PaintedRig rig;
  rig.bench->apply(action::StartDemo{"C"});
  REQUIRE(rig.wait([&] { return rig.ready(); }));
  rig.bench->apply(action::StepDemo{1});
  REQUIRE(rig.wait([&] { return rig.document().history().position() == 1; }));
  // Of each frame on the way the rig checks that nothing else is said.
  REQUIRE(rig.painted_until([&] { return rig.shown()->shape == rig.session().shape(); }));
  CHECK(rig.shown()->validity.inverted > 10000);
  REQUIRE(rig.wait([&] { return rig.ready(); }));
  rig.bench->apply(action::StepDemo{1});
  const int painted = rig.painted;
  do {
    rig.frame_as_needed();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (!rig.ready() || rig.shown()->validity.inverted > 0);
  CHECK(rig.painted >= painted + 2);  // while it untangles, and when it is done
  CHECK(rig.document().history().position() == 2);
}

TEST_CASE("keys typed ahead act one by one, each on a mesh that has been seen") {
  Rig rig;
  rig.open(ring_mesh(240, 60));  // so large that its picture is made in the background
  turn_flap(rig, 10);
  turn_flap(rig, 10);
  turn_flap(rig, 10);
  for (int k = 0; k < 3; ++k) {
    rig.input.key(keys::control, true);
    rig.input.key(keys::z, true);
    rig.input.key(keys::z, false);
    rig.input.key(keys::control, false);
  }
  std::size_t position = rig.document().history().position();
  REQUIRE(position == 3);
  std::uint64_t shape = rig.session().shape();
  while (!rig.input.empty()) {
    rig.bench->update(rig.input, 1100, 720, 1.0 / 30);
    if (rig.document().history().position() == position) continue;
    // The mesh before this step had been in the picture.
    CHECK(rig.document().history().position() == position - 1);
    position = rig.document().history().position();
    CHECK(rig.bench->pane().mesh_view().shown()->shape >= shape);
    shape = rig.session().shape();
  }
  CHECK(position == 0);
}

}  // namespace winslow::gui::test
