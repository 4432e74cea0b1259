#include <doctest/doctest.h>

#include <algorithm>

#include "core/motion/rigid_motion.h"
#include "core/quality/quality.h"
#include "gui/panels/panels.h"
#include "gui/support/moving_rig.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

void select_flap(Rig& rig) {
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
}

void type_into(Rig& rig, const std::string& field, const std::string& text) {
  rig.click(field);
  rig.key(keys::a, {keys::control});
  rig.type(text);
}

}  // namespace

TEST_CASE("Enter in a field of the motion applies it") {
  Rig rig;
  select_flap(rig);
  type_into(rig, "motion/rotate", "25");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).bodies[0].motion.rotate == 25);
  // Tab applies nothing, and Enter takes both fields.
  type_into(rig, "motion/dx", "0.1");
  rig.key(keys::tab);
  rig.frames(4);
  CHECK(rig.document().history().size() == 2);
  type_into(rig, "motion/dy", "0.2");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 3);
  const auto& move = std::get<MoveCommand>(rig.document().history().command(2));
  CHECK(move.bodies[0].motion.translate == Vec2(0.1, 0.2));
}

TEST_CASE("a motion is drawn as an outline while it is typed") {
  Rig rig;
  select_flap(rig);
  CHECK_FALSE(rig.session().selection().motion_preview());
  type_into(rig, "motion/dx", "0.75");
  rig.frames(2);
  const auto& preview = rig.session().selection().motion_preview();
  REQUIRE(preview.has_value());
  const auto box = [](const auto& edges) {
    double most = -1e9;
    for (const auto& [a, b] : edges) most = std::max({most, a.x(), b.x()});
    return most;
  };
  CHECK(box(preview->outline) == doctest::Approx(0.5 + 0.75));  // the ellipse ends at 0.5
  CHECK(rig.document().history().size() == 1);
  type_into(rig, "motion/dx", "0");
  rig.frames(2);
  CHECK_FALSE(rig.session().selection().motion_preview());
  type_into(rig, "motion/rotate", "10");
  rig.frames(2);
  CHECK(rig.session().selection().motion_preview());
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.session().selection().motion_preview());
}

TEST_CASE("numbers typed while the ring is dragged turn the body by just that") {
  Rig rig;
  select_flap(rig);
  const Gizmo gizmo = rig.gizmo();
  rig.drag(*gizmo.knob, *gizmo.knob + ScreenVector(-9, -5));
  REQUIRE(rig.session().dragging());
  rig.type("30");
  CHECK(rig.session().mesh().live_motion()->rotate == 30);
  rig.move(*gizmo.knob + ScreenVector(-40, -9));  // the mouse no longer counts
  CHECK(rig.session().mesh().live_motion()->rotate == 30);
  rig.key(keys::enter);
  rig.release();
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).bodies[0].motion.rotate == 30);
  CHECK(describe(rig.document().history().command(1)) == "Rotate flap by 30 deg");
}

TEST_CASE("numbers typed while a body is moved are x, Tab, y; Backspace takes them back") {
  Rig rig;
  select_flap(rig);
  const ScreenPoint from = rig.pixel(Vec2(-0.3, 0));  // beside the arrows
  rig.drag(from, from + ScreenVector(14, 0));
  REQUIRE(rig.session().dragging());
  rig.type("0.15");
  rig.key(keys::tab);
  rig.type("-.1");
  CHECK(rig.session().mesh().live_motion()->translate == Vec2(0.15, -0.1));
  for (int k = 0; k < 3; ++k) rig.key(GLFW_KEY_BACKSPACE);
  CHECK(rig.session().mesh().live_motion()->translate == Vec2(0.15, 0));
  rig.key(keys::enter);
  rig.release();
  REQUIRE(rig.settle());
  const auto& move = std::get<MoveCommand>(rig.document().history().command(1));
  CHECK(move.bodies[0].motion.translate == Vec2(0.15, 0));
}

TEST_CASE("a number typed in one frame, with Enter, is the number that counts") {
  Rig rig;
  select_flap(rig);
  const Gizmo gizmo = rig.gizmo();
  rig.drag(*gizmo.knob, *gizmo.knob + ScreenVector(-9, -5));
  for (const char32_t c : U"12.5")
    if (c != 0) rig.input.text(c);
  rig.key(keys::enter);
  rig.release();
  REQUIRE(rig.settle());
  CHECK(std::get<MoveCommand>(rig.document().history().command(1)).bodies[0].motion.rotate == 12.5);
}

