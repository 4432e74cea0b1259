#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "gui/files/file_kinds.h"
#include "gui/support/pixels.h"
#include "gui/support/rig.h"
#include "gui/support/space_rig.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/view/navigation/go_to.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::test {

TEST_CASE("A surface mesh opens in the view of space, with colours, legend and panels of its own") {
  SurfaceRig rig;
  CHECK(rig.session().kind() == MeshKind::surface);
  CHECK(rig.session().in_space());
  CHECK(rig.session().messages().prompt() == nullptr);
  CHECK(rig.options().color == ElementField(Metric::normalized_jacobian));
  CHECK(rig.bench->pane().mesh_view().legend().has_value());
  CHECK(rig.options().space.cuts.empty());
  for (const char* widget : {"quality/table", "worst/list", "solver/state", "markers/closed",
                             "markers/feature_angle", "quality/deviation"})
    CHECK_MESSAGE(rig.visible(widget), widget);
  for (const char* widget : {"cuts/add", "motion/apply", "solver/method"})
    CHECK_FALSE_MESSAGE(rig.visible(widget), widget);
  // All triangles are drawn, and each can be picked.
  std::size_t drawn = 0;
  for (const auto& part : rig.scenes().parts)
    for (const SpaceFill& fill : part->fills) drawn += fill.elements.size();
  CHECK(drawn == 288);
}

TEST_CASE("Every format of surfaces opens, and can be saved") {
  for (const char* name :
       {"a.obj", "a.off", "a.ply", "a.stl", "a.vtk", "a.vtu", "a.msh", "a.mesh", "a.su2"}) {
    CAPTURE(name);
    Rig rig(900, 600);
    rig.open(SurfaceRig::ball(), name);
    CHECK(rig.session().kind() == MeshKind::surface);
    CHECK(rig.mesh().topology->element_count() == 288);
    const auto kinds = dialog_of(FilePurpose::save_mesh, rig.session().kind()).kinds;
    CHECK(matches(kinds.front(), name));
    CHECK_FALSE(matches(kinds.front(), "a.ugrid"));
  }
}

TEST_CASE("What makes no sense for a surface says why, and does nothing by its key") {
  SurfaceRig rig;
  CHECK(rig.blocked("rotate").find("keeps its shape") != std::string::npos);
  CHECK(rig.blocked("shape_edit").find("keeps its shape") != std::string::npos);
  CHECK(rig.blocked("add_cut").find("nothing inside") != std::string::npos);
  CHECK(rig.blocked("insert_layers") == "Not for surface meshes.");
  for (const char* id : {"run", "step", "scramble", "look_from/iso", "perspective", "isolate",
                         "ghost", "ruler", "roles"})
    CHECK_MESSAGE(rig.blocked(id).empty(), id);
  for (const int key : {GLFW_KEY_C, GLFW_KEY_E, GLFW_KEY_M}) rig.key(key);
  CHECK(rig.options().space.cuts.empty());
  CHECK_FALSE(rig.session().selection().shape_edit().active);
  rig.key(GLFW_KEY_P);
  CHECK(rig.options().space.perspective);
}

TEST_CASE("The mouse turns a surface about what is under it, and a click tells of the element") {
  SurfaceRig rig;
  const Index node = rig.nearest_node();
  const Index element = rig.mesh().topology->star(node).front();
  const SpacePoints x(rig.mesh().coordinates);
  const auto corners = rig.mesh().topology->element(element);
  const Vec3 middle = (x[corners[0]] + x[corners[1]] + x[corners[2]]) / 3;
  rig.click(rig.at(middle));
  rig.frames();
  REQUIRE(rig.state().focus.has_value());
  CHECK(*rig.state().focus == MeshItem{MeshItem::Kind::element, element});
  const ScreenPoint from = rig.at(middle);
  rig.drag(from, from + ScreenVector(70, 20));
  rig.release();
  CHECK((rig.at(middle) - from).norm() < 1e-3);
  // Going to a node by its number, and to a face, which only volume meshes have.
  CHECK(parse_item("n7", rig.session(), rig.options()) == MeshItem{MeshItem::Kind::node, 7});
  CHECK_THROWS_AS(parse_item("f7", rig.session(), rig.options()), UsageError);
  const auto lines = describe_item(*rig.state().focus, rig.session());
  const auto has = [&](const char* name) {
    return std::ranges::any_of(lines, [&](const auto& line) { return line.first == name; });
  };
  CHECK(has("Neighbours"));
  CHECK(has("Deviation"));
  CHECK_FALSE(has("Faces on"));
}

