#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "gui/files/file_kinds.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/support/space_rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

using winslow::test::Volumes;

Mesh cavity(Volumes volumes = Volumes::tetrahedra) {
  return make_mesh(winslow::test::cube_with_cavity(6, volumes));
}

/// A studio with a volume mesh.
struct SpaceStudio : SpaceRig {
  explicit SpaceStudio(const Mesh& mesh = cavity()) { open(mesh); }

  ScreenPoint middle() const { return space().view().viewport().centre(); }
};

}  // namespace

TEST_CASE("A volume mesh opens: panels count its elements, and its quality is that of volumes") {
  for (const Volumes volumes : winslow::test::all_volumes) {
    CAPTURE(winslow::test::name_of(volumes));
    SpaceStudio studio(cavity(volumes));
    CHECK(studio.session().in_space());
    CHECK(studio.session().messages().prompt() == nullptr);
    CHECK(studio.document().loaded_quality().cell_dimension == 3);
    CHECK(studio.options().color == ElementField(Metric::normalized_jacobian, 3));
    CHECK(studio.bench->pane().mesh_view().legend().has_value());
    studio.resize(1400, 1500);  // all panels have room
    studio.frames();
    studio.click("section/mesh");
    studio.frames();
    for (const char* widget : {"mesh/counts", "quality/table", "worst/list", "marker/cavity",
                               "cuts/0/hold", "solver/state"})
      CHECK_MESSAGE(studio.visible(widget), widget);
  }
}

TEST_CASE("What has no counterpart in space says so, and does nothing by its key") {
  SpaceStudio studio;
  for (const char* id : {"magnifier", "insert_layers"})
    CHECK(studio.blocked(id) == "Not for volume meshes yet.");
  CHECK(studio.blocked("fit").empty());
  CHECK(studio.blocked("look_from/iso").empty());
  for (const int key : {GLFW_KEY_M, GLFW_KEY_I, GLFW_KEY_B}) studio.key(key);
  CHECK(studio.settle());
  CHECK_FALSE(studio.options().magnifier.on);
  CHECK(studio.options().isolation.on);  // that one has
}

TEST_CASE("Keys of space are blocked on a plane mesh") {
  Rig rig;
  rig.open(two_body_mesh());
  const Camera before = rig.bench->view_control().camera();
  for (const int key : {GLFW_KEY_1, GLFW_KEY_7, GLFW_KEY_P, GLFW_KEY_C, GLFW_KEY_K}) rig.key(key);
  CHECK(rig.bench->view_control().camera() == before);
  CHECK(rig.bench->view_control().options().space.cuts.empty());
  CHECK_FALSE(rig.bench->view_control().options().space.perspective);
}

TEST_CASE("Going from a volume mesh to a plane one and back keeps the look at each") {
  SpaceStudio studio;
  studio.key(GLFW_KEY_5);
  studio.key(GLFW_KEY_C);
  const SpaceCamera camera = studio.space().view();
  const auto cuts = studio.options().space.cuts;
  REQUIRE(cuts.size() == 2);
  studio.open(two_body_mesh(), "plane.su2");
  CHECK_FALSE(studio.session().in_space());
  CHECK(studio.options().color == ElementField(Metric::normalized_jacobian));
  CHECK_FALSE(studio.visible("cuts/0/hold"));
  studio.bench->apply(action::OpenMesh{studio.folder / "mesh.su2"});
  REQUIRE(studio.settle());
  CHECK(studio.session().in_space());
  CHECK(studio.space().view().direction() == camera.direction());
  CHECK((studio.space().view().centre() - camera.centre()).norm() < 1e-12);
  CHECK(studio.options().space.cuts == cuts);
}

