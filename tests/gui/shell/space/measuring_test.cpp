#include <doctest/doctest.h>

#include <algorithm>

#include "core/mesh/surface_faces.h"
#include "gui/support/space_rig.h"
#include "gui/view/navigation/go_to.h"
#include "gui/view/overlays/tool_overlay.h"

namespace winslow::gui::test {

namespace {

/// What is said of an item under a name.
std::string said(const LookingRig& rig, const MeshItem& item, const std::string& name) {
  for (const auto& [key, value] : describe_item(item, rig.session()))
    if (key == name) return value;
  return {};
}

/// By the key that asks where to.
void go_to(Rig& rig, const std::string& place) {
  rig.key(GLFW_KEY_G, {keys::control});
  rig.frames(2);
  rig.type(place);
  rig.key(keys::enter);
  rig.frames();
}

std::set<std::string> ids_on_screen(const LookingRig& rig, const std::string& prefix) {
  std::set<std::string> ids;
  for (const auto& [id, rect] : rig.bench->widgets().all())
    if (id.starts_with(prefix)) ids.insert(id.substr(prefix.size()));
  return ids;
}

}  // namespace

TEST_CASE("the ruler measures in space by clicks that snap to nodes") {
  LookingRig rig;
  rig.show_outside();
  rig.key(GLFW_KEY_4);  // onto the side y = 0
  rig.key(GLFW_KEY_4);
  rig.key(keys::f);
  rig.key(keys::r);
  REQUIRE(rig.state().ruler);
  CHECK(rig.visible("mode"));
  const ScreenVector beside(3, 2);
  const double y = rig.space().view().back().y() > 0 ? 1 : 0;
  rig.click(rig.at({1.0 / 6, y, 1.0 / 6}) + beside);
  rig.click(rig.at({5.0 / 6, y, 1.0 / 6}) + beside);
  const auto& points = rig.bench->pane().ruler().points();
  REQUIRE(points.size() == 2);
  CHECK(points[0].node == rig.node_at({1.0 / 6, y, 1.0 / 6}));
  const auto two = measure(points);
  CHECK(two->length == doctest::Approx(2.0 / 3));
  CHECK(std::abs(two->along.x()) == doctest::Approx(2.0 / 3));
  REQUIRE(two->faces.has_value());
  CHECK(*two->faces == doctest::Approx(0).epsilon(1e-6));
  CHECK(rig.visible("ruler"));
  rig.click(rig.at({5.0 / 6, y, 5.0 / 6}) + beside);
  REQUIRE(points.size() == 3);
  CHECK(*measure(points)->angle == doctest::Approx(90));
  CHECK(*measure(points)->second == doctest::Approx(2.0 / 3));
  CHECK(rig.session().selection().empty());
  CHECK_FALSE(rig.state().focus.has_value());
  // A drag still turns the view, and leaves the points in the mesh.
  rig.drag(rig.middle(), rig.middle() + ScreenVector(50, 20));
  rig.release();
  CHECK(points.size() == 3);
  rig.key(keys::escape);
  CHECK_FALSE(rig.state().ruler);
  CHECK(rig.bench->pane().ruler().points().empty());
}

TEST_CASE("the ruler says by how much two faces turn from one another") {
  LookingRig rig;
  rig.show_outside();
  rig.key(GLFW_KEY_7);
  rig.key(keys::f);
  rig.key(keys::r);
  const Vec3 back = rig.space().view().back();
  const auto side = [&](Index axis) { return back[axis] > 0 ? 1.0 : 0.0; };
  rig.input.key(keys::shift, true);  // the points themselves
  rig.click(rig.at({side(0), 0.45, 0.55}));
  rig.click(rig.at({0.45, 0.55, side(2)}));
  rig.input.key(keys::shift, false);
  const auto& points = rig.bench->pane().ruler().points();
  REQUIRE(points.size() == 2);
  CHECK_FALSE(points[0].node.has_value());
  CHECK((points[0].at - Vec3(side(0), 0.45, 0.55)).norm() < 0.01);
  REQUIRE(measure(points)->faces.has_value());
  CHECK(*measure(points)->faces == doctest::Approx(90));
}

TEST_CASE("points of the ruler at nodes go with the mesh, and lines say what is measured") {
  Measurement m;
  m.length = 2;
  m.along = Vec3(2, -1e-17, 0);
  m.faces = 12.345;
  const auto lines = measurement_lines(m);
  REQUIRE(lines.size() == 3);
  CHECK(lines[0] == "Length 2");
  CHECK(lines[1] == "x +2   y +0   z +0");
  CHECK(lines[2].find("12.3") != std::string::npos);
  const RulerPoint a{Vec3(0, 0, 0), {}, {}}, b{Vec3(0, 0, 0), {}, {}};
  CHECK_FALSE(measure({a, b, {Vec3(1, 0, 0), {}, {}}})->angle.has_value());
  CHECK_FALSE(measure({a}).has_value());
}

TEST_CASE("areas and volumes are said of the mesh, of markers and of the selection") {
  LookingRig rig({}, 1100, 1500);
  CHECK_FALSE(rig.visible("measures/volume"));
  rig.click("section/measures");
  rig.frames();
  REQUIRE(rig.visible("measures/volume"));
  CHECK(rig.visible("measures/markers"));
  CHECK_FALSE(rig.visible("measures/selection"));
  rig.click("marker/cavity");
  rig.frames();
  CHECK(rig.visible("measures/selection"));
  CHECK_FALSE(rig.visible("measures/alone"));
  rig.key(GLFW_KEY_I);
  REQUIRE(rig.settle());
  CHECK(rig.visible("measures/alone"));
}

TEST_CASE("elements that are shown alone are counted, and their volume is known") {
  LookingRig rig;
  CHECK_FALSE(rig.scenes().shown.alone.has_value());
  set_view(rig, [](ViewOptions& view) {
    view.color = ElementField(Metric::volume, 3);
    view.isolation.on = true;
    view.isolation.threshold = -1;
    view.isolation.above = true;
  });
  REQUIRE(rig.scenes().shown.alone.has_value());
  CHECK(rig.scenes().shown.alone->count == rig.mesh().topology->element_count());
  CHECK(rig.scenes().shown.alone->size == doctest::Approx(26.0 / 27));
}

TEST_CASE("go to finds faces by number, and by a marker and a number") {
  LookingRig rig({}, 1400, 900);
  const Topology& topology = *rig.mesh().topology;
  go_to(rig, "cavity 3");
  REQUIRE(rig.state().focus.has_value());
  CHECK(rig.state().focus->kind == MeshItem::Kind::face);
  const Face wanted = topology.markers()[at(rig.marker("cavity"))].faces[3];
  CHECK(rig.state().focus->id == *topology.find_face(wanted));
  CHECK(rig.space().view().viewport().contains(
      rig.at(centre_of(SpacePoints(rig.mesh().coordinates), wanted))));
  CHECK(rig.visible("focus"));
  CHECK(said(rig, *rig.state().focus, "Marker") == "cavity, its face 3");
  CHECK(said(rig, *rig.state().focus, "Area") == "0.01389");
  go_to(rig, "f0");
  CHECK(*rig.state().focus == MeshItem{MeshItem::Kind::face, 0});
  go_to(rig, "cavity 100000");
  CHECK(rig.visible("go_to/error"));
  CHECK(*rig.state().focus == MeshItem{MeshItem::Kind::face, 0});
}

TEST_CASE("faces are of volume meshes alone") {
  Rig rig;
  rig.open(two_body_mesh());
  go_to(rig, "f3");
  CHECK(rig.visible("go_to/error"));
  CHECK_FALSE(exists({MeshItem::Kind::face, 0}, rig.session()));
}

TEST_CASE("of elements and nodes their neighbours are said") {
  LookingRig rig;
  const Topology& topology = *rig.mesh().topology;
  const Index node = rig.node_at({1.0 / 6, 0.5, 1.0 / 3});
  REQUIRE(node >= 0);
  const std::string neighbours = said(rig, {MeshItem::Kind::node, node}, "Neighbours");
  CHECK(std::ranges::count(neighbours, ',') + 1 ==
        static_cast<long>(topology.neighbours(node).size()));
  CHECK_FALSE(said(rig, {MeshItem::Kind::node, node}, "Worst of them").empty());
  const Index element = topology.star(node).front();
  // A tetrahedron within has four neighbours, one at the boundary says on which marker.
  Index inner = -1, outer = -1;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const std::string list = said(rig, {MeshItem::Kind::element, e}, "Neighbours");
    const auto count = std::ranges::count(list, ',') + 1;
    if (count == 4 && inner < 0) inner = e;
    if (count < 4 && outer < 0) outer = e;
  }
  REQUIRE(inner >= 0);
  REQUIRE(outer >= 0);
  CHECK(said(rig, {MeshItem::Kind::element, inner}, "Faces on").empty());
  CHECK_FALSE(said(rig, {MeshItem::Kind::element, outer}, "Faces on").empty());
  CHECK_FALSE(said(rig, {MeshItem::Kind::element, element}, "Middle").empty());
}

