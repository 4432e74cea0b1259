#include <doctest/doctest.h>

#include <ctime>

#include "gui/demos/demo.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

/// A studio with the bundled meshes, every frame of which is painted.
struct PaintedRig : Rig {
  PaintedRig() : Rig(1440, 900) {
    WorkbenchOptions options;
    options.demo_meshes = WINSLOW_ASSETS;
    bench = std::make_unique<Workbench>(options);
    frames();
  }
  const ShownMesh* shown() const { return bench->pane().mesh_view().shown(); }
  bool ready() const { return bench->demo().ready(session()); }
  /// One frame; what stands beside the picture is of the mesh in it.
  void painted_frame() {
    const std::uint64_t before = session().shape();
    frames(1);
    bench->pictures().picture();
    // What was done in this very frame is seen in the next.
    const bool follows = session().shape() != before || (shown() && shown()->shape == before);
    CHECK((follows || !visible("banner")));
    CHECK((follows || !visible("demo/inverted")));
    ++painted;
  }
  int painted = 0;
};

/// Of all threads, so that it does not matter what else the machine does.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Of frames that each show another part of the plane, so that each is drawn.
double seconds_of_frames(PaintedRig& rig, int count) {
  const double begin = processor_seconds();
  for (int k = 0; k < count; ++k) {
    rig.bench->apply(action::LookAt{Vec2(0.5 + 0.001 * k, 0), 1.0});
    rig.painted_frame();
  }
  return processor_seconds() - begin;
}

}  // namespace

TEST_CASE("case C: a scrambled mesh is seen at once, and the window lives on while it untangles") {
  PaintedRig rig;
  rig.bench->apply(action::StartDemo{"C"});
  REQUIRE(rig.wait([&] { return rig.ready(); }));
  const double good = seconds_of_frames(rig, 30);
  rig.bench->apply(action::StepDemo{1});
  REQUIRE(rig.wait([&] { return rig.document().history().position() == 1; }));
  const double scrambled = processor_seconds();
  do rig.painted_frame();
  while (!rig.shown() || rig.shown()->shape != rig.session().shape());
  rig.painted_frame();
  const double first = processor_seconds() - scrambled;
  MESSAGE("processor seconds until the scramble is seen: ", first);
  CHECK(first < good);
  CHECK(rig.shown()->validity.inverted > 10000);
  REQUIRE(rig.wait([&] { return rig.ready(); }));
  const double tangled = seconds_of_frames(rig, 30);
  MESSAGE("processor seconds of 30 frames: ", good, ", of the scramble: ", tangled);
  CHECK(tangled < 3 * good);
  rig.bench->apply(action::StepDemo{1});
  do rig.painted_frame();
  while (!rig.ready() || rig.shown()->validity.inverted > 0);
  CHECK(rig.painted >= 64);
  CHECK(rig.document().history().position() == 2);
}

TEST_CASE("a scrambled mesh with elements isolated is drawn as fast as one that is in order") {
  PaintedRig rig;
  rig.bench->apply(action::StartDemo{"C"});
  REQUIRE(rig.wait([&] { return rig.ready(); }));
  set_view(rig, [](ViewOptions& view) {
    view.mark_inverted = false;
    view.isolation.on = true;
  });
  const double good = seconds_of_frames(rig, 30);
  rig.bench->apply(action::StepDemo{1});
  REQUIRE(rig.wait([&] { return rig.document().history().position() == 1 && rig.ready(); }));
  REQUIRE(rig.settle());
  rig.painted_frame();
  const double tangled = seconds_of_frames(rig, 30);
  MESSAGE("processor seconds of 30 frames: ", good, ", of the scramble: ", tangled);
  CHECK(tangled < 3 * good);
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
