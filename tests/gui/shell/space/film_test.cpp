#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "gui/demos/demo.h"
#include "gui/files/assets.h"
#include "gui/files/thumbnails.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/picture/space/scene_figure.h"
#include "gui/picture/space/volume_picture.h"
#include "gui/support/pixels.h"
#include "gui/support/space_rig.h"
#include "io/format/mesh_file.h"
#include "support/paths.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

std::set<std::string> frames_in(const fs::path& folder) {
  std::set<std::string> names;
  if (!fs::is_directory(folder)) return names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

std::string bytes_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

RecordingSpec small_turn(int frames) {
  RecordingSpec spec;
  spec.when = RecordingSpec::When::turntable;
  spec.rate = 10;
  spec.turn_seconds = frames / 10.0;
  spec.picture.panels = false;
  spec.picture.size = {{240, 180}};
  return spec;
}

SeenPolygon square(double x, double y, double side, double z) {
  return {{{x, y, z}, {x + side, y, z}, {x + side, y + side, z}, {x, y + side, z}}, false};
}

}  // namespace

TEST_CASE("a film of a turn has as many frames as it says, each from elsewhere") {
  LookingRig rig;
  const ViewDirection before = rig.space().view().direction();
  rig.bench->apply(action::SetRecordingSpec{small_turn(4)});
  rig.bench->apply(action::StartRecording{rig.folder / "turn", {}, true});
  REQUIRE(rig.settle());
  CHECK(rig.bench->capture().recorder().state() == Recorder::State::idle);
  CHECK(frames_in(rig.folder / "turn") ==
        std::set<std::string>{"frame-00001.png", "frame-00002.png", "frame-00003.png",
                              "frame-00004.png"});
  const Image first = read_png(rig.folder / "turn" / "frame-00001.png");
  const Image third = read_png(rig.folder / "turn" / "frame-00003.png");
  CHECK(first.width == 240);
  CHECK(differing(first, third, {0, 0}, {240, 180}) > 500);
  // The user's own view stays.
  CHECK(rig.space().view().direction() == before);
  // The first frame is what is seen now.
  PictureSpec spec = small_turn(4).picture;
  CHECK(differing(first, rig.bench->pictures().picture(spec), {0, 0}, {240, 180}) == 0);
}

TEST_CASE("the dialog offers a turn for volume meshes alone") {
  LookingRig rig;
  rig.click("tool/record");
  rig.frames();
  rig.click("record/when");
  rig.frames();
  REQUIRE(rig.visible("record/when/While the view turns once"));
  rig.click("record/when/While the view turns once");
  rig.frames();
  CHECK(rig.visible("record/seconds"));
  Rig plane;
  plane.open(two_body_mesh());
  plane.bench->apply(action::SetRecordingSpec{small_turn(4)});
  plane.bench->apply(action::StartRecording{plane.folder / "turn", {}, true});
  REQUIRE(plane.settle());
  CHECK(frames_in(plane.folder / "turn").empty());
}

TEST_CASE("the motion of a body in a volume mesh is recorded") {
  LookingRig rig;
  RecordingSpec spec;
  spec.picture.panels = false;
  spec.picture.size = {{200, 150}};
  rig.bench->apply(action::SetRecordingSpec{spec});
  rig.bench->apply(action::StartRecording{rig.folder / "motion", {}, true});
  rig.frames();
  rig.turn_cavity(6);
  rig.bench->apply(action::StopRecording{});
  REQUIRE(rig.settle());
  const auto names = frames_in(rig.folder / "motion");
  REQUIRE(names.size() >= 2);
  const Image first = read_png(rig.folder / "motion" / *names.begin());
  const Image last = read_png(rig.folder / "motion" / *names.rbegin());
  CHECK(differing(first, last, {0, 0}, {200, 150}) > 20);
}

TEST_CASE("what lies behind is left out, and covers are drawn after what they cover") {
  const std::vector<SeenPolygon> polygons{square(10, 10, 20, 1), square(12, 12, 6, 5),
                                          square(25, 25, 20, 3)};
  const HiddenSurface hidden(60, 60, polygons);
  const auto order = hidden.order();
  CHECK(order == std::vector<std::size_t>{2, 0});
  const auto parts = hidden.seen_parts({0, 20, 2}, {60, 20, 2}, 0.01);
  REQUIRE(parts.size() == 2);  // behind the first square in between
  CHECK(parts[0][1] == doctest::Approx(10.0 / 60).epsilon(0.05));
  CHECK(parts[1][0] == doctest::Approx(30.0 / 60).epsilon(0.05));
}

TEST_CASE("a long face that is nearer in its middle alone is still ordered by what it covers") {
  // The mean depth of the long one is the larger one.
  const std::vector<SeenPolygon> polygons{
      {{{0, 0, 0}, {100, 0, 100}, {100, 10, 100}, {0, 10, 0}}, false}, square(5, 2, 5, 20)};
  CHECK(HiddenSurface(120, 20, polygons).order() == std::vector<std::size_t>{0});
  const std::vector<SeenPolygon> wider{polygons[0], square(5, 2, 15, 20)};
  CHECK(HiddenSurface(120, 20, wider).order() == std::vector<std::size_t>{1, 0});
}