TEST_CASE(
    "Scrambled elements are told from sound ones, smoothing brings them back, undo to the bit") {
  SurfaceRig rig;
  const Coordinates given = rig.mesh().coordinates;
  rig.scramble();
  const Coordinates scrambled = rig.mesh().coordinates;
  CHECK(scrambled != given);
  const Index inverted = rig.shown().inverted;
  CHECK(inverted > 30);
  REQUIRE(rig.session().quality().latest());
  CHECK(rig.session().quality().latest()->report.inverted == inverted);
  // They are red in the picture.
  const auto& parts = rig.scenes().parts;
  CHECK(std::ranges::any_of(parts, [&](const auto& part) {
    return std::ranges::any_of(part->fills, [&](const SpaceFill& fill) {
      return fill.emphasised && static_cast<Index>(fill.elements.size()) == inverted;
    });
  }));
  rig.key(keys::space);
  rig.settle();
  CHECK(rig.shown().inverted == 0);
  CHECK(rig.session().quality().latest()->report.inverted == 0);
  const Coordinates& x = rig.mesh().coordinates;
  double off = 0;
  for (Index i = 0; i < x.size(); ++i) off = std::max(off, std::abs(x.xyz(i).norm() - 1));
  CHECK(off < 1e-12);
  rig.key(keys::z, {keys::control});
  rig.settle();
  CHECK(rig.mesh().coordinates == scrambled);
  rig.key(keys::z, {keys::control});
  rig.settle();
  CHECK(rig.mesh().coordinates == given);
  CHECK(rig.shown().inverted == 0);
}

TEST_CASE("A step pauses, the next goes on, and Esc puts a surface back as it was") {
  SurfaceRig rig;
  rig.scramble();
  const Coordinates scrambled = rig.mesh().coordinates;
  rig.key(keys::n);
  REQUIRE(rig.wait([&] { return solver_paused(rig); }));
  const std::size_t first = rig.session().mesh().convergence().size();
  CHECK(first > 0);
  rig.key(keys::n);
  REQUIRE(rig.wait(
      [&] { return solver_paused(rig) && rig.session().mesh().convergence().size() > first; }));
  // While it is paused the deviation is measured.
  REQUIRE(rig.wait([&] { return rig.session().quality().latest()->deviation.has_value(); }));
  rig.key(keys::escape);
  rig.settle();
  CHECK(rig.mesh().coordinates == scrambled);
  CHECK(rig.session().coordinates() == scrambled);
}

TEST_CASE("The deviation colours elements, ranks them and stands in the quality tab") {
  SurfaceRig rig;
  rig.scramble();
  rig.color_by("Deviation");
  REQUIRE(rig.options().color == ElementField(SurfaceField::deviation));
  const auto& measured = *rig.session().quality().latest();
  REQUIRE(measured.deviation.has_value());
  const SurfaceDistance given(SurfaceRig::ball());
  const std::vector<double> expected = element_distances(rig.mesh(), given);
  REQUIRE(measured.values.size() == expected.size());
  for (std::size_t e = 0; e < expected.size(); ++e)
    CHECK(measured.values[e] == doctest::Approx(expected[e]).epsilon(1e-9));
  const auto& legend = rig.bench->pane().mesh_view().legend();
  REQUIRE(legend.has_value());
  CHECK(legend->title.find("Deviation") != std::string::npos);
  // The list goes by what is coloured: the one furthest away comes first.
  const auto worst = worst_elements(rig.session(), rig.options());
  REQUIRE_FALSE(worst.empty());
  const double largest = *std::ranges::max_element(measured.values);
  CHECK(worst.front().value == largest);
  CHECK(measured.deviation->change.from_after == largest);
  CHECK(measured.deviation->change.hausdorff() >= largest);
  rig.type("]");
  rig.frames();
  REQUIRE(rig.state().focus.has_value());
  CHECK(rig.state().focus->id == worst.front().element);
  // Another mesh has no such field.
  const auto plane = write(rig.folder, two_body_mesh(), "plane.su2");
  rig.bench->apply(action::OpenMesh{plane, true});
  REQUIRE(rig.settle());
  CHECK(rig.options().color == ElementField(Metric::normalized_jacobian));
  CHECK_FALSE(rig.visible("quality/deviation"));
}