TEST_CASE("A drag turns the view about what lies under the mouse, which stays where it is") {
  SpaceStudio studio;
  studio.move(studio.middle() + ScreenVector(30, 20));
  studio.frames();
  REQUIRE(studio.state().seen.has_value());
  const Vec3 point = studio.state().seen->point;
  const ScreenPoint from = studio.at(point);
  const ViewDirection before = studio.space().view().direction();
  studio.drag(from, from + ScreenVector(60, 25));
  CHECK((studio.at(point) - from).norm() < 1e-6);
  CHECK(studio.space().view().direction().azimuth < before.azimuth);
  CHECK(studio.space().view().direction().elevation > before.elevation);
  studio.release();
  // Esc takes a turn back.
  const ViewDirection turned = studio.space().view().direction();
  studio.drag(from, from + ScreenVector(-80, 0));
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.space().view().direction() == turned);
}

TEST_CASE("The middle button and Shift pan, the wheel zooms at what is under the mouse") {
  SpaceStudio studio;
  const ScreenPoint from = studio.middle() + ScreenVector(40, -30);
  studio.move(from);
  studio.frames();
  REQUIRE(studio.state().seen.has_value());
  const Vec3 point = studio.state().seen->point;
  studio.drag(from, from + ScreenVector(50, 10), 6, MouseButton::middle);
  studio.release(MouseButton::middle);
  CHECK((studio.at(point) - (from + ScreenVector(50, 10))).norm() < 1e-6);
  const ScreenPoint there = studio.at(point);
  const double unit = studio.space().view().units_per_pixel();
  for (const bool perspective : {false, true}) {
    set_view(studio, [&](ViewOptions& view) { view.space.perspective = perspective; });
    const ScreenPoint now = studio.at(point);
    studio.wheel(now, 3);
    CHECK((studio.at(point) - now).norm() < 0.5);
  }
  CHECK(studio.space().view().units_per_pixel() < 0.5 * unit);
  CHECK((studio.at(point) - there).norm() < 60);
}

TEST_CASE("Keys look along the axes and from aslant, and back") {
  SpaceStudio studio;
  const ViewDirection first = studio.space().view().direction();
  const std::array<std::pair<int, Vec3>, 6> axes{{{GLFW_KEY_1, Vec3(1, 0, 0)},
                                                  {GLFW_KEY_2, Vec3(-1, 0, 0)},
                                                  {GLFW_KEY_3, Vec3(0, 1, 0)},
                                                  {GLFW_KEY_4, Vec3(0, -1, 0)},
                                                  {GLFW_KEY_5, Vec3(0, 0, 1)},
                                                  {GLFW_KEY_6, Vec3(0, 0, -1)}}};
  for (const auto& [key, viewer] : axes) {
    studio.key(key);
    CHECK((studio.space().view().back() - viewer).norm() < 1e-12);
  }
  studio.key(GLFW_KEY_7);
  CHECK(studio.space().view().back().minCoeff() < -0.5);
  for (int k = 0; k < 7; ++k) studio.key(GLFW_KEY_LEFT, {keys::alt});
  CHECK(studio.space().view().direction() == first);
}

TEST_CASE("A box that is drawn fills the view") {
  SpaceStudio studio;
  studio.key(keys::z);
  const ScreenPoint from = studio.middle() + ScreenVector(-50, -40);
  const double unit = studio.space().view().units_per_pixel();
  studio.drag(from, from + ScreenVector(100, 80));
  studio.release();
  const ScreenVector size = studio.space().view().viewport().size();
  const double factor = std::min(size.x() / 100, size.y() / 80);
  CHECK(studio.space().view().units_per_pixel() == doctest::Approx(unit / factor));
  CHECK_FALSE(studio.state().box_zoom_armed);
}

