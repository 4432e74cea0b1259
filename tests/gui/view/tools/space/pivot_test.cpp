#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "gui/files/assets.h"
#include "gui/support/moving_rig.h"
#include "gui/support/space_rig.h"

namespace winslow::gui::test {

namespace {

/// A cube with a cubic cavity of edges of two faces each, seen from aslant.
struct CavityStudio : MovingStudio {
  CavityStudio()
      : MovingStudio(
            make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::hexahedra)),
            "cavity") {
    // The cut leaves the body whole, and nothing before it.
    set_view(*this, [](ViewOptions& view) {
      view.space.cuts = {CutPlane{{0.5, 0.95, 0.5}, {0, -1, 0}, true}};
    });
    bench->apply(action::HoldCut{});
    frames();
  }
  const SpacePivot& pivot() const { return session().selection().space().source(); }
  void hover(const Vec3& point) {
    move(at(point));
    frames();
  }
};

const Vec3 corner(1.0 / 3, 1.0 / 3, 2.0 / 3);  // of the cavity, at the viewer's side

}  // namespace

TEST_CASE("An edge that is picked is the hinge: the whole straight row of sharp edges") {
  CavityStudio studio;
  studio.click("motion/pick_edge");
  REQUIRE(studio.session().selection().space().pick().has_value());
  CHECK_FALSE(studio.visible("gizmo/centre"));  // nothing lies in the way of the click
  studio.hover({0.42, 1.0 / 3, 0.655});         // just below the upper edge of the front
  const auto& source = studio.bench->pane().viewport().picker().pivot_source();
  REQUIRE(source.has_value());
  CHECK(source->from == PivotFrom::edge);
  CHECK(studio.session().selection().hovered().empty());
  studio.click(studio.at({0.42, 1.0 / 3, 0.655}));
  CHECK_FALSE(studio.session().selection().space().pick().has_value());
  CHECK(studio.session().selection().markers() == std::vector<Index>{studio.marker("cavity")});
  CHECK(studio.pivot().from == PivotFrom::edge);
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 1.0 / 3, 2.0 / 3)).norm() < 1e-12);
  CHECK((studio.session().selection().space().axis() - Vec3(1, 0, 0)).norm() < 1e-12);
  CHECK(studio.visible("pivot/line"));
  // Its ring turns about it, and so do typed degrees.
  studio.fill("motion/rotate", "8");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  CHECK(studio.last_motion().rotate == 8);
  CHECK((*studio.last_motion().pivot - Vec3(0.5, 1.0 / 3, 2.0 / 3)).norm() < 1e-12);
  CHECK((*studio.last_motion().axis - Vec3(1, 0, 0)).norm() < 1e-12);
  studio.check_replay();
  // The nodes of the hinge have not moved.
  for (const Index node : studio.pivot().nodes)
    CHECK((studio.mesh().coordinates.xyz(node) -
           studio.document().history().state(0).mesh.coordinates.xyz(node))
              .norm() < 1e-12);
}

TEST_CASE("A face that is picked gives its centre and normal, out of the mesh") {
  CavityStudio studio;
  studio.click("motion/pick_face");
  studio.click(studio.at({0.45, 1.0 / 3, 0.42}));
  CHECK(studio.pivot().from == PivotFrom::face);
  const Vec3 pivot = studio.session().selection().space_pivot();
  CHECK((pivot - Vec3(5.0 / 12, 1.0 / 3, 5.0 / 12)).norm() < 1e-12);
  CHECK((studio.session().selection().space().axis() - Vec3(0, -1, 0)).norm() < 1e-12);
}