TEST_CASE("The feature angle is drawn while it is typed, and is that of the next run") {
  // Nodes of the edges along x are crowded at one end, and would rather be elsewhere.
  Mesh box = SurfaceRig::box();
  for (Index i = 0; i < box.coordinates.size(); ++i) {
    const Vec3 p = box.coordinates.xyz(i);
    const bool on_edge = std::abs(p.y() - 0.5) == 0.5 && std::abs(p.z() - 0.5) == 0.5;
    if (on_edge) box.coordinates.set_xyz(i, Vec3(std::pow(p.x(), 1.5), p.y(), p.z()));
  }
  SurfaceRig rig(box);
  const auto feature_lines = [&] {
    std::size_t most = 0;  // in the thickest list of lines there are the features alone
    for (const auto& part : rig.scenes().parts)
      for (const SpaceLines& lines : part->lines)
        if (lines.width > 1.5f) most += lines.ends.size() / 2;
    return most;
  };
  CHECK(feature_lines() == 12 * 4);
  rig.fill("markers/feature_angle", "100");
  rig.settle();
  CHECK(feature_lines() == 0);
  CHECK(rig.session().solver_settings().smooth_options().slide.feature_angle == 100);
  rig.fill("markers/feature_angle", "40");
  rig.click("markers/features");
  rig.settle();
  CHECK(feature_lines() == 12 * 4);
  CHECK(rig.session().solver_settings().smooth_options().slide.features);
  // Corners stay, edges slide, and what nodes do is drawn.
  rig.click("markers/roles");
  rig.settle();
  const auto roles = rig.session().inspection().roles.find();
  REQUIRE(roles);
  CHECK(std::ranges::count(roles->roles, NodeRole::corner) == 8);
  CHECK(std::ranges::count(roles->roles, NodeRole::on_curve) == 36);
  const Coordinates given = rig.mesh().coordinates;
  rig.click("solver/advanced");  // quadrilaterals keep their shapes unless told otherwise
  rig.frames();
  rig.click("solver/targets");
  rig.click("solver/targets/Make regular");
  rig.key(keys::space);
  rig.settle();
  const Coordinates& x = rig.mesh().coordinates;
  CHECK(rig.shown().inverted == 0);
  double along_edges = 0;
  for (Index i = 0; i < x.size(); ++i) {
    CHECK((x.xyz(i) - Vec3(0.5, 0.5, 0.5)).cwiseAbs().maxCoeff() == doctest::Approx(0.5));
    const NodeRole role = roles->roles[at(i)];
    if (role == NodeRole::corner) CHECK(x.same_place(i, given));
    if (role == NodeRole::on_curve)
      along_edges = std::max(along_edges, (x.xyz(i) - given.xyz(i)).norm());
  }
  CHECK(rig.document().history().size() == 2);
  CHECK(along_edges > 0.02);
}

