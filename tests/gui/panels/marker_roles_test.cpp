#include <doctest/doctest.h>

#include <cmath>

#include "core/inspect/node_roles.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/view/overlays/role_overlay.h"
#include "support/meshes.h"
#include "support/paths.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

const SlideOptions& slide_of(const Rig& rig) {
  return rig.session().solver_settings().smooth_options().slide;
}

/// A square whose sides left and right have their nodes too near to its ends, alike.
Mesh plane_square() {
  MeshData data = winslow::test::square(8, winslow::test::Cells::triangles);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec2 p = data.coordinates.xy(i);
    if (p.x() == 0 || p.x() == 1)
      data.coordinates.set_xy(i, {p.x(), p.y() - 0.03 * std::sin(4 * pi * p.y())});
  }
  return make_mesh(data);
}

/// By a right click on the marker's role and the list that it leads to.
void pair(Rig& rig, const std::string& first, const std::string& second) {
  const auto word = rig.bench->widgets().find("marker_role/" + first);
  REQUIRE(word.has_value());
  rig.move(word->centre());
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(3);
  rig.click("menu/body/periodic");
  rig.frames(3);
  CHECK_FALSE(rig.visible("menu/periodic/" + first));
  rig.click("menu/periodic/" + second);
  rig.frames(3);
}

bool in_key(const Rig& rig, NodeRole role) {
  return rig.visible("roles/key/" + std::to_string(static_cast<int>(role)));
}

/// Pixels of a colour within a few of a place.
int coloured(const Image& image, const ScreenPoint& at, ImU32 color) {
  const ImVec4 wanted = ImGui::ColorConvertU32ToFloat4(color);
  int count = 0;
  for (int dy = -2; dy <= 2; ++dy)
    for (int dx = -2; dx <= 2; ++dx) {
      const auto* p = image.pixel(static_cast<int>(at.x()) + dx, static_cast<int>(at.y()) + dy);
      count += std::abs(p[0] - 255 * wanted.x) < 12 && std::abs(p[1] - 255 * wanted.y) < 12 &&
               std::abs(p[2] - 255 * wanted.z) < 12;
    }
  return count;
}

}  // namespace

TEST_CASE(
    "two markers are made periodic by clicks, the next run keeps them so, and they are parted") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  rig.click("marker_role/left");
  REQUIRE(slide_of(rig).markers == std::vector<std::string>{"left"});
  pair(rig, "left", "right");
  CHECK(slide_of(rig).periodic == std::vector<std::string>{"left", "right"});
  CHECK(slide_of(rig).markers.empty());  // it no longer slides
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  const auto& done = std::get<SmoothCommand>(
      rig.document().history().command(rig.document().history().position()));
  CHECK(done.smooth.slide.periodic.size() == 2);
  int moved = 0;
  const PeriodicPairs pairs =
      PeriodicPairs::find(*rig.mesh().topology, rig.mesh().coordinates, "left", "right");
  const Coordinates& given = rig.document().history().state(0).mesh.coordinates;
  for (const auto& [node, image] : pairs.pairs) {
    const Vec2 p = rig.mesh().coordinates.xy(node), q = rig.mesh().coordinates.xy(image);
    CHECK((q - p - Vec2(1, 0)).norm() < 1e-12);
    moved += (p - given.xy(node)).norm() > 1e-9;
  }
  CHECK(moved > 0);
  // A click on the word of a periodic side opens the list again: none.
  rig.click("marker_role/right");
  rig.frames(3);
  rig.click("menu/body/periodic");
  rig.frames(3);
  rig.click("menu/periodic/none");
  rig.frames(2);
  CHECK(slide_of(rig).periodic.empty());
}

TEST_CASE("sides that do not match are refused, and which pair does not is said") {
  Rig rig(1280, 900);
  rig.open(ring_mesh());
  pair(rig, "flap", "farfield");
  CHECK(slide_of(rig).periodic.empty());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->text.find("flap") != std::string::npos);
}

