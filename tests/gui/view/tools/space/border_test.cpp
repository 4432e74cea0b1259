#include <doctest/doctest.h>

#include <cmath>

#include "gui/support/surface_rig.h"

/// Border lines of surface meshes under the mouse.
namespace winslow::gui::test {
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
