#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/moving_rig.h"
#include "gui/support/space_rig.h"
#include "io/format/mesh_file.h"
#include "io/recipe/recipe.h"

/// The row "Reference surface" below the list of markers.
namespace winslow::gui::test {
namespace {

const SlideOptions& chosen_slide(const Rig& rig) {
  return rig.session().solver_settings().smooth_options().slide;
}

Mesh scaled(Mesh mesh, double size, const Vec3& about) {
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    mesh.coordinates.set_xyz(i, about + size * (mesh.coordinates.xyz(i) - about));
  return mesh;
}

/// A ball whose radius is 1, finer than that of the studio.
std::filesystem::path write_ball(const Rig& rig, const std::string& name, double radius) {
  const Mesh ball = scaled(make_mesh(winslow::test::octasphere(12)), radius, Vec3(0, 0, 0));
  io::write_mesh(rig.folder / name, ball, nullptr);
  return rig.folder / name;
}

/// By the button of the row, and the name typed into the dialog.
void choose_reference(Rig& rig, const std::string& name) {
  rig.click("markers/reference");
  REQUIRE(rig.wait([&] {
    const FileDialog& dialog = rig.bench->dialogs().file_dialog();
    return dialog.is_open() && !dialog.busy();
  }));
  rig.type(name);
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  rig.frames();
}

void run_smooth(Rig& rig) {
  rig.click("tool/run");
  REQUIRE(rig.settle());
}

/// Least and largest distance of the nodes from the origin.
std::pair<double, double> radii(const Rig& rig) {
  double least = 1e9, largest = 0;
  const SpacePoints x(rig.mesh().coordinates);
  for (Index node = 0; node < rig.mesh().coordinates.size(); ++node) {
    least = std::min(least, x[node].norm());
    largest = std::max(largest, x[node].norm());
  }
  return {least, largest};
}

void check_radius(const Rig& rig, double radius) {
  const auto [least, largest] = radii(rig);
  CHECK(least == doctest::Approx(radius).epsilon(1e-9));
  CHECK(largest == doctest::Approx(radius).epsilon(1e-9));
}

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE(
    "a surface mesh slides on a file that is chosen by its row, undone, redone and let go of") {
  SurfaceRig rig;
  const auto file = write_ball(rig, "fine.obj", 1.1);
  CHECK_FALSE(rig.visible("markers/reference_none"));
  choose_reference(rig, "fine.obj");
  CHECK(chosen_slide(rig).reference == file.string());
  REQUIRE(rig.session().messages().notice().has_value());
  CHECK(rig.session().messages().notice()->text ==
        "Nodes slide on fine.obj: 578 nodes, 1,152 faces");
  CHECK(rig.document().history().size() == 1);  // nothing is done to the mesh yet
  run_smooth(rig);
  check_radius(rig, 1.1);
  rig.key(keys::z, {keys::control});
  CHECK(radii(rig).second == doctest::Approx(1));
  rig.key(keys::z, {keys::control, keys::shift});
  check_radius(rig, 1.1);
  // In a recipe the file is named from its folder, and the recipe does the same again.
  rig.bench->apply(action::ExportRecipe{rig.folder / "recipe.json"});
  REQUIRE(rig.settle());
  CHECK(content_of(rig.folder / "recipe.json").find("\"reference\": \"fine.obj\"") !=
        std::string::npos);
  rig.bench->apply(action::GoToStep{0});
  rig.bench->apply(action::ReplayRecipe{rig.folder / "recipe.json"});
  REQUIRE(rig.settle());
  check_radius(rig, 1.1);
  rig.click("markers/reference_none");
  CHECK(chosen_slide(rig).reference.empty());
  CHECK_FALSE(rig.visible("markers/reference_none"));
  run_smooth(rig);
  check_radius(rig, 1);
}

TEST_CASE(
    "a reference surface that cannot be read is refused with its line, and the last one stays") {
  SurfaceRig rig;
  const auto file = write_ball(rig, "fine.obj", 1.1);
  choose_reference(rig, "fine.obj");
  std::ofstream(rig.folder / "bad.obj") << "v 0 0 0\nv 1 0 0\nv x 0 1\nf 1 2 3\n";
  choose_reference(rig, "bad.obj");
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->title ==
        "bad.obj cannot be used as a reference surface");
  CHECK(rig.session().messages().prompt()->text.find("bad.obj:3") != std::string::npos);
  CHECK(chosen_slide(rig).reference == file.string());
  CHECK(rig.session().solver_settings().reading_reference().empty());
  rig.key(keys::enter);
  rig.frames();
  run_smooth(rig);
  check_radius(rig, 1.1);
}

TEST_CASE("a reference surface that is coarser than the mesh is taken with a warning") {
  SurfaceRig rig;
  const Mesh coarse = make_mesh(winslow::test::octasphere(2));
  io::write_mesh(rig.folder / "coarse.obj", coarse, nullptr);
  choose_reference(rig, "coarse.obj");
  CHECK(chosen_slide(rig).reference == (rig.folder / "coarse.obj").string());
  REQUIRE(rig.session().messages().notice().has_value());
  CHECK(rig.session().messages().notice()->kind == Notice::Kind::warning);
  CHECK(rig.session().messages().notice()->text.find("times as long as") != std::string::npos);
}

TEST_CASE("the file that is chosen last counts, however long the one before takes") {
  SurfaceRig rig;
  write_ball(rig, "first.obj", 1.1);
  const auto second = write_ball(rig, "second.obj", 1.2);
  rig.bench->apply(action::ChooseReference{rig.folder / "first.obj"});
  rig.bench->apply(action::ChooseReference{second});
  CHECK(rig.session().solver_settings().reading_reference() == second);
  REQUIRE(rig.settle());
  CHECK(chosen_slide(rig).reference == second.string());
  // None is wanted while one is being read.
  rig.bench->apply(action::ChooseReference{rig.folder / "first.obj"});
  rig.bench->apply(action::ChooseReference{});
  REQUIRE(rig.settle());
  CHECK(chosen_slide(rig).reference.empty());
}

TEST_CASE("in a volume mesh the row is there while a marker slides, and runs without do without") {
  using winslow::test::Volumes;
  SpaceRig rig(1280, 1000);
  rig.open(make_mesh(winslow::test::cube(3, Volumes::tetrahedra)));
  const Mesh lid =
      scaled(make_mesh(winslow::test::skin(winslow::test::cube(4, Volumes::hexahedra))), 1.02,
             Vec3::Constant(0.5));
  io::write_mesh(rig.folder / "box.obj", lid, nullptr);
  CHECK_FALSE(rig.visible("markers/reference"));
  rig.click("marker_role/lid");
  rig.frames();
  REQUIRE(rig.visible("markers/reference"));
  choose_reference(rig, "box.obj");
  run_smooth(rig);
  const auto lids = [&] {
    double highest = 0;
    for (Index i = 0; i < rig.mesh().coordinates.size(); ++i)
      highest = std::max(highest, rig.mesh().coordinates.xyz(i).z());
    return highest;
  };
  CHECK(lids() == doctest::Approx(1.01).epsilon(1e-9));
  rig.click("marker_role/lid");
  rig.frames();
  CHECK_FALSE(rig.visible("markers/reference"));
  rig.bench->apply(action::GoToStep{0});
  run_smooth(rig);
  REQUIRE(rig.document().history().position() == 1);
  CHECK(lids() == doctest::Approx(1));
  CHECK(rig.session().messages().prompt() == nullptr);
  rig.click("marker_role/lid");
  rig.frames();
  CHECK(chosen_slide(rig).reference == (rig.folder / "box.obj").string());
}

TEST_CASE("a step of the history is given a reference surface in its editor, and loses it there") {
  SurfaceRig rig;
  const auto file = write_ball(rig, "fine.obj", 1.1);
  run_smooth(rig);
  check_radius(rig, 1);
  const auto edit = [&] {
    rig.bench->apply(action::ShowStepEditor{1});
    rig.frames(3);
    REQUIRE(rig.visible("edit/reference"));
  };
  const auto dialog_is_up = [&] {
    const FileDialog& dialog = rig.bench->dialogs().file_dialog();
    return dialog.is_open() && !dialog.busy();
  };
  edit();
  CHECK_FALSE(rig.visible("edit/reference_none"));
  // Esc in the dialog of files leads back to the step, as it was.
  rig.click("edit/reference");
  REQUIRE(rig.wait(dialog_is_up));
  CHECK_FALSE(rig.visible("edit/run"));
  rig.key(keys::escape);
  rig.frames(4);
  REQUIRE(rig.visible("edit/run"));
  CHECK_FALSE(rig.visible("edit/reference_none"));
  rig.click("edit/reference");
  REQUIRE(rig.wait(dialog_is_up));
  rig.type("fine.obj");
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  rig.frames(4);
  REQUIRE(rig.visible("edit/reference_none"));
  CHECK(chosen_slide(rig).reference.empty());  // of the step alone
  rig.click("edit/run");
  REQUIRE(rig.settle());
  check_radius(rig, 1.1);
  CHECK(std::get<SmoothCommand>(rig.document().history().command(1)).smooth.slide.reference ==
        file.string());
  edit();
  rig.click("edit/reference_none");
  rig.frames(2);
  rig.click("edit/run");
  REQUIRE(rig.settle());
  check_radius(rig, 1);
}

TEST_CASE("a plane mesh has no reference surface, and another mesh starts without") {
  SurfaceRig rig;
  write_ball(rig, "fine.obj", 1.1);
  choose_reference(rig, "fine.obj");
  rig.open(ring_mesh(), "plane.su2");
  CHECK(chosen_slide(rig).reference.empty());
  rig.click("marker_role/farfield");
  rig.frames();
  CHECK(rig.visible("markers/feature_angle"));
  CHECK_FALSE(rig.visible("markers/reference"));
}

TEST_CASE("a body is dragged in a mesh whose outside slides on a file, and is let go of there") {
  using winslow::test::Volumes;
  MovingStudio studio(make_mesh(winslow::test::cube_with_cavity(6, Volumes::tetrahedra)), "cavity");
  const Mesh box =
      scaled(make_mesh(winslow::test::skin(winslow::test::cube(4, Volumes::hexahedra))), 1.02,
             Vec3::Constant(0.5));
  io::write_mesh(studio.folder / "box.obj", box, nullptr);
  studio.click("marker_role/outer");
  studio.frames();
  choose_reference(studio, "box.obj");
  const auto farthest = [&](const Coordinates& x) {
    double out = 0;
    for (Index i = 0; i < x.size(); ++i)
      out = std::max(out, (x.xyz(i) - Vec3::Constant(0.5)).cwiseAbs().maxCoeff());
    return out;
  };
  const ScreenPoint from = studio.handle("arrow/x");
  studio.drag(from, from + ScreenVector(18, 10));
  studio.follow();
  const BodyDrag& drag = *studio.session().mesh().work().body_drag();
  CHECK(drag.error() == "");
  CHECK(drag.reach() == BodyDrag::Reach::there);
  const Coordinates shown = studio.session().coordinates();
  CHECK(farthest(shown) == doctest::Approx(0.51).epsilon(1e-9));
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.document().history().position() == 1);
  const auto& done = std::get<MoveCommand>(studio.document().history().command(1));
  CHECK(done.smooth.slide.reference == (studio.folder / "box.obj").string());
  CHECK(studio.last_motion().translate.norm() > 0.01);
  CHECK(winslow::test::largest_difference(studio.mesh().coordinates, shown) < 1e-7);
}

TEST_CASE("a drag whose reference surface has gone says so when the body is let go of") {
  using winslow::test::Volumes;
  MovingStudio studio(make_mesh(winslow::test::cube_with_cavity(6, Volumes::tetrahedra)), "cavity");
  const Mesh box = make_mesh(winslow::test::skin(winslow::test::cube(4, Volumes::hexahedra)));
  io::write_mesh(studio.folder / "box.obj", box, nullptr);
  studio.click("marker_role/outer");
  studio.frames();
  choose_reference(studio, "box.obj");
  std::filesystem::remove(studio.folder / "box.obj");
  const Coordinates before = studio.mesh().coordinates;
  const ScreenPoint from = studio.handle("arrow/x");
  studio.drag(from, from + ScreenVector(18, 10));
  REQUIRE(
      studio.wait([&] { return !studio.session().mesh().work().body_drag()->error().empty(); }));
  studio.release();
  REQUIRE(studio.settle());
  REQUIRE(studio.session().messages().prompt() != nullptr);
  CHECK(studio.session().messages().prompt()->text.find("box.obj") != std::string::npos);
  CHECK(studio.mesh().coordinates == before);
  CHECK(studio.document().history().size() == 1);
}

}  // namespace winslow::gui::test
