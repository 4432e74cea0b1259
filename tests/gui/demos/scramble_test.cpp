#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "gui/demos/demo.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

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