TEST_CASE("The border of an open surface is a line in its colour, which the eye hides") {
  SurfaceRig rig(SurfaceRig::saddle());
  REQUIRE(rig.mesh().topology->markers().size() == 1);
  const auto borders = [&] {
    std::size_t count = 0;
    for (const auto& part : rig.scenes().parts)
      for (const SpaceLines& lines : part->lines)
        if (lines.width > 2) count += lines.ends.size() / 2;
    return count;
  };
  CHECK(borders() == 4 * 8);
  const std::string name = rig.mesh().topology->markers()[0].name;
  CHECK(rig.visible("marker/" + name));
  CHECK_FALSE(rig.visible("marker_role/" + name));
  rig.click("marker/" + name);
  rig.frames();
  CHECK(rig.session().selection().contains(0));
  CHECK_FALSE(rig.visible("gizmo/centre"));
  rig.click("marker_hide/" + name);
  rig.settle();
  CHECK(borders() == 0);
}

TEST_CASE("Isolated elements of a surface are drawn alone, the mesh before as a ghost or beside") {
  SurfaceRig rig(SurfaceRig::ball(), 1000, 700);
  const Index all = rig.mesh().topology->element_count();
  rig.key(GLFW_KEY_I);
  set_view(rig, [](ViewOptions& view) { view.isolation.threshold = 0.8; });
  rig.settle();
  REQUIRE(rig.scenes().shown.alone.has_value());
  const ShownAlone alone = *rig.scenes().shown.alone;
  CHECK(alone.count > 0);
  CHECK(alone.count < all);
  CHECK(alone.size > 0);
  CHECK(alone.size < 4 * pi);
  rig.key(GLFW_KEY_I);
  rig.scramble();
  PictureSpec spec;
  spec.panels = false;
  const Image plain = rig.bench->pictures().picture(spec);
  const ScreenPoint end(plain.width, plain.height);
  for (const auto& modifiers : {std::vector<int>{}, std::vector<int>{keys::shift}}) {
    rig.key(GLFW_KEY_G, modifiers);
    rig.settle();
    CHECK(differing(plain, rig.bench->pictures().picture(spec), {0, 0}, end) > 200);
    rig.key(GLFW_KEY_G, modifiers);
  }
}

TEST_CASE("A node of a surface shows its star laid flat, and an angle that is typed moves it") {
  SurfaceRig rig;
  const Index node = rig.nearest_node();
  rig.click("tab/vcv");
  rig.frames();
  rig.click(rig.at(rig.mesh().coordinates.xyz(node)));
  rig.settle();
  REQUIRE(rig.session().nodes().inspected() == node);
  CHECK(rig.visible("vcv/kappa"));
  CHECK(rig.visible("vcv/angle"));
  const Vec3 before = rig.mesh().coordinates.xyz(node);
  rig.fill("vcv/angle", "100");
  rig.settle();
  CHECK(rig.session().messages().prompt() == nullptr);
  CHECK(rig.session().vcv()->edited(node));
  const Vec3 after = rig.mesh().coordinates.xyz(node);
  CHECK((after - before).norm() > 1e-4);
  CHECK(after.norm() == doctest::Approx(1));
}

TEST_CASE("The border line under the mouse is thick, as markers of plane meshes are") {
  SurfaceRig rig(SurfaceRig::saddle());
  const auto dark_pixels = [&] {  // of the line's colour, along a cut across it
    rig.frames(3);
    const Image picture = rig.bench->pictures().picture();
    const Vec3 middle(0.5, 0, 0), inside(0.5, 0.1, -0);
    const ScreenPoint from = rig.at(middle);
    const ScreenVector way = (rig.at(inside) - from) / (rig.at(inside) - from).norm();
    const Rgb c = color_of_marker(rig.options(), rig.mesh().topology->markers()[0].name, 0, false);
    int count = 0;
    for (double t = -8; t <= 8; t += 0.25) {
      const ScreenPoint p = from + t * way;
      const auto* rgb = picture.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
      bool same = true;
      for (std::size_t k = 0; k < 3; ++k) same = same && std::abs(rgb[k] - 255 * c[k]) < 40;
      count += same;
    }
    return count;
  };
  rig.move(ScreenPoint(5, 5));
  const int calm = dark_pixels();
  CHECK(calm > 0);
  rig.move(rig.at({0.45, 0, 0.025}));
  rig.frames(3);
  REQUIRE(rig.session().selection().hovered() == std::vector<Index>{0});
  CHECK(dark_pixels() > calm + 2);
  rig.move(ScreenPoint(5, 5));
  CHECK(dark_pixels() == calm);
}