TEST_CASE("the panel says which mesh motions keep, and where it came from") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.frames();
  CHECK_FALSE(rig.visible("motion/reference"));  // nothing is selected
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  const auto says = [&](const std::string& text) {
    REQUIRE(rig.settle());
    rig.frames();
    CHECK(rig.visible("motion/reference") == !text.empty());
    CHECK(reference_text(rig.session()) == text);
  };
  const auto move_on = [&] { rig.bench->apply(action::ApplyMotion{{5, Vec2(0, 0), Vec2(0, 0)}}); };
  says("Motions keep the mesh as opened");
  move_on();
  says("Motions keep the mesh as opened");
  rig.bench->apply(action::RunSmooth{});
  says("Motions keep the mesh as smoothed (step 2)");
  for (int k = 0; k < 2; ++k) {
    move_on();
    says("Motions keep the mesh as smoothed (step 2)");
  }
  LayersCommand layers;
  layers.layers.walls = {{{"flap"}, {}}};
  layers.layers.walls[0].spacing.count = 2;
  layers.layers.walls[0].spacing.first = 0.01;
  rig.bench->apply(action::RunCommand{layers});
  says("Motions keep the mesh as the layers left it (step 5)");
  move_on();
  says("Motions keep the mesh as the layers left it (step 5)");
  rig.bench->apply(action::GoToStep{4});
  says("Motions keep the mesh as smoothed (step 2)");
  rig.bench->apply(action::GoToStep{1});
  says("Motions keep the mesh as opened");

  // As far as the targets go by a mesh.
  SmoothOptions options;
  options.targets = TargetBlend::automatically();
  rig.bench->apply(action::EditSmoothOptions{whole(options)});
  says("Targets refer to the mesh as opened");
  options.targets = TargetBlend::regular();
  rig.bench->apply(action::EditSmoothOptions{whole(options)});
  says("");
  options = {};
  options.formulation = Formulation::pointwise;
  rig.bench->apply(action::EditSmoothOptions{whole(options)});
  says("");
  // Of bodies that are listed it is said with nothing selected as well.
  rig.bench->apply(action::EditSmoothOptions{whole(SmoothOptions{})});
  rig.bench->apply(action::PlanBody{{5, Vec2(0, 0), Vec2(0, 0)}});
  rig.bench->apply(action::SelectMarkers{});
  says("Motions keep the mesh as opened");
}

namespace {

void choose(Rig& rig, const std::string& shape) {
  rig.click("motion/keep_outside");
  rig.click("motion/keep_outside/" + shape);
}

const KeepOutside& region(const Rig& rig) {
  return rig.session().solver_settings().smooth_options().keep_outside;
}

/// Interior nodes that are elsewhere than before, of those within that distance of the origin or
/// of those beyond it.
int moved(const Rig& rig, const Coordinates& before, double radius, bool within) {
  int count = 0;
  for (const Index node : rig.mesh().topology->interior_nodes()) {
    const Vec2 at = before.xy(node);
    if ((at.norm() <= radius) == within) count += rig.mesh().coordinates.xy(node) != at;
  }
  return count;
}

}  // namespace

TEST_CASE("a circle is kept around the body by the form") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  CHECK_FALSE(rig.visible("motion/region/keep_outside_radius"));
  choose(rig, "Circle");
  REQUIRE(region(rig).radius);
  rig.fill("motion/region/keep_outside_radius", "1.5");
  REQUIRE(*region(rig).radius == 1.5);
  const Coordinates before = rig.mesh().coordinates;
  turn_flap(rig, 15);
  CHECK(moved(rig, before, 1.5, true) > 20);
  CHECK(moved(rig, before, 1.5, false) == 0);
  // Smoothing in place has no body about which the circle could be.
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  CHECK(rig.document().history().size() == 3);
  CHECK(moved(rig, before, 1.5, false) == 0);

  choose(rig, "Box");
  CHECK_FALSE(region(rig).radius);
  CHECK(region(rig).corner);
  CHECK(rig.visible("motion/region/keep_outside_corner_x"));
  choose(rig, "Nothing");
  CHECK_FALSE(region(rig).given());
  CHECK_FALSE(rig.visible("motion/region/keep_outside_corner_x"));
}