TEST_CASE("what nodes do is shown in colours with a key, and follows roles and feature angle") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  CHECK_FALSE(rig.visible("markers/feature_angle"));
  rig.click("marker_role/top");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK_FALSE(rig.visible("roles/key"));
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(rig.bench->view_control().options().roles);
  REQUIRE(rig.visible("roles/key"));
  CHECK(in_key(rig, NodeRole::on_curve));
  CHECK(in_key(rig, NodeRole::corner));
  CHECK_FALSE(in_key(rig, NodeRole::periodic));
  rig.move(ScreenPoint(5, 5));
  rig.frames(2);
  const Image picture = rig.bench->pictures().picture();
  CHECK(coloured(picture, rig.pixel(Vec2(0.5, 1)), color_of(NodeRole::on_curve)) > 8);
  CHECK(coloured(picture, rig.pixel(Vec2(1, 1)), color_of(NodeRole::corner)) > 8);
  CHECK(coloured(picture, rig.pixel(Vec2(0.5, 0)), color_of(NodeRole::on_curve)) == 0);
  pair(rig, "left", "right");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(in_key(rig, NodeRole::periodic));
  rig.click("markers/roles");
  rig.frames(2);
  CHECK_FALSE(rig.visible("roles/key"));
  // While the angle is edited it is shown, and no longer.
  rig.click("markers/feature_angle");
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(rig.visible("roles/key"));
  rig.key(keys::a, {keys::control});
  rig.type("75");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(slide_of(rig).feature_angle == 75);
  CHECK_FALSE(rig.visible("roles/key"));
}

TEST_CASE(
    "where regions meet nodes stay, which is shown, unless the row below the list says else") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  CHECK_FALSE(rig.visible("markers/interfaces"));
  MeshData data = winslow::test::square(8, winslow::test::Cells::triangles);
  data.regions = {{"rock", 1}, {"sand", 2}};
  for (Index e = 0; e < data.element_count(); ++e) {
    double height = 0;
    for (const Index node : data.element(e)) height += data.coordinates.xy(node).y() / 3;
    data.element_region.push_back(height < 0.5 ? 0 : 1);
  }
  rig.open(make_mesh(data), "regions.msh");
  rig.frames(2);
  REQUIRE(rig.visible("markers/interfaces"));
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(in_key(rig, NodeRole::regions));
  rig.move(ScreenPoint(5, 5));
  rig.frames(2);
  const Image picture = rig.bench->pictures().picture();
  CHECK(coloured(picture, rig.pixel(Vec2(0.5, 0.5)), color_of(NodeRole::regions)) > 8);
  CHECK(coloured(picture, rig.pixel(Vec2(0.5, 0.625)), color_of(NodeRole::regions)) == 0);
  rig.click("markers/interfaces");
  rig.frames(2);
  rig.click("markers/interfaces/Slide");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(slide_of(rig).interfaces == Interfaces::slide);
  CHECK_FALSE(in_key(rig, NodeRole::regions));
  CHECK(in_key(rig, NodeRole::on_curve));
}

