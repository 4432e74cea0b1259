#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/inspect/space/surface_measures.h"
#include "gui/settings/settings.h"
#include "gui/support/rig.h"
#include "gui/support/space_rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

TEST_CASE("a direction is found again from the axes of the screen") {
  for (const double roll : {0.0, 35.0, -120.0})
    for (const double azimuth : {0.0, 77.0, -160.0})
      for (const double elevation : {-40.0, 0.0, 65.0}) {
        SpaceCamera camera;
        camera.look_from({azimuth, elevation, 2, roll});
        const ViewDirection found = direction_of(camera.right(), camera.back(), 2);
        CHECK(found.azimuth == doctest::Approx(azimuth));
        CHECK(found.elevation == doctest::Approx(elevation));
        CHECK(found.roll == doctest::Approx(roll));
        CHECK(camera.right().dot(camera.up()) == doctest::Approx(0));
        CHECK((camera.right().cross(camera.up()) - camera.back()).norm() < 1e-12);
      }
}

TEST_CASE("turned freely, the mesh ends up on its side; as on a turntable, never") {
  LookingRig rig;
  rig.key(GLFW_KEY_1);
  const ScreenPoint from = rig.middle();
  rig.key(GLFW_KEY_T);
  REQUIRE(rig.options().space.free_orbit);
  rig.drag(from, from + ScreenVector(70, 90));
  rig.release();
  rig.drag(from, from + ScreenVector(90, -40));
  rig.release();
  CHECK(std::abs(rig.space().view().right().z()) > 0.02);
  // Esc takes it back.
  const Vec3 right = rig.space().view().right();
  rig.drag(from, from + ScreenVector(-50, 60));
  rig.key(keys::escape);
  rig.release();
  CHECK((rig.space().view().right() - right).norm() < 1e-9);
  rig.key(GLFW_KEY_T);
  rig.frames();
  CHECK(std::abs(rig.space().view().right().z()) < 1e-12);
  rig.drag(from, from + ScreenVector(90, -40));
  rig.release();
  CHECK(std::abs(rig.space().view().right().z()) < 1e-12);
}

TEST_CASE("turned freely, what lies under the mouse stays there") {
  LookingRig rig;
  rig.key(GLFW_KEY_T);
  rig.move(rig.middle() + ScreenVector(30, 20));
  rig.frames();
  REQUIRE(rig.state().seen.has_value());
  const Vec3 point = rig.state().seen->point;
  const ScreenPoint from = rig.at(point);
  rig.drag(from, from + ScreenVector(60, 45));
  CHECK((rig.at(point) - from).norm() < 1e-6);
  rig.release();
}

TEST_CASE("the view of a mesh, with its cuts, is there again in the next session") {
  const TemporaryFolder profile;
  SpaceCamera camera;
  std::vector<CutPlane> cuts;
  std::filesystem::path mesh;
  TemporaryFolder kept;
  {
    LookingRig rig(profile.path());
    rig.key(GLFW_KEY_T);
    rig.drag(rig.middle(), rig.middle() + ScreenVector(50, 30));
    rig.release();
    rig.wheel(rig.middle(), 3);
    rig.key(GLFW_KEY_C);
    set_view(rig, [](ViewOptions& view) { view.space.peel.to = 7; });
    camera = rig.space().view();
    cuts = rig.options().space.cuts;
    mesh = kept.path() / "mesh.su2";
    std::filesystem::copy_file(rig.folder / "mesh.su2", mesh);
    rig.bench->apply(action::OpenMesh{mesh, true});
    REQUIRE(rig.settle());
    set_view(rig, [&](ViewOptions& view) { view.space.cuts = cuts; });
    rig.drag(rig.middle(), rig.middle() + ScreenVector(-40, 20));
    rig.release();
    rig.frames();
    camera = rig.space().view();
  }
  Rig next(1100, 700, profile.path());
  next.bench->apply(action::OpenMesh{mesh, true});
  REQUIRE(next.settle());
  const SpaceCamera& again = next.bench->view_control().space().view();
  CHECK((again.back() - camera.back()).norm() < 1e-9);
  CHECK((again.right() - camera.right()).norm() < 1e-9);
  CHECK((again.centre() - camera.centre()).norm() < 1e-9);
  CHECK(again.units_per_pixel() == doctest::Approx(camera.units_per_pixel()).epsilon(1e-3));
  CHECK(next.bench->view_control().options().space.cuts == cuts);
}