TEST_CASE("What is picked is what is seen: the body before the cut behind it, no hidden marker") {
  SpaceStudio studio;
  studio.key(GLFW_KEY_4);  // onto the cut at y = 0.5, which faces the viewer
  studio.key(keys::f);
  // The cavity's walls are seen through the cut; beside them there are elements.
  studio.move(studio.at({0.5, 0.5, 0.5}));
  studio.frames();
  REQUIRE(studio.state().seen.has_value());
  CHECK(studio.state().seen->marker == studio.marker("cavity"));
  CHECK(studio.visible("status/cursor"));
  studio.click(studio.at({0.5, 0.5, 0.5}));
  CHECK(studio.session().selection().markers() == std::vector<Index>{studio.marker("cavity")});
  const Vec3 inside(0.21, 0.5, 0.48);
  studio.click(studio.at(inside));
  REQUIRE(studio.state().focus.has_value());
  CHECK(studio.state().focus->kind == MeshItem::Kind::element);
  const Box<3> element = space_bounds(studio.mesh().coordinates,
                                      studio.mesh().topology->element(studio.state().focus->id));
  CHECK(element.distance(inside) < 1e-6);
  set_view(studio, [](ViewOptions& view) {
    MarkerLook look;
    look.hidden = true;
    view.markers.set("cavity", look);
  });
  studio.move(studio.at({0.5, 0.5, 0.5}) + ScreenVector(1, 1));
  studio.frames();
  CHECK((!studio.state().seen || studio.state().seen->marker != studio.marker("cavity")));
}

TEST_CASE("Alt and a click pick the node of what is under the mouse") {
  SpaceStudio studio;
  studio.key(GLFW_KEY_4);
  Index best = -1;  // a node on the cut's plane that is seen: at (1/6, 1/2, 1/3)
  const Coordinates& x = studio.mesh().coordinates;
  for (Index i = 0; i < x.size(); ++i)
    if ((x.xyz(i) - Vec3(1.0 / 6, 0.5, 1.0 / 3)).norm() < 1e-9) best = i;
  REQUIRE(best >= 0);
  studio.input.key(keys::alt, true);
  studio.click(studio.at(x.xyz(best)) + ScreenVector(2, 2));
  studio.input.key(keys::alt, false);
  studio.frames();
  REQUIRE(studio.state().focus.has_value());
  CHECK(*studio.state().focus == MeshItem{MeshItem::Kind::node, best});
}

TEST_CASE("A cut's handle moves it along its normal and turns it; Esc puts it back") {
  SpaceStudio studio;
  studio.click("cuts/0/hold");
  studio.key(GLFW_KEY_7);
  studio.frames();
  REQUIRE(studio.visible("cut/foot"));
  const CutPlane before = studio.options().space.cuts.front();
  const ScreenPoint foot = studio.bench->widgets().find("cut/foot")->centre();
  const ScreenPoint tip = studio.bench->widgets().find("cut/tip")->centre();
  studio.drag(foot, foot + (tip - foot) * 0.5);
  studio.release();
  REQUIRE(studio.settle());
  const CutPlane moved = studio.options().space.cuts.front();
  CHECK(moved.normal == before.normal);
  CHECK(moved.point[1] < before.point[1] - 0.01);  // the normal points to -y
  CHECK(moved.point[0] == before.point[0]);
  REQUIRE(studio.scenes().planes.size() == 1);
  CHECK(studio.scenes().planes.front().point().y() == doctest::Approx(moved.point[1]));
  const ScreenPoint ball = studio.bench->widgets().find("cut/tip")->centre();
  studio.drag(ball, ball + ScreenVector(25, 15));
  CHECK(studio.options().space.cuts.front().normal != moved.normal);
  studio.key(keys::escape);
  studio.release();
  CHECK(studio.options().space.cuts.front() == moved);
}

