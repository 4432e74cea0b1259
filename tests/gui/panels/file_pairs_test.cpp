#include <doctest/doctest.h>

#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

const SlideOptions& taken_of(const Rig& rig) { return rig.session().jobs().smooth_options().slide; }

void open_passage(Rig& rig) {
  rig.bench->apply(action::OpenMesh{WINSLOW_TEST_DATA "/periodic_41.msh"});
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
  CHECK(taken_of(rig).file_pairs.wanted);
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
  CHECK_FALSE(taken_of(rig).file_pairs.wanted);
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
  rig.bench->apply(action::OpenMesh{WINSLOW_TEST_DATA "/square_41.msh"});
  REQUIRE(rig.settle());
  rig.frames(3);
  CHECK_FALSE(rig.visible("markers/file_pairs"));
}

}  // namespace winslow::gui::test