TEST_CASE("a node is held, let slide and left as found by a right click, which undo takes back") {
  Rig rig(1280, 900);
  MeshData data = winslow::test::square(8, winslow::test::Cells::triangles);
  Marker all;
  all.name = "all";
  for (const Marker& marker : data.markers)
    all.faces.insert(all.faces.end(), marker.faces.begin(), marker.faces.end());
  data.markers = {all};
  rig.open(make_mesh(data));
  rig.click("marker_role/all");
  REQUIRE(rig.settle());
  const auto right_click = [&](const Vec2& p) {
    rig.move(rig.pixel(p));
    rig.press(MouseButton::right);
    rig.release(MouseButton::right);
    rig.frames(3);
  };
  right_click({0.5, 0});
  CHECK(rig.visible("menu/node/go_to"));
  CHECK_FALSE(rig.visible("menu/node/hold"));  // only while it is shown what nodes do
  rig.key(keys::escape);
  rig.frames(2);
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.frames(2);

  right_click({0.5, 0});
  REQUIRE(rig.visible("menu/node/hold"));
  rig.click("menu/node/slide");  // it slides anyway: grey
  rig.frames(2);
  CHECK(slide_of(rig).smooth_nodes.empty());
  rig.click("menu/node/hold");
  REQUIRE(rig.settle());
  rig.frames(3);
  REQUIRE(slide_of(rig).hold_nodes.size() == 1);
  const Index held = slide_of(rig).hold_nodes.front();
  CHECK(rig.mesh().coordinates.xy(held) == Vec2(0.5, 0));
  CHECK(in_key(rig, NodeRole::held));
  CHECK(rig.visible("roles/key/overridden"));
  rig.move(ScreenPoint(5, 5));
  rig.frames(2);
  CHECK(coloured(rig.bench->pictures().picture(), rig.pixel(Vec2(0.5, 0)),
                 color_of(NodeRole::held)) > 8);

  right_click({0, 0});
  rig.click("menu/node/slide");
  REQUIRE(rig.settle());
  rig.frames(3);
  REQUIRE(slide_of(rig).smooth_nodes.size() == 1);
  const Index corner = slide_of(rig).smooth_nodes.front();
  rig.move(ScreenPoint(5, 5));
  rig.frames(2);
  CHECK(coloured(rig.bench->pictures().picture(), rig.pixel(Vec2(0, 0)),
                 color_of(NodeRole::on_curve)) > 8);

  // Undone and redone one after the other, among the commands of the history.
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const auto& done = std::get<SmoothCommand>(rig.document().history().command(1));
  CHECK(done.smooth.slide.hold_nodes == std::vector<Index>{held});
  CHECK(done.smooth.slide.smooth_nodes == std::vector<Index>{corner});
  CHECK(rig.mesh().coordinates.xy(held) == Vec2(0.5, 0));
  const auto undo = [&] {
    rig.key(keys::z, {keys::control});
    REQUIRE(rig.settle());
    rig.frames(2);
  };
  const auto redo = [&] {
    rig.key(keys::z, {keys::control, keys::shift});
    REQUIRE(rig.settle());
    rig.frames(2);
  };
  undo();  // the command
  CHECK(rig.document().history().position() == 0);
  CHECK(slide_of(rig).smooth_nodes.size() == 1);
  undo();
  CHECK(slide_of(rig).smooth_nodes.empty());
  CHECK(slide_of(rig).hold_nodes.size() == 1);
  undo();
  CHECK(slide_of(rig).hold_nodes.empty());
  CHECK_FALSE(rig.visible("roles/key/overridden"));
  redo();
  redo();
  CHECK(slide_of(rig).hold_nodes.size() == 1);
  CHECK(slide_of(rig).smooth_nodes.size() == 1);
  CHECK(rig.document().history().position() == 0);
  redo();
  CHECK(rig.document().history().position() == 1);

  right_click({0.5, 0});
  rig.click("menu/node/as_found");
  REQUIRE(rig.settle());
  CHECK(slide_of(rig).hold_nodes.empty());
  // Of a marker that does not slide they mean nothing, and are there when it slides again.
  rig.click("marker_role/all");
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK_FALSE(rig.visible("markers/fault"));
  CHECK(rig.session().solver_settings().smooth_in_place().slide.smooth_nodes.empty());
  rig.click("marker_role/all");
  CHECK(rig.session().solver_settings().smooth_in_place().slide.smooth_nodes ==
        std::vector<Index>{corner});
}

TEST_CASE("roles in space: seen nodes of a sliding face have dots, and along its edges if asked") {
  Rig rig(1280, 900);
  rig.open(make_mesh(winslow::test::cube(4, winslow::test::Volumes::tetrahedra)));
  rig.key(GLFW_KEY_5);  // from above, onto the lid
  rig.click("marker_role/lid");
  rig.frames(2);
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.move(ScreenPoint(5, 5));
  rig.frames(3);
  REQUIRE(rig.visible("roles/key"));
  CHECK(in_key(rig, NodeRole::on_surface));
  CHECK(rig.visible("markers/features"));
  const View& view = rig.bench->view_control().view();
  const auto dots = [&](const Vec3& place, NodeRole role) {
    const Image picture = rig.bench->pictures().picture();
    return coloured(picture, view.project(place).at, color_of(role));
  };
  CHECK(dots({0.5, 0.5, 1}, NodeRole::on_surface) > 8);
  CHECK(dots({0, 0.5, 1}, NodeRole::corner) > 8);
  rig.key(GLFW_KEY_6);  // from below the lid is hidden
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(dots({0.5, 0.5, 1}, NodeRole::on_surface) == 0);
  // With the edges, too: nodes at the lid's border slide along it where the walls slide as well.
  rig.click("marker_role/walls");
  rig.click("markers/features");
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(slide_of(rig).features);
  CHECK(in_key(rig, NodeRole::on_curve));
}

