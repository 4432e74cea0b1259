#include <doctest/doctest.h>

#include <algorithm>

#include "core/quality/quality.h"
#include "gui/support/moving_rig.h"
#include "io/recipe/recipe.h"

namespace winslow::gui::test {

namespace {

/// The nodes of a cavity's front face are edited, which lies at y = 1/3.
struct ShapeStudio : MovingStudio {
  explicit ShapeStudio(double radius = 0.15)
      : MovingStudio(
            make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::tetrahedra)),
            "cavity") {
    set_view(*this, [](ViewOptions& view) {
      view.space.cuts = {CutPlane{{0.5, 0.95, 0.5}, {0, -1, 0}, true}};
    });
    bench->apply(action::HoldCut{});
    bench->apply(action::SelectMarkers{});
    key(keys::e);
    frames();
    REQUIRE(session().selection().shape_edit().active);
    bench->apply(action::SetShapeEdit{true, radius});
    frames();
  }
  const std::optional<SurfacePatch>& patch() const {
    return session().selection().shape_edit().patch;
  }
  Index node_at(const Vec3& place) const {
    for (Index i = 0; i < mesh().coordinates.size(); ++i)
      if ((mesh().coordinates.xyz(i) - place).norm() < 1e-9) return i;
    return -1;
  }
  /// By how much the last command moved a node.
  Vec3 moved(Index node) const {
    const auto& history = document().history();
    return mesh().coordinates.xyz(node) -
           history.state(history.position() - 1).mesh.coordinates.xyz(node);
  }
};

const Vec3 middle(0.5, 1.0 / 3, 0.5);  // of the front face

}  // namespace

TEST_CASE(
    "E edits the nodes of a volume mesh's boundary; a node that is dragged takes others along") {
  ShapeStudio studio(0.2);
  CHECK(studio.blocked("shape_edit").empty());
  const Index node = studio.node_at(middle);
  REQUIRE(node >= 0);
  const ScreenPoint from = studio.at(middle);
  studio.move(from + ScreenVector(2, 1));
  studio.frames();
  CHECK(studio.bench->pane().viewport().picker().held() == std::vector<Index>{node});
  const ViewDirection looked = studio.view().direction();
  studio.drag(from, from + ScreenVector(14, -10));
  CHECK(studio.view().direction() == looked);
  REQUIRE(studio.patch().has_value());
  CHECK(studio.patch()->nodes == std::vector<Index>{node});
  studio.follow();
  CHECK(check_validity(*studio.mesh().topology, studio.session().coordinates()).inverted == 0);
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  CHECK(studio.last_deform().markers == std::vector<std::string>{"cavity"});
  const Vec3 pull = studio.moved(node);
  CHECK(pull.norm() > 0.01);
  CHECK(std::abs(pull.dot(studio.view().back())) < 1e-9);
  CHECK(pull.norm() / studio.view().units_per_pixel() ==
        doctest::Approx(std::hypot(14, 10)).epsilon(0.05));
  // A neighbour a sixth away takes the share of that distance, one beyond the radius none.
  const Index beside = studio.node_at(middle + Vec3(1.0 / 6, 0, 0));
  REQUIRE(beside < 0);  // it has moved
  const Coordinates& rest = studio.document().history().state(0).mesh.coordinates;
  for (const Index i : studio.mesh().topology->markers().nodes(studio.marker("cavity"))) {
    const double distance = (rest.xyz(i) - middle).norm();
    if (i == node || std::abs(rest.xyz(i).y() - middle.y()) > 1e-9) continue;
    if (distance < 0.17)
      CHECK((studio.moved(i) - faded_share(distance, 0.2) * pull).norm() < 1e-9);
    else
      CHECK(studio.moved(i).norm() == 0);
  }
  studio.check_replay();
  studio.key(keys::z, {keys::control});
  REQUIRE(studio.settle());
  CHECK(studio.mesh().coordinates == rest);
}

TEST_CASE("Faces and nodes are held together with Shift, and pushed along their normal") {
  ShapeStudio studio(0);
  studio.click(studio.at(middle + Vec3(0.1, 0, 0.06)));
  REQUIRE(studio.patch().has_value());
  CHECK(studio.patch()->nodes.size() == 3);
  studio.input.key(keys::shift, true);
  studio.click(studio.at(middle + Vec3(-1.0 / 6, 0, 0)) + ScreenVector(2, 0));
  studio.input.key(keys::shift, false);
  studio.frames();
  CHECK(studio.patch()->nodes.size() == 4);
  CHECK(studio.visible("shape/nodes/4"));
  // The normal is that of the face; there are no rings, since parts do not turn.
  CHECK(studio.visible("gizmo/arrow/y"));
  CHECK_FALSE(studio.visible("gizmo/screen_ring"));
  const std::vector<Index> held = studio.patch()->nodes;
  const ScreenPoint from = studio.handle("arrow/y");
  studio.drag(from, from + ScreenVector(1, 1));
  studio.type("-0.03");
  studio.key(keys::enter);
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  for (const Index node : held) CHECK((studio.moved(node) - Vec3(0, -0.03, 0)).norm() < 1e-12);
  std::size_t went = 0;
  for (const Index node : studio.mesh().topology->markers().nodes(studio.marker("cavity")))
    if (studio.moved(node).norm() > 0) ++went;
  CHECK(went == held.size());
  studio.check_replay();
  // It is still held, where it is now.
  CHECK(studio.patch()->nodes == held);
  // A click beside everything lets go; E ends it.
  studio.click(ScreenPoint(studio.view().viewport().min) + ScreenVector(25, 25));
  CHECK_FALSE(studio.patch().has_value());
  studio.key(keys::e);
  CHECK_FALSE(studio.session().selection().shape_edit().active);
}