TEST_CASE("Two nodes are the ends of the axis; a node is the pivot and leaves the axis as it is") {
  CavityStudio studio;
  studio.click("motion/pick_nodes");
  studio.click(studio.at(corner + Vec3(0.02, 0, -0.02)));
  REQUIRE(studio.session().selection().space().pick().has_value());  // the other one is missing
  CHECK(studio.session().selection().space().pick()->first.has_value());
  studio.click(studio.at({0.65, 1.0 / 3, 0.35}));
  CHECK_FALSE(studio.session().selection().space().pick().has_value());
  CHECK(studio.pivot().from == PivotFrom::nodes);
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 1.0 / 3, 0.5)).norm() < 1e-12);
  const Vec3 axis = studio.session().selection().space().axis();
  CHECK(axis.cross(Vec3(1, 0, -1).normalized()).norm() < 1e-12);
  // The axis is none of the mesh's own: the handle has a frame with it.
  studio.move(studio.handle("ring/axis"));
  studio.frames();
  CHECK(studio.mover().handle() == Handle{Handle::Kind::ring, 2});
  studio.click("motion/pick_node");
  studio.click(studio.at(corner + Vec3(0.03, 0, -0.02)));
  CHECK(studio.pivot().from == PivotFrom::node);
  CHECK((studio.session().selection().space_pivot() - corner).norm() < 1e-12);
  CHECK(studio.session().selection().space().axis() == axis);
}

TEST_CASE("Pivots and axes are typed as well, and each selection has its own again") {
  CavityStudio studio;
  studio.fill("motion/axis_x", "1");
  studio.fill("motion/axis_z", "2");
  CHECK(studio.session().selection().space().axis() == Vec3(1, 0, 2));
  studio.fill("motion/pivot_y", "0.25");
  const Vec3 pivot(0.5, 0.25, 0.5);
  CHECK((studio.session().selection().space_pivot() - pivot).norm() < 1e-12);
  studio.take("outer");
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12);
  CHECK(studio.session().selection().space().axis() == Vec3(0, 0, 1));
  studio.take("cavity");
  CHECK((studio.session().selection().space_pivot() - pivot).norm() < 1e-12);
  CHECK(studio.session().selection().space().axis() == Vec3(1, 0, 2));
  studio.click("motion/pivot_centre");
  CHECK((studio.session().selection().space_pivot() - Vec3(0.5, 0.5, 0.5)).norm() < 1e-12);
}

TEST_CASE("A picked pivot stays with its nodes: through motions, undo and redo") {
  CavityStudio studio;
  studio.click("motion/pick_edge");
  studio.click(studio.at({0.42, 1.0 / 3, 0.655}));
  const Vec3 hinge = studio.session().selection().space_pivot();
  const ScreenPoint from = studio.handle("arrow/z");
  studio.drag(from, from + ScreenVector(0, 25));
  studio.follow();
  const Vec3 way = studio.live().translate;
  REQUIRE(way.z() < 0);
  CHECK((studio.session().selection().space_pivot() - hinge - way).norm() < 1e-12);
  studio.release();
  REQUIRE(studio.settle());
  CHECK((studio.session().selection().space_pivot() - hinge - way).norm() < 1e-12);
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK((studio.session().selection().space_pivot() - hinge).norm() < 1e-12);
  studio.key(keys::z, {keys::control, keys::shift});
  REQUIRE(studio.settle());
  CHECK((studio.session().selection().space_pivot() - hinge - way).norm() < 1e-12);
}

TEST_CASE(
    "Esc ends the picking, keeps the selection, and a click selects again; so does no surface") {
  CavityStudio studio;
  studio.click("motion/pick_edge");
  studio.click(ScreenPoint(studio.view().viewport().min) + ScreenVector(30, 30));
  CHECK(studio.session().selection().space().pick().has_value());
  CHECK(studio.pivot().from == PivotFrom::centre);
  studio.key(keys::escape);
  CHECK_FALSE(studio.session().selection().space().pick().has_value());
  CHECK_FALSE(studio.session().selection().empty());
  // A drag while one picks turns the view, and picks nothing.
  studio.click("motion/pick_face");
  const ViewDirection before = studio.view().direction();
  const ScreenPoint place = studio.at({0.45, 1.0 / 3, 0.42});
  studio.drag(place, place + ScreenVector(40, 0));
  studio.release();
  CHECK(studio.view().direction() != before);
  CHECK(studio.session().selection().space().pick().has_value());
  CHECK(studio.pivot().from == PivotFrom::centre);
}