TEST_CASE("kept views survive being written and read, and nonsense is left out") {
  Settings settings;
  settings.views = {{"/a/wing.su2",
                     {1, 2, 3},
                     0.5,
                     -30,
                     20,
                     15,
                     1,
                     {{{0, 0, 1}, {0, 1, 0}, false}},
                     {true, "flap", 2, 5}}};
  CHECK(read_settings(write_settings(settings)) == settings);
  const Settings read = read_settings(
      R"({"views": [{"mesh": "a", "centre": [0, 0, 0], "height": -1, "azimuth": 0, "elevation": 0,
                     "up": 2}, {"mesh": 3}, 7,
                    {"mesh": "b", "centre": [0, 0, 0], "height": 2, "azimuth": 0, "elevation": 10,
                     "up": 2, "cuts": [{"point": [0, 0, 0], "normal": [0, 0, 0], "on": true}, {}],
                     "peel": {"on": true, "marker": "x", "from": 5, "to": 2}}]})");
  REQUIRE(read.views.size() == 1);
  CHECK(read.views[0].mesh == "b");
  CHECK(read.views[0].cuts.empty());
  CHECK_FALSE(read.views[0].peel.on);
}

TEST_CASE("layers at a marker are shown alone, and without the first ones") {
  LookingRig rig({}, 1100, 1200);
  const Topology& topology = *rig.mesh().topology;
  const std::vector<Index> layers =
      element_layers(topology, topology.markers().nodes(rig.marker("cavity")));
  rig.key(GLFW_KEY_C, {keys::shift});
  rig.click("peel/on");
  REQUIRE(rig.settle());
  CHECK(rig.options().space.peel.marker == "cavity");  // the body, to begin with
  const auto shown = [&] {
    std::set<Index> elements;
    for (const SpaceFill& fill : rig.scenes().parts.front()->fills)
      elements.insert(fill.elements.begin(), fill.elements.end());
    return elements;
  };
  rig.fill("peel/to", "1");
  REQUIRE(rig.settle());
  const auto count = [&](Index from, Index to) {
    return std::ranges::count_if(layers, [&](Index l) { return l >= from && l <= to; });
  };
  REQUIRE(rig.scenes().shown.alone.has_value());
  CHECK(rig.scenes().shown.alone->count == count(1, 1));
  for (const Index e : shown()) CHECK(layers[at(e)] == 1);
  rig.fill("peel/to", "9");
  rig.fill("peel/from", "2");
  REQUIRE(rig.settle());
  CHECK(rig.options().space.peel.from == 2);
  CHECK(rig.scenes().shown.alone->count == count(2, 9));
  CHECK_FALSE(shown().empty());
  for (const Index e : shown()) CHECK(layers[at(e)] >= 2);
  rig.click("peel/on");
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.scenes().shown.alone.has_value());
}

TEST_CASE("a cut leaves whole elements of the layers that are shown") {
  LookingRig rig;
  set_view(rig, [](ViewOptions& view) {
    view.space.peel = {true, "cavity", 1, 1};
    view.space.cuts = {{{0.5, 0.5, 0.5}, {0, -1, 0}, true}};
  });
  const Index half = rig.scenes().shown.alone->count;
  CHECK(rig.scenes().planes.empty());
  set_view(rig, [](ViewOptions& view) { view.space.cuts.clear(); });
  CHECK(half > 0);
  CHECK(half < rig.scenes().shown.alone->count);
}

TEST_CASE("the card of a marker's colour has no two entries of one name") {
  LookingRig rig;
  rig.click("marker_color/cavity");
  rig.frames();
  REQUIRE(rig.visible("marker_color/automatic"));
  REQUIRE(rig.visible("marker_color/drawing"));
  rig.click("marker_color/drawing");
  rig.frames();
  CHECK_FALSE(rig.visible("marker_color/drawing/Automatic"));
  CHECK(rig.visible("marker_color/drawing/Drawn by its role"));
}