TEST_CASE(
    "The wheel changes how far a drag of the boundary fades while it goes on; Esc takes it back") {
  ShapeStudio studio(0.1);
  const Coordinates before = studio.mesh().coordinates;
  const ScreenPoint from = studio.at(middle);
  studio.drag(from, from + ScreenVector(8, -6));
  const std::size_t few = studio.session().mesh().work().body_drag()->grip().nodes.size();
  const double unit = studio.view().units_per_pixel();
  studio.wheel(from + ScreenVector(8, -6), 5);
  CHECK(studio.view().units_per_pixel() == unit);
  CHECK(studio.session().selection().shape_edit().radius > 0.2);
  CHECK(studio.session().mesh().work().body_drag()->grip().nodes.size() > few);
  CHECK(studio.session().dragging());
  studio.key(keys::escape);
  studio.release();
  REQUIRE(studio.settle());
  CHECK(studio.session().coordinates() == before);
  CHECK(studio.session().selection().shape_edit().active);
  studio.key(keys::escape);
  CHECK_FALSE(studio.session().selection().shape_edit().active);
}

TEST_CASE("A drag fades over the marker that was taken alone, or over all that are selected") {
  const auto box = [] {
    MeshData data = winslow::test::cube(5, winslow::test::Volumes::tetrahedra);
    return make_mesh(data);
  };
  for (const bool both : {false, true}) {
    CAPTURE(both);
    MovingStudio studio(box(), "lid");
    studio.bench->apply(action::SelectMarkers{
        both ? std::vector<Index>{studio.marker("lid"), studio.marker("walls")}
             : std::vector<Index>{}});
    studio.key(keys::e);
    studio.bench->apply(action::SetShapeEdit{true, 0.3});
    const Vec3 place(0.4, 0, 1);  // on the edge of lid and walls, nearer to the lid for the mouse
    studio.click(studio.at(place + Vec3(0.004, 0.004, 0)));
    const auto& patch = studio.session().selection().shape_edit().patch;
    REQUIRE(patch.has_value());
    CHECK(patch->nodes.size() == 1);
    CHECK(patch->markers.size() == (both ? 2 : 1));
    const DragGrip grip = grip_of(*patch, 0.3, studio.mesh());
    const bool below = std::ranges::any_of(
        grip.nodes, [&](Index node) { return studio.mesh().coordinates.xyz(node).z() < 0.9; });
    CHECK(below == both);
  }
}

TEST_CASE("A sine bends a body of a volume mesh, along the axis that is chosen") {
  MovingStudio studio(
      make_mesh(winslow::test::cube_with_cavity(6, winslow::test::Volumes::tetrahedra)), "cavity");
  CHECK(studio.blocked("deform").empty());
  studio.resize(1200, 1700);  // the panel has room
  studio.frames(4);
  if (!studio.visible("shape/amplitude")) studio.click("section/shape");
  studio.frames(4);
  studio.fill("shape/amplitude", "0.02");
  REQUIRE(studio.session().selection().deformation_preview().has_value());
  const SineDeformation shown = studio.session().selection().deformation_preview()->shape;
  CHECK(shown.along == Vec3(0, 0, 1));
  CHECK_FALSE(studio.session().selection().deformation_preview()->outline.empty());
  studio.click("shape/apply");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  CHECK(studio.last_deform().markers == std::vector<std::string>{"cavity"});
  CHECK(std::get<SineDeformation>(studio.last_deform().shape) == shown);
  studio.check_replay();
}

TEST_CASE("Drags in space go into the recipe, which gives the same mesh without the studio") {
  ShapeStudio studio(0.2);
  const ScreenPoint from = studio.at(middle);
  studio.drag(from, from + ScreenVector(9, -7));
  studio.follow();
  studio.release();
  REQUIRE(studio.settle());
  studio.key(keys::e);
  studio.take("cavity");
  const ScreenPoint ring = studio.handle("screen_ring");
  studio.drag(ring, ring);
  go_around(studio, studio.gizmo().centre, ring, 9, 4);
  studio.follow();
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 2);
  const auto& history = studio.document().history();
  io::Recipe recipe;
  recipe.commands = history.recipe();
  const auto file = studio.folder / "moved.json";
  io::write_recipe(file, recipe);
  const auto replay_apart = [&](std::optional<double> tolerance) {
    MeshState state = history.state(0);
    for (Command command : io::read_recipe(file).commands) {
      CHECK_FALSE(smooth_options(command)->tolerance);  // the studio's default is not pinned
      smooth_options(command)->tolerance = tolerance;
      state = execute(command, state).state;
    }
    double apart = 0;
    for (Index i = 0; i < state.mesh.coordinates.size(); ++i)
      apart = std::max(apart,
                       (state.mesh.coordinates.xyz(i) - studio.mesh().coordinates.xyz(i)).norm());
    return apart;
  };
  CHECK(replay_apart(1e-10) < 1e-6);
  // The recipe itself is solved as any command is, to 1e-4 of the edges around each node.
  CHECK(replay_apart(std::nullopt) < 1e-4);
}

}  // namespace winslow::gui::test
