#include <doctest/doctest.h>

#include <cmath>

#include "gui/render/space/space_view.h"
#include "gui/render/space/volume_scene.h"
#include "gui/support/pixels.h"
#include "gui/support/space_rig.h"

namespace winslow::gui::test {

namespace {

PictureSpec without_panels() {
  PictureSpec spec;
  spec.panels = false;
  spec.legend = false;
  return spec;
}

}  // namespace

TEST_CASE("two meshes side by side share a view by its divider") {
  const ScreenBox whole{{100, 50}, {500, 250}};
  const SideBySide parts = side_by_side(whole, 0.25);
  CHECK(parts.before.max.x() == doctest::Approx(200));
  CHECK(parts.now.min.x() == doctest::Approx(200));
  CHECK(parts.before.size().y() == doctest::Approx(200));
  const ScreenBox again = whole_of(parts.now, 0.25);
  CHECK(again.min.x() == doctest::Approx(100));
  CHECK(again.max.x() == doctest::Approx(500));
}

TEST_CASE("the ghost of a body that was moved is laid over the mesh now") {
  LookingRig rig;
  CHECK(rig.blocked("ghost").empty());
  rig.turn_cavity(30);
  const Image plain = rig.bench->pictures().picture(without_panels());
  rig.key(GLFW_KEY_G);
  REQUIRE(rig.settle());
  CHECK(rig.options().comparison == Comparison::ghost);
  const Image ghost = rig.bench->pictures().picture(without_panels());
  REQUIRE(ghost.width == plain.width);
  const ScreenPoint end(plain.width, plain.height);
  CHECK(differing(plain, ghost, {0, 0}, end) > 200);
  rig.key(GLFW_KEY_G);
  REQUIRE(rig.settle());
  CHECK(rig.options().comparison == Comparison::none);
  CHECK(differing(plain, rig.bench->pictures().picture(without_panels()), {0, 0}, end) == 0);
}

TEST_CASE("before any change the ghost lies on the body itself") {
  LookingRig rig;
  // Edges alone, so that lines have one colour each.
  rig.key(GLFW_KEY_G);
  REQUIRE(rig.settle());
  const VolumeScenes& scenes = rig.scenes();
  CHECK(scenes.parts.size() == 2);  // the ghost is no part of what is picked
  CHECK(rig.bench->settled());
}

TEST_CASE("where a cut is, the ghost outlines the bodies and not what encloses them") {
  const Mesh mesh = LookingRig::cavity();
  const VolumeBoundary boundary = find_boundary(mesh);
  VolumeLook look;
  look.cuts = {Plane(Vec3(0.5, 0.5, 0.5), Vec3(0.1, 1, 0.2))};
  const SpaceScene scene = build_ghost(mesh, boundary, look, {});
  REQUIRE(scene.lines.size() == 3);
  const auto& ends = scene.lines[2].ends;
  REQUIRE(ends.size() >= 8);
  for (const auto& end : ends) {
    const Vec3 place = scene.origin + Vec3(end.position[0], end.position[1], end.position[2]) -
                       Vec3(0.5, 0.5, 0.5);
    CHECK(std::abs(look.cuts[0].distance(place + Vec3(0.5, 0.5, 0.5))) < 1e-6);
    CHECK(place.cwiseAbs().maxCoeff() == doctest::Approx(1.0 / 6));  // on the hole's walls
  }
}

TEST_CASE("before and after side by side: the view is halved, and both are drawn") {
  LookingRig rig;
  rig.turn_cavity(40);
  rig.key(keys::f);
  const ScreenVector full = rig.space().view().viewport().size();
  const ViewDirection direction = rig.space().view().direction();
  rig.key(GLFW_KEY_G, {keys::shift});
  REQUIRE(rig.settle());
  CHECK(rig.options().comparison == Comparison::split);
  CHECK(rig.space().view().viewport().size().x() == doctest::Approx(full.x() / 2).epsilon(0.01));
  CHECK(rig.space().view().direction() == direction);
  CHECK(rig.visible("splitter/compare"));
  rig.key(keys::f);
  const PictureSpec spec = without_panels();
  const Image picture = rig.bench->pictures().picture(spec);
  const int half = picture.width / 2;
  CHECK(inked(picture, 10, 40, half - 10, picture.height - 40) > 3000);
  CHECK(inked(picture, half + 10, 40, picture.width - 10, picture.height - 40) > 3000);
  // The two halves are pictures of different meshes.
  int other = 0;
  for (int y = 40; y < picture.height - 40; ++y)
    for (int x = 10; x < half - 10; ++x)
      other += picture.pixel(x, y)[0] != picture.pixel(x + half, y)[0] ? 1 : 0;
  CHECK(other > 1000);
}

TEST_CASE("without a change both halves are the same picture") {
  LookingRig rig;
  rig.key(GLFW_KEY_G, {keys::shift});
  REQUIRE(rig.settle());
  set_view(rig, [](ViewOptions& view) { view.space.axes = view.scale_bar = false; });
  const Image picture = rig.bench->pictures().picture(without_panels());
  const int half = picture.width / 2;
  int other = 0, drawn = 0;
  for (int y = 60; y < picture.height - 20; ++y)
    for (int x = 20; x < half - 20; ++x) {
      other += std::abs(picture.pixel(x, y)[0] - picture.pixel(x + half, y)[0]) > 40 ? 1 : 0;
      drawn += picture.pixel(x, y)[0] < 200 ? 1 : 0;
    }
  CHECK(drawn > 500);
  CHECK(other < drawn / 10);
}

TEST_CASE("a drag over the mesh before turns both, and picks nothing") {
  LookingRig rig;
  rig.turn_cavity(20);
  rig.bench->apply(action::SelectMarkers{});
  rig.key(GLFW_KEY_G, {keys::shift});
  REQUIRE(rig.settle());
  const ScreenBox now = rig.space().view().viewport();
  const ScreenPoint left(now.min.x() - now.size().x() / 2, now.centre().y());
  rig.move(left);
  rig.frames();
  CHECK_FALSE(rig.state().seen.has_value());
  const ViewDirection before = rig.space().view().direction();
  rig.drag(left, left + ScreenVector(60, 10));
  rig.release();
  CHECK(rig.space().view().direction().azimuth < before.azimuth);
  rig.click(left);
  CHECK(rig.session().selection().empty());
  // On the other side the mesh is picked as ever.
  rig.move(now.centre());
  rig.frames();
  CHECK(rig.state().seen.has_value());
}

TEST_CASE("the divider is dragged") {
  LookingRig rig;
  rig.key(GLFW_KEY_G, {keys::shift});
  REQUIRE(rig.settle());
  const double width = rig.space().view().viewport().size().x();
  const auto splitter = rig.bench->widgets().find("splitter/compare");
  REQUIRE(splitter.has_value());
  rig.drag(splitter->centre(), splitter->centre() + ScreenVector(80, 0));
  rig.release();
  rig.frames();
  CHECK(rig.options().divider > 0.55);
  CHECK(rig.space().view().viewport().size().x() < width - 40);
}

TEST_CASE("both sides have one scale of colours") {
  LookingRig rig;
  rig.turn_cavity(35);
  rig.key(GLFW_KEY_G, {keys::shift});
  REQUIRE(rig.settle());
  const auto& before = rig.volume().before_scenes();
  REQUIRE(before != nullptr);
  REQUIRE(before->legend.has_value());
  CHECK(before->legend->scale.low == rig.volume().legend()->scale.low);
  CHECK(before->legend->scale.high == rig.volume().legend()->scale.high);
  CHECK(before->of.mesh->coordinates == rig.document().history().state(0).mesh.coordinates);
}

}  // namespace winslow::gui::test