TEST_CASE("The menu and a right click offer pivots, and say what they lack") {
  CavityStudio studio;
  CHECK(studio.blocked("pivot").empty());
  const ScreenPoint place = studio.at({0.42, 1.0 / 3, 0.655});
  studio.move(place);
  studio.press(MouseButton::right);
  studio.release(MouseButton::right);
  studio.frames();
  studio.click("menu/place/pivot_edge");
  CHECK(studio.pivot().from == PivotFrom::edge);
  CHECK((studio.session().selection().space().axis() - Vec3(1, 0, 0)).norm() < 1e-12);
  studio.bench->apply(action::SelectMarkers{});
  CHECK(studio.blocked("pivot") == "Select a body or a marker first.");
}

namespace {

/// A long row of sharp edges of a marker, and a place beside it where it is seen.
struct SeenRow {
  ScreenPoint at;
  std::vector<Index> ends;
};
SeenRow find_long_row(Rig& rig, Index marker) {
  PivotPicker picker;
  const Mesh& mesh = rig.mesh();
  const double size =
      space_bounds(mesh.coordinates, mesh.topology->markers().nodes(marker)).size().maxCoeff();
  const View& view = rig.bench->view_control().view();
  for (const Face& face : mesh.topology->markers()[at(marker)].faces) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()], c = face[(k + 2) % face.size()];
      const std::vector<Index> row = picker.straight_row(a, b, rig.session());
      const Coordinates& x = mesh.coordinates;
      if ((x.xyz(row[1]) - x.xyz(row[0])).norm() < 0.7 * size) continue;
      const Vec3 beside = 0.45 * (x.xyz(a) + x.xyz(b)) + 0.1 * x.xyz(c);
      rig.move(view.project(beside).at);
      rig.frames();
      const auto& source = rig.bench->pane().viewport().picker().pivot_source();
      if (source && source->nodes == row) return {view.project(beside).at, row};
    }
  }
  return {};
}

}  // namespace

TEST_CASE("A new user turns the flap of the wing by 10 degrees about its hinge in five clicks") {
  Rig rig(1280, 800);
  rig.bench->apply(action::OpenMesh{assets_folder() / "coarse" / "wing.su2.gz"});
  REQUIRE(rig.settle());
  int clicks = 0;
  const auto click = [&](const auto& what) {
    ++clicks;
    rig.click(what);
  };
  click("marker/flap");
  click("motion/pick_edge");
  const SeenRow row = find_long_row(rig, rig.marker("flap"));
  REQUIRE(row.ends.size() == 2);
  click(row.at);
  const SpacePivot hinge = rig.session().selection().space().source();
  CHECK(hinge.from == PivotFrom::edge);
  CHECK(std::abs(hinge.axis.z()) > 0.9);  // along the span
  click("motion/rotate");
  rig.key(keys::a, {keys::control});
  rig.type("10");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  CHECK(clicks <= 5);
  REQUIRE(rig.document().history().position() == 1);
  const auto& move = std::get<MoveCommand>(rig.document().history().command(1));
  CHECK(move.bodies[0].markers == std::vector<std::string>{"flap"});
  CHECK(move.bodies[0].motion.rotate == 10);
  CHECK(rig.document().history().result(1).inverted == 0);
  CHECK(rig.document().history().result(1).fraction_reached == 1);
  for (const Index node : row.ends)
    CHECK((rig.mesh().coordinates.xyz(node) -
           rig.document().history().state(0).mesh.coordinates.xyz(node))
              .norm() < 1e-12);
}