TEST_CASE("VCVs of a surface are pinned over it where they are seen, and applied to other nodes") {
  SurfaceRig rig;
  const Index node = rig.nearest_node();
  rig.click("tab/vcv");
  rig.frames();
  rig.click(rig.at(rig.mesh().coordinates.xyz(node)));
  rig.settle();
  REQUIRE(rig.session().nodes().inspected() == node);
  rig.move(ScreenPoint(5, 5));
  rig.frames(3);
  const ScreenPoint at = rig.at(rig.mesh().coordinates.xyz(node));
  const ScreenVector around(40, 40);
  const Image bare = rig.bench->pictures().picture();
  rig.click("vcv/pin");
  rig.move(ScreenPoint(5, 5));
  rig.frames(3);
  CHECK(rig.visible("pin/" + std::to_string(node)));
  CHECK(differing(bare, rig.bench->pictures().picture(), at - around, at + around) > 200);
  // From the other side it is hidden.
  const Vec3 back = -rig.space().view().back();
  rig.bench->apply(action::PinNodes{{node}, false});
  Index behind = node;
  const Coordinates& x = rig.mesh().coordinates;
  for (Index i = 0; i < x.size(); ++i)
    if (x.xyz(i).dot(back) > x.xyz(behind).dot(back)) behind = i;
  rig.bench->apply(action::PinNodes{{behind}, true});
  rig.frames(3);
  CHECK_FALSE(rig.visible("pin/" + std::to_string(behind)));

  // Applied within a radius: to nodes of as many neighbours on this side.
  rig.fill("vcv/angle", "80");
  rig.settle();
  REQUIRE(rig.session().vcv()->edited(node));
  rig.click("vcv/spread");
  rig.click("vcv/spread/Nodes within a radius");
  rig.frames();
  rig.fill("vcv/radius", "0.5");
  rig.frames();
  const std::vector<double> given(rig.session().vcv()->angles(node).begin(),
                                  rig.session().vcv()->angles(node).end());
  const Mesh before = rig.mesh();
  rig.click("vcv/apply");
  rig.settle();
  CHECK(rig.session().messages().prompt() == nullptr);
  int others = 0;
  for (Index i = 0; i < before.coordinates.size(); ++i) {
    const double away = (before.coordinates.xyz(i) - before.coordinates.xyz(node)).norm();
    const bool alike = before.topology->neighbours(i).size() == given.size();
    CHECK(rig.session().vcv()->edited(i) == (away <= 0.5 && alike));
    if (i == node || !rig.session().vcv()->edited(i)) continue;
    ++others;
    std::vector<double> angles(rig.session().vcv()->angles(i).begin(),
                               rig.session().vcv()->angles(i).end());
    std::vector<double> mine = given;
    std::ranges::sort(angles);
    std::ranges::sort(mine);
    for (std::size_t k = 0; k < mine.size(); ++k) CHECK(std::abs(angles[k] - mine[k]) < 1e-12);
  }
  CHECK(others >= 4);
}

TEST_CASE("A smoothed surface is saved, a tangled one is asked about") {
  SurfaceRig rig;
  rig.key(keys::space);
  rig.settle();
  const auto path = rig.folder / "out.obj";
  rig.bench->apply(action::SaveMesh{path});
  rig.settle();
  CHECK(io::read_mesh(path).mesh.coordinates == rig.mesh().coordinates);
  rig.scramble();
  rig.bench->apply(action::SaveMesh{rig.folder / "tangled.obj"});
  rig.settle();
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->title.find("inverted") != std::string::npos);
}

}  // namespace winslow::gui::test