TEST_CASE("spacing is held by the form, and what then stays is shown to") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  CHECK_FALSE(rig.visible("markers/spacing"));
  rig.click("marker_role/top");
  rig.frames(2);
  rig.click("markers/roles");
  REQUIRE(rig.settle());
  rig.frames(2);
  REQUIRE(rig.visible("markers/spacing"));
  CHECK(slide_of(rig).spacing == SlideSpacing::automatic);
  CHECK(in_key(rig, NodeRole::on_curve));
  rig.click("markers/spacing");
  rig.click("markers/spacing/Held");
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK(slide_of(rig).spacing == SlideSpacing::held);
  CHECK_FALSE(in_key(rig, NodeRole::on_curve));
  CHECK(in_key(rig, NodeRole::corner));
  // In space it is of edges, and there where nodes slide along these.
  Rig space(1280, 900);
  space.open(make_mesh(winslow::test::cube(4, winslow::test::Volumes::tetrahedra)));
  space.click("marker_role/lid");
  space.frames(2);
  CHECK_FALSE(space.visible("markers/spacing"));
  space.click("markers/features");
  space.frames(2);
  CHECK(space.visible("markers/spacing"));
}

namespace {

const SlideOptions& taken_of(const Rig& rig) {
  return rig.session().solver_settings().smooth_options().slide;
}

void open_passage(Rig& rig) {
  rig.bench->apply(action::OpenMesh{winslow::test::test_data("periodic_41.msh")});
  REQUIRE(rig.settle());
  rig.frames(3);
}

void offer_partners(Rig& rig, const std::string& marker) {
  const auto word = rig.bench->widgets().find("marker_role/" + marker);
  REQUIRE(word.has_value());
  rig.move(word->centre());
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(3);
  rig.click("menu/body/periodic");
  rig.frames(3);
}

}  // namespace

TEST_CASE("periodic pairs of the file are taken by a click, and the next run keeps them together") {
  Rig rig(1280, 900);
  open_passage(rig);
  REQUIRE(rig.visible("markers/file_pairs"));
  rig.click("markers/file_pairs");
  rig.frames(3);
  CHECK(taken_of(rig).periodic_from_file);
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  const Coordinates& now = rig.mesh().coordinates;
  const Coordinates& given = rig.document().history().state(0).mesh.coordinates;
  CHECK((now.xy(5) - now.xy(4) - Vec2(0, 1)).norm() < 1e-12);
  CHECK((now.xy(4) - given.xy(4)).norm() > 1e-6);
  // To have one of them stay leaves the pairs of the file.
  offer_partners(rig, "upper");
  rig.click("menu/periodic/none");
  rig.frames(3);
  CHECK_FALSE(taken_of(rig).periodic_from_file);
  CHECK(taken_of(rig).periodic.empty());
}

TEST_CASE("the partner that the file names comes first, after none") {
  Rig rig(1280, 900);
  open_passage(rig);
  offer_partners(rig, "lower");
  const auto upper = rig.bench->widgets().find("menu/periodic/upper");
  const auto in = rig.bench->widgets().find("menu/periodic/in");
  REQUIRE(upper.has_value());
  REQUIRE(in.has_value());
  CHECK(upper->centre().y() < in->centre().y());
  rig.click("menu/periodic/upper");
  rig.frames(3);
  CHECK(taken_of(rig).periodic == std::vector<std::string>{"lower", "upper"});
}

TEST_CASE("a file that names no pairs offers none") {
  Rig rig(1280, 900);
  rig.bench->apply(action::OpenMesh{winslow::test::test_data("square_41.msh")});
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK_FALSE(rig.visible("markers/file_pairs"));
}

TEST_CASE("what the selection stands on gives way, until a click fixes it") {
  Rig rig(1280, 900);
  rig.open(plane_square());
  rig.bench->apply(action::SelectMarkers{{rig.marker("bottom")}});
  const auto give_way = [&] {
    rig.frames(1);
    const auto roles = rig.session().inspection().roles.find();
    return roles && rig.session().inspection().roles.up_to_date() ? roles->give_way
                                                                  : std::vector<std::string>{};
  };
  REQUIRE(rig.wait([&] { return give_way() == std::vector<std::string>{"left", "right"}; }, 30));
  rig.click("marker_role/left");
  CHECK(slide_of(rig).fixed == std::vector<std::string>{"left"});
  REQUIRE(rig.wait([&] { return give_way() == std::vector<std::string>{"right"}; }, 30));
  rig.click("marker_role/left");
  CHECK(slide_of(rig).fixed.empty());
  CHECK(slide_of(rig).markers.empty());
  // Who moves is not fixed.
  rig.click("marker_role/right");
  REQUIRE(slide_of(rig).fixed == std::vector<std::string>{"right"});
  SlideOptions slide = slide_of(rig);
  leave_to_motion(slide, nullptr, *rig.mesh().topology, {"right"});
  CHECK(slide.fixed.empty());
}

}  // namespace winslow::gui::test