/// Border lines of surface meshes under the mouse.
namespace {

constexpr Index tube_round = 16, tube_up = 6;

/// A tube, open at both ends.
Mesh tube() {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (Index j = 0; j <= tube_up; ++j)
    for (Index i = 0; i < tube_round; ++i) {
      const double angle = 2 * pi * i / tube_round;
      data.coordinates.push_xyz(Vec3(std::cos(angle), std::sin(angle), 2.0 * j / tube_up));
    }
  const auto id = [](Index i, Index j) { return j * tube_round + i % tube_round; };
  for (Index j = 0; j < tube_up; ++j)
    for (Index i = 0; i < tube_round; ++i) {
      winslow::test::add_triangle(data, id(i, j), id(i + 1, j), id(i, j + 1));
      winslow::test::add_triangle(data, id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
    }
  return make_mesh(data);
}

struct TubeRig : SurfaceRig {
  TubeRig() : SurfaceRig(tube(), 1200, 900) { REQUIRE(mesh().topology->markers().size() == 2); }

  /// The middle of the edge of the lower border that is nearest to the viewer, or farthest.
  Vec3 lower(bool nearest) const {
    const Coordinates& x = session().coordinates();
    Vec3 best(0, 0, 0);
    double depth = nearest ? 1e9 : -1e9;
    for (Index i = 0; i < tube_round; ++i) {
      const Vec3 middle = 0.5 * (x.xyz(i) + x.xyz((i + 1) % tube_round));
      const double its = space().view().project(middle).depth;
      if (nearest ? its >= depth : its <= depth) continue;
      depth = its;
      best = middle;
    }
    return best;
  }
  /// The marker of the lower border.
  Index border() const {
    const Markers& markers = mesh().topology->markers();
    return markers[0].faces.front()[0] < tube_round ? 0 : 1;
  }
  const std::string& name() const {
    return mesh().topology->markers()[static_cast<std::size_t>(border())].name;
  }
  bool selected() const { return session().selection().contains(border()); }
};

}  // namespace

TEST_CASE("a border line is what the mouse is over, on it and beside it, and a click selects it") {
  TubeRig rig;
  const ScreenPoint on = rig.at(rig.lower(true));
  // Below the lower border there is nothing but the line to be meant.
  for (const double beside : {0.0, 5.0, -5.0}) {
    CAPTURE(beside);
    rig.move(on + ScreenVector(0, beside));
    rig.frames();
    CHECK(rig.session().selection().hovered() == std::vector<Index>{rig.border()});
  }
  rig.move(on + ScreenVector(0, 12));
  rig.frames();
  CHECK(rig.session().selection().hovered().empty());
  rig.click(on + ScreenVector(0, 4));
  rig.frames();
  CHECK(rig.selected());
  CHECK_FALSE(rig.state().focus.has_value());
  // Beside the surface a click lets go.
  rig.click(on + ScreenVector(0, 40));
  CHECK_FALSE(rig.selected());
}

TEST_CASE("what can be done with a border is offered by a right click on its line") {
  TubeRig rig;
  rig.move(rig.at(rig.lower(true)));
  rig.press(MouseButton::right);
  rig.release(MouseButton::right);
  rig.frames(3);
  bool offered = false;
  for (const auto& [id, rect] : rig.bench->widgets().all()) offered |= id.starts_with("menu/body/");
  CHECK(offered);
}

TEST_CASE("a border behind the surface is not picked, nor one that the eye hides or the padlock") {
  TubeRig rig;
  rig.click(rig.at(rig.lower(false)));
  rig.frames();
  CHECK_FALSE(rig.selected());
  REQUIRE(rig.state().focus.has_value());
  CHECK(rig.state().focus->kind == MeshItem::Kind::element);
  const ScreenPoint on = rig.at(rig.lower(true));
  rig.click("marker_lock/" + rig.name());
  rig.frames();
  rig.click(on);
  CHECK_FALSE(rig.selected());
  rig.click("marker_lock/" + rig.name());
  rig.frames();
  rig.click(on);
  CHECK(rig.selected());
  rig.click("marker_hide/" + rig.name());
  REQUIRE(rig.settle());
  rig.click(on);
  CHECK_FALSE(rig.selected());
}

}  // namespace winslow::gui::test