TEST_CASE("a right click on a surface says which face is there, and describes it") {
  LookingRig rig;
  rig.show_outside();
  rig.key(GLFW_KEY_7);
  rig.key(keys::f);
  const double x = rig.space().view().back().x() > 0 ? 1 : 0;
  const ScreenPoint at = rig.at({x, 0.45, 0.55});
  rig.move(at);
  rig.frames();
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(3);
  REQUIRE(rig.visible("menu/face/describe"));
  rig.click("menu/face/describe");
  rig.frames();
  REQUIRE(rig.state().focus.has_value());
  REQUIRE(rig.state().focus->kind == MeshItem::Kind::face);
  const Topology::SharedFace face = rig.mesh().topology->face(rig.state().focus->id);
  CHECK(face.elements[1] < 0);
  for (const Index node : face.nodes)
    CHECK(rig.mesh().coordinates.xyz(node).x() == doctest::Approx(x));
}

TEST_CASE("numbers of nodes stand where they are seen, and none of what is hidden") {
  LookingRig rig;
  rig.show_outside();
  rig.key(GLFW_KEY_1);  // from +x
  rig.key(keys::f);
  CHECK(rig.blocked("node_ids").empty());
  rig.key(GLFW_KEY_I, {keys::shift});
  rig.frames();
  const auto nodes = ids_on_screen(rig, "id/n");
  REQUIRE(nodes.size() > 20);
  for (const std::string& id : nodes) {
    if (id == "one") continue;
    CAPTURE(id);
    CHECK(rig.mesh().coordinates.xyz(std::stoi(id)).x() == doctest::Approx(1));
  }
  // One lies where its node is.
  const Index node = rig.node_at({1, 0.5, 0.5});
  const auto label = rig.bench->widgets().find("id/n" + std::to_string(node));
  REQUIRE(label.has_value());
  CHECK((label->centre() - rig.at({1, 0.5, 0.5})).norm() < 3);
  // From afar there is no room.
  rig.wheel(rig.middle(), -16);
  rig.frames();
  CHECK(rig.visible("id/none"));
}

TEST_CASE("numbers of elements are those that a cut goes through") {
  LookingRig rig;
  rig.key(GLFW_KEY_4);
  rig.key(keys::f);
  rig.wheel(rig.middle(), 4);
  rig.key(keys::e, {keys::shift});
  rig.frames();
  std::set<Index> cut;
  for (const SpaceFill& fill : rig.scenes().parts.front()->fills)
    cut.insert(fill.elements.begin(), fill.elements.end());
  const auto elements = ids_on_screen(rig, "id/e");
  std::size_t of_cut = 0;
  for (const std::string& id : elements) of_cut += cut.contains(std::stoi(id)) ? 1 : 0;
  CHECK(of_cut > 3);
}

}  // namespace winslow::gui::test