TEST_CASE("the colours and the legend know the metrics of volumes") {
  LookingRig rig;
  for (const Metric metric :
       {Metric::normalized_jacobian, Metric::aspect_ratio, Metric::condition_number,
        Metric::smallest_solid_angle, Metric::non_orthogonality, Metric::volume_ratio}) {
    set_view(rig, [&](ViewOptions& view) { view.color = ElementField(metric, 3); });
    CAPTURE(static_cast<int>(metric));
    REQUIRE(rig.volume().legend().has_value());
    const Legend& legend = *rig.volume().legend();
    REQUIRE(legend.histogram.has_value());
    long sum = 0;
    for (const Index n : legend.histogram->counts) sum += n;
    CHECK(sum > 0);
    CHECK(legend.title == std::string(metric_info(metric, 3).field.label));
  }
}

TEST_CASE("what space has now is offered for volume meshes") {
  LookingRig rig;
  for (const char* id : {"ruler", "ghost", "split", "node_ids", "element_ids", "free_orbit"}) {
    CAPTURE(id);
    CHECK(rig.blocked(id).empty());
  }
}

namespace {

/// Labels that do not fit into their button, list or panel.
void check_space_labels(const Rig& rig) {
  for (const auto& widget : rig.bench->widgets().all()) {
    INFO("widget ", widget.first);
    CHECK_FALSE(widget.second.cut);
  }
}

/// Opens every column and every tab in turn.
void check_space_panels(Rig& rig) {
  for (const SideTab tab : {SideTab::quality, SideTab::view, SideTab::vcv, SideTab::history}) {
    INFO("tab ", static_cast<int>(tab));
    set_view(rig, [&](ViewOptions& view) {
      view.right_panel = true;
      view.side_tab = tab;
    });
    check_space_labels(rig);
  }
  set_view(rig, [](ViewOptions& view) {
    view.left_panel = true;
    view.right_panel = false;
  });
  REQUIRE(rig.visible("motion/apply"));
  check_space_labels(rig);
  set_view(rig, [](ViewOptions& view) { view.left_panel = view.right_panel = false; });
  check_space_labels(rig);
}

}  // namespace

TEST_CASE("in space no button, list or switch cuts its label, at any size and scale") {
  struct Screen {
    int width, height;
    float scale;
  };
  Rig rig(1500, 2200);
  rig.open(winslow::test::box_with_body(5, winslow::test::Volumes::tetrahedra));
  rig.bench->apply(action::InspectNode{rig.mesh().topology->interior_nodes()[20]});
  rig.bench->apply(action::SelectMarkers{{rig.marker("body")}});
  rig.click("marker_role/far");
  REQUIRE(rig.settle());
  // All that is folded at first, from below so that nothing moves before it is clicked.
  for (const char* part : {"section/mesh", "section/measures", "solver/advanced", "section/cuts",
                           "section/peel", "section/shape", "motion/limits"}) {
    if (!rig.visible(part)) continue;
    rig.click(part);
    REQUIRE(rig.settle());
  }
  rig.click("motion/keep_outside");
  rig.click("motion/keep_outside/Box");
  rig.frames(2);
  REQUIRE(rig.visible("motion/min_quality_smallest_solid_angle/on"));
  REQUIRE(rig.visible("motion/region/keep_outside_corner_z"));
  REQUIRE(rig.visible("markers/features"));
  for (const Screen& s : {Screen{760, 480, 1}, Screen{1024, 640, 1}, Screen{1440, 900, 1.5f},
                          Screen{1920, 1080, 2}}) {
    INFO(s.width, " x ", s.height, " at ", s.scale);
    rig.resize(s.width, s.height);
    rig.bench->set_scale(s.scale);
    rig.frames(4);
    REQUIRE(rig.settle());
    check_space_panels(rig);
  }
}

}  // namespace winslow::gui::test