TEST_CASE("Cuts are typed, added, flipped and taken away") {
  SpaceStudio studio;
  studio.click("cuts/0/hold");
  studio.fill("cuts/point_y", "0.25");
  CHECK(studio.options().space.cuts[0].point[1] == 0.25);
  studio.fill("cuts/normal_x", "1");
  CHECK(studio.options().space.cuts[0].normal[0] == 1);
  const auto tilted = studio.options().space.cuts[0].normal;
  studio.click("cuts/flip");
  CHECK(studio.options().space.cuts[0].normal[0] == -tilted[0]);
  studio.click("cuts/add");
  REQUIRE(studio.settle());
  CHECK(studio.options().space.cuts.size() == 2);
  CHECK(studio.scenes().planes.size() == 2);
  studio.click("cuts/0/on");
  REQUIRE(studio.settle());
  CHECK(studio.scenes().planes.size() == 1);
  studio.click("cuts/crinkle");
  REQUIRE(studio.settle());
  CHECK(studio.scenes().planes.empty());  // whole elements are clipped by none
  studio.click("cuts/1/remove");
  CHECK(studio.options().space.cuts.size() == 1);
  studio.key(GLFW_KEY_C, {keys::shift});
  CHECK(studio.options().space.cuts.empty());
}

TEST_CASE("A dragged cut makes its section anew, and nothing else") {
  SpaceStudio studio;
  const auto before = studio.scenes().parts;
  REQUIRE(before.size() == 2);
  set_view(studio, [](ViewOptions& view) { view.space.cuts[0].point[1] = 0.4; });
  const auto after = studio.scenes().parts;
  REQUIRE(after.size() == 2);
  CHECK(after[0] != before[0]);
  CHECK(after[1] == before[1]);
  // Smoothing moves nodes within: the boundary stays, too.
  studio.key(keys::space);
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  CHECK(studio.scenes().parts[0] != after[0]);
  CHECK(studio.scenes().parts[1] == after[1]);
}

TEST_CASE("Isolated elements are those beyond the threshold, whole") {
  SpaceStudio studio;
  const std::vector<double> values = studio.session().quality().latest()->values;
  const double threshold =
      0.5 * (*std::ranges::min_element(values) + *std::ranges::max_element(values));
  set_view(studio, [&](ViewOptions& view) {
    view.isolation.on = true;
    view.isolation.threshold = threshold;
    view.isolation.above = false;
  });
  std::size_t wanted = 0;
  for (const double v : values) wanted += v < threshold ? 1 : 0;
  REQUIRE(wanted > 0);
  REQUIRE(wanted < values.size());
  std::set<Index> shown;
  for (const SpaceFill& fill : studio.scenes().parts.front()->fills)
    shown.insert(fill.elements.begin(), fill.elements.end());
  CHECK(shown.size() <= wanted);
  CHECK_FALSE(shown.empty());
  for (const Index e : shown) CHECK(values[at(e)] < threshold);
}

TEST_CASE("A scrambled volume mesh shows its inverted elements, and smoothing repairs it") {
  SpaceStudio studio;
  studio.bench->apply(action::Scramble{1});
  REQUIRE(studio.settle());
  CHECK(studio.scenes().shown.validity.inverted > 0);
  CHECK(studio.scenes().parts.size() == 3);
  CHECK(studio.scenes().legend->inverted.has_value());
  studio.key(keys::n);  // one step, then pause
  REQUIRE(studio.wait([&] {
    const auto snapshot = studio.session().job().snapshot();
    return snapshot && snapshot->state == JobState::paused && !snapshot->history.empty();
  }));
  CHECK_FALSE(studio.session().mesh().convergence().empty());
  studio.key(keys::space);
  REQUIRE(studio.settle());
  CHECK(studio.scenes().shown.validity.inverted == 0);
  CHECK(studio.scenes().parts.size() == 2);
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(studio.scenes().shown.validity.inverted > 0);
}