TEST_CASE("the region of one mesh is not that of the next") {
  Rig rig(1280, 1000);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  choose(rig, "Circle");
  REQUIRE(region(rig).given());
  rig.open(ring_mesh(), "other.su2");
  CHECK_FALSE(region(rig).given());
}

namespace {

struct FormStudio : MovingStudio {
  FormStudio() {
    resize(1000, 1300);
    frames();
  }
  void choose(const std::string& shape) {
    click("motion/keep_outside");
    click("motion/keep_outside/" + shape);
    frames();
  }
  const KeepOutside& region() const {
    return session().solver_settings().smooth_options().keep_outside;
  }
  /// Interior nodes beyond a distance from the middle of the body that are elsewhere than before.
  int moved(const Coordinates& before, double radius) const {
    int count = 0;
    for (const Index node : mesh().topology->interior_nodes())
      if ((before.xyz(node) - *region().centre).norm() > radius)
        count += mesh().coordinates.xyz(node) != before.xyz(node);
    return count;
  }
  double worst(Metric metric) const {
    return element_value(mesh(), worst_element(mesh(), metric), metric);
  }
};

}  // namespace

TEST_CASE("In space a sphere or a box about the body is kept by the form, and drawn") {
  FormStudio studio;
  CHECK_FALSE(studio.visible("region"));
  studio.choose("Sphere");
  REQUIRE(studio.region().radius.has_value());
  REQUIRE(studio.region().centre.has_value());
  CHECK(studio.visible("region"));
  const double radius = *studio.region().radius;
  const Coordinates before = studio.mesh().coordinates;
  studio.fill("motion/rotate", "15");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().size() == 2);
  CHECK(studio.moved(before, 0) > 20);
  CHECK(studio.moved(before, radius) == 0);
  studio.check_replay();

  // The third coordinate is typed like the others, and is not lost by the edit.
  studio.fill("motion/region/keep_outside_centre_z", "0.25");
  CHECK(studio.region().centre->z() == 0.25);
  studio.choose("Box");
  CHECK_FALSE(studio.region().radius.has_value());
  REQUIRE(studio.region().corner.has_value());
  CHECK(studio.region().corner->z() < studio.region().opposite->z());
  CHECK(studio.visible("motion/region/keep_outside_opposite_z"));
  studio.choose("Nothing");
  CHECK_FALSE(studio.region().given());
  CHECK_FALSE(studio.visible("region"));
}

TEST_CASE("Limits of the quality of volume elements are set in the panel, and end the motion") {
  FormStudio studio;
  studio.click("motion/limits");
  studio.frames();
  // Those of volume meshes, and no others.
  CHECK(studio.visible("motion/min_quality_smallest_solid_angle/on"));
  CHECK_FALSE(studio.visible("motion/min_quality_smallest_angle/on"));
  const double rest = studio.worst(Metric::smallest_solid_angle);
  studio.fill("motion/rotate", "60");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  const double turned = studio.worst(Metric::smallest_solid_angle);
  REQUIRE(turned < rest);
  studio.key(GLFW_KEY_Z, {keys::control});
  REQUIRE(studio.settle());
  const double limit = 0.5 * (rest + turned);
  studio.click("motion/min_quality_smallest_solid_angle/on");
  studio.frames();
  studio.fill("motion/min_quality_smallest_solid_angle", std::to_string(limit));
  studio.fill("motion/rotate", "60");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  CHECK(studio.worst(Metric::smallest_solid_angle) >= limit - 1e-5);
  REQUIRE(studio.session().messages().banner().has_value());
  CHECK(studio.session().messages().banner()->kind == Banner::Kind::partial_motion);
}

TEST_CASE("The third coordinate of a motion in the history can be changed") {
  FormStudio studio;
  studio.fill("motion/d_z", "0.02");
  studio.click("motion/apply");
  REQUIRE(studio.settle());
  set_view(studio, [](ViewOptions& view) { view.right_panel = true; });
  studio.resize(1400, 1000);
  studio.frames();
  studio.click("tab/history");
  studio.frames();
  studio.click("history/edit");
  studio.frames(3);
  studio.fill("edit/translate_z", "0.03");
  studio.click("edit/run");
  REQUIRE(studio.settle());
  CHECK(studio.last_motion().translate.z() == doctest::Approx(0.03));
}

}  // namespace winslow::gui::test