TEST_CASE("a mesh that covers the page a hundred times is a raster, of fewer pixels") {
  const Mesh mesh = LookingRig::cavity();
  Mesh tangled = mesh;
  // Each node inside changes its place with another one.
  const auto inside = tangled.topology->interior_nodes();
  for (std::size_t k = 0; 2 * k + 1 < inside.size(); ++k) {
    const Index other = inside[inside.size() - 1 - k];
    tangled.coordinates.set_xyz(inside[k], mesh.coordinates.xyz(other));
    tangled.coordinates.set_xyz(other, mesh.coordinates.xyz(inside[k]));
  }
  VolumePictureOptions options;
  options.width = 200;
  options.height = 150;
  const VectorFigure sound = volume_picture_figure(mesh, options);
  CHECK_FALSE(sound.scene->wants_raster);
  const VectorFigure piled = volume_picture_figure(tangled, options);
  CHECK(piled.scene->wants_raster);
  CHECK(piled.scene->raster_pixels == 1);
  REQUIRE(piled.scene->raster.has_value());
  CHECK(piled.scene->polygons.empty());
  CHECK(piled.scene->raster->width <= options.width);
}

TEST_CASE("a volume mesh is saved as vector graphics, with its legend") {
  LookingRig rig;
  const VectorFigure figure = rig.bench->pictures().figure(true);
  REQUIRE(figure.scene != nullptr);
  CHECK_FALSE(figure.scene->raster.has_value());
  CHECK(figure.scene->polygons.size() > 50);
  CHECK(figure.scene->lines.size() > 100);
  CHECK(figure.legend.has_value());
  std::size_t triangles = 0;
  for (const auto& part : rig.scenes().parts)
    for (const SpaceFill& fill : part->fills) triangles += fill.elements.size();
  CHECK(figure.scene->polygons.size() < triangles);
  write_figure(rig.folder / "cut.svg", figure);
  write_figure(rig.folder / "cut.pdf", figure);
  const std::string svg = bytes_in(rig.folder / "cut.svg");
  CHECK(svg.find("<image") == std::string::npos);
  CHECK(svg.find("mesh.su2") != std::string::npos);
  CHECK(bytes_in(rig.folder / "cut.pdf").starts_with("%PDF"));
}

TEST_CASE("a figure from the command line is a raster where too much is seen") {
  const Mesh mesh = LookingRig::cavity();
  VolumePictureOptions options;
  options.width = 400;
  options.height = 300;
  const VectorFigure figure = volume_picture_figure(mesh, options);
  CHECK_FALSE(figure.scene->wants_raster);
  CHECK(figure.note.starts_with("Cut at"));
  CHECK(figure.scene->polygons.size() > 50);
  FigureScene pixels;
  pixels.raster = Image{2, 2, std::vector<std::uint8_t>(16, 128)};
  VectorFigure drawn;
  drawn.camera.set_viewport(0, 0, 100, 80);
  drawn.scene = std::make_shared<const FigureScene>(pixels);
  const TemporaryFolder folder;
  write_figure(folder.path() / "raster.svg", drawn);
  CHECK(bytes_in(folder.path() / "raster.svg").find("<image") != std::string::npos);
}

TEST_CASE("volume meshes have small pictures") {
  Rig rig(400, 300);
  const Mesh mesh = io::read_mesh(bundled_path(assets_folder(), "sphere.su2.gz")).mesh;
  const Image picture = Thumbnails::draw(mesh);
  CHECK(picture.width == Thumbnails::width);
  CHECK(inked(picture, 0, 0, picture.width, picture.height) > 5000);
}

TEST_CASE(
    "the file dialog shows a picture of the volume mesh that is chosen, and of no other file") {
  LookingRig rig;
  std::ofstream(rig.folder / "notes.su2") << "no mesh\n";
  rig.bench->apply(action::ShowFileDialog{FilePurpose::open_mesh});
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.visible("dialog/preview"));
  rig.fill("dialog/folder", rig.folder.path().string());
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  rig.click("dialog/entry/mesh.su2");
  REQUIRE(rig.settle());
  rig.frames();
  CHECK(rig.visible("dialog/preview"));
  rig.click("dialog/entry/notes.su2");
  REQUIRE(rig.settle());
  rig.frames();
  CHECK_FALSE(rig.visible("dialog/preview"));
}

TEST_CASE("a step of a demo shows a volume mesh as it says") {
  WorkbenchOptions options;
  Rig rig(1100, 700);
  options.demo_meshes = winslow::test::assets("coarse");
  rig.bench = std::make_unique<Workbench>(options);
  rig.bench->apply(action::StartDemo{"J"});
  REQUIRE(rig.wait([&] { return rig.bench->demo().ready(rig.session()); }));
  rig.frames();
  const DemoStep& step = find_demo("J")->steps.front();
  const ViewOptions& view = rig.bench->view_control().options();
  CHECK(view.space.cuts == step.space->cuts);
  CHECK(view.space.up == 1);
  CHECK(rig.bench->view_control().space().view().direction().azimuth ==
        doctest::Approx(step.space->azimuth));
  rig.click("demo/next");
  rig.frames();
  const double near = rig.bench->view_control().space().view().units_per_pixel();
  rig.click("demo/back");
  rig.frames();
  CHECK(rig.session().selection().contains(rig.marker("flap")));
  CHECK(near > 0);
}

}  // namespace winslow::gui::test