TEST_CASE("A body of a volume mesh moves by typed numbers, and back by undo") {
  SpaceStudio studio;
  studio.resize(1400, 1300);  // the whole of the panel has room
  studio.click("marker/cavity");
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12);
  studio.fill("motion/d_x", "0.05");
  CHECK(studio.session().selection().motion_preview().has_value());
  studio.fill("motion/rotate", "10");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  const auto nodes = studio.mesh().topology->markers().nodes(studio.marker("cavity"));
  const Coordinates& rest = studio.document().history().state(0).mesh.coordinates;
  const double angle = radians(10);
  for (const Index node : nodes) {
    const Vec3 arm = rest.xyz(node) - Vec3(0.5, 0.5, 0.5);
    const Vec3 turned(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                      std::sin(angle) * arm.x() + std::cos(angle) * arm.y(), arm.z());
    CHECK((studio.mesh().coordinates.xyz(node) - turned - Vec3(0.55, 0.5, 0.5)).norm() < 1e-9);
  }
  CHECK((studio.session().selection().space_pivot() - Vec3(0.55, 0.5, 0.5)).norm() < 1e-9);
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(studio.mesh().coordinates == rest);
}

TEST_CASE("Go to finds nodes and elements of a volume mesh, and points in space") {
  SpaceStudio studio;
  studio.resize(1400, 1500);  // the panel has room
  studio.frames();
  studio.fill("go_to/field", "0.5, 0.1, 0.2");
  studio.click("go_to/go");
  REQUIRE(studio.state().focus.has_value());
  CHECK(studio.state().focus->kind == MeshItem::Kind::node);
  const Vec3 node = studio.mesh().coordinates.xyz(studio.state().focus->id);
  CHECK((node - Vec3(0.5, 1.0 / 6, 1.0 / 6)).norm() < 1e-9);
  CHECK(studio.space().view().viewport().contains(studio.at(node)));
  studio.bench->apply(action::GoTo{MeshItem{MeshItem::Kind::element, 7}});
  studio.frames();
  CHECK(studio.visible("go_to/item"));
}

TEST_CASE("A picture of the mesh alone shows what the window shows, at another size") {
  SpaceStudio studio;
  PictureSpec spec;
  spec.panels = false;
  spec.scale = 2;
  const Image large = studio.bench->pictures().picture(spec);
  spec.scale = 1;
  const Image small = studio.bench->pictures().picture(spec);
  CHECK(large.width == 2 * small.width);
  CHECK(inked(small, 0, 0, small.width, small.height) > 10000);
  // The window is as it was.
  CHECK(studio.bench->pictures().picture().rgba == studio.bench->pictures().picture().rgba);
}

TEST_CASE("A recipe's motion for meshes of the other kind is refused, and the mesh stays open") {
  MoveCommand in_space;
  in_space.bodies[0].markers = {"left"};
  in_space.bodies[0].motion = {10, Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 0)};
  Rig plane;
  plane.open(two_body_mesh());
  plane.bench->apply(action::RunCommand{in_space});
  plane.frames(3);
  REQUIRE(plane.session().messages().prompt() != nullptr);
  CHECK(plane.session().messages().prompt()->text.find("only for a volume mesh") !=
        std::string::npos);
  CHECK(plane.document().history().position() == 0);
  SpaceStudio space;
  MoveCommand in_plane;
  in_plane.bodies[0].markers = {"cavity"};
  in_plane.bodies[0].motion = {.rotate = 10};
  space.bench->apply(action::RunCommand{in_plane});
  space.frames(3);
  REQUIRE(space.session().messages().prompt() != nullptr);
  CHECK(space.document().history().position() == 0);
}

TEST_CASE("a large volume mesh is in the picture before its quality is measured for colours") {
  Rig rig(760, 480);
  const Mesh mesh = winslow::test::shaken_box(12, 0.1, 3);  // made in the background
  rig.bench->apply(action::OpenMesh{write(rig.folder, mesh, "box.su2")});
  const MeshView& view = rig.bench->pane().mesh_view();
  while (!view.shown()) {
    CHECK_FALSE(rig.session().quality().busy());
    CHECK(rig.session().quality().latest() == nullptr);
    CHECK_FALSE(rig.bench->settled());
    rig.frames(1);
  }
  REQUIRE(rig.settle());
  REQUIRE(rig.session().quality().latest() != nullptr);
  CHECK(rig.session().quality().latest()->shape == rig.session().shape());
  CHECK(view.volume().legend().has_value());
}

}  // namespace winslow::gui::test
