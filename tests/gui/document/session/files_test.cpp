#include <doctest/doctest.h>

#include <fstream>

#include "core/error.h"
#include "gui/files/assets.h"
#include "gui/files/file_kinds.h"
#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/shell/headless/headless_studio.h"
#include "gui/shell/studio.h"
#include "gui/support/rig.h"
#include "io/format/mesh_file.h"
#include "io/recipe/recipe.h"

namespace winslow::gui::test {

namespace fs = std::filesystem;

namespace {

void move_flap(Rig& rig) {
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  REQUIRE(rig.settle());
}

void choose(Rig& rig, const std::string& choice) {
  rig.frames();
  REQUIRE(rig.visible("prompt/" + choice));
  rig.click("prompt/" + choice);
  REQUIRE(rig.settle());
}

}  // namespace

TEST_CASE("the open dialog lists meshes alone and opens the one chosen") {
  Rig rig;
  const auto path = write(rig.folder, ring_mesh(), "chosen.su2");
  std::ofstream(rig.folder / "notes.txt") << "not a mesh\n";
  fs::create_directory(rig.folder / "inner");
  rig.key(keys::o, {keys::control});
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.fill("dialog/folder", rig.folder.path().string());
  rig.click("dialog/folder");
  rig.key(keys::enter);
  CHECK(rig.wait([&] { return rig.visible("dialog/entry/chosen.su2"); }));
  CHECK(rig.visible("dialog/entry/inner"));
  CHECK_FALSE(rig.visible("dialog/entry/notes.txt"));
  rig.click("dialog/entry/chosen.su2");
  rig.click("dialog/accept");
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().path() == path);
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
}

TEST_CASE("a file dropped on the window is opened") {
  Rig rig;
  const auto path = write(rig.folder, two_body_mesh());
  rig.input.drop({path});
  rig.frames();
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().topology()->markers().find("left").has_value());
}

TEST_CASE("every answer of a prompt is within a small window, at a large scale, too") {
  constexpr int width = 360, height = 270;
  Rig rig(width, height);
  rig.bench->set_scale(3);  // more than fits: the studio takes its smallest
  rig.open(ring_mesh());
  move_flap(rig);
  const auto within = [&] {
    rig.frames(4);
    REQUIRE(rig.session().messages().prompt() != nullptr);
    for (const auto& choice : rig.session().messages().prompt()->choices) {
      CAPTURE(choice.label);
      const auto button = rig.bench->widgets().find("prompt/" + choice.label);
      REQUIRE(button.has_value());
      CHECK((button->min.x() >= 0 && button->min.y() >= 0));
      CHECK((button->max.x() <= width && button->max.y() <= height));
    }
  };
  rig.bench->apply(action::CloseMesh{});
  within();
  CHECK(rig.session().messages().prompt()->choices.size() > 1);
  choose(rig, "Cancel");
  // More text than there is room for: it scrolls, the answer stays.
  std::string text;
  for (int i = 0; i < 200; ++i) text += "line " + std::to_string(i) + " of a long list ";
  const auto deep = rig.folder / (std::string(120, 'x') + ".su2");
  std::ofstream(deep) << text;
  rig.input.drop({deep});
  rig.frames();
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  within();
  while (rig.session().messages().prompt()->choices.size() > 1) {
    rig.click("prompt/" + rig.session().messages().prompt()->choices.front().label);
    REQUIRE(rig.wait(
        [&] { return rig.session().messages().prompt() && !rig.session().files().loading(); }));
    within();
  }
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
  rig.click("prompt/OK");
  CHECK(rig.session().messages().prompt() == nullptr);
}

TEST_CASE("a failed load says why and keeps the open mesh") {
  Rig rig;
  rig.open(ring_mesh());
  const auto broken = rig.folder / "broken.su2";
  std::ofstream(broken) << "NDIME= 2\nNELEM= 1\n5 0 1 99\nNPOIN= 1\n0 0\n";
  rig.input.drop({broken});
  rig.frames();
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
  CHECK(rig.session().messages().prompt()->text.find("broken.su2") != std::string::npos);
  choose(rig, "OK");
  CHECK(rig.document().name() == "mesh.su2");
  move_flap(rig);
  CHECK(rig.document().history().size() == 2);
}

TEST_CASE("opening another mesh asks before changes are lost") {
  Rig rig;
  rig.open(ring_mesh());
  move_flap(rig);
  const auto other = write(rig.folder, two_body_mesh(), "other.su2");
  rig.input.drop({other});
  rig.frames();
  REQUIRE(rig.session().messages().prompt() != nullptr);
  choose(rig, "Cancel");
  CHECK(rig.document().name() == "mesh.su2");
  rig.input.drop({other});
  rig.frames();
  choose(rig, "Don't save");
  CHECK(rig.document().name() == "other.su2");
}

TEST_CASE("saving writes the moved mesh with its markers, asking before it replaces a file") {
  Rig rig;
  rig.open(ring_mesh());
  const Mesh original = rig.mesh();
  const auto path = rig.document().path();
  move_flap(rig);
  CHECK(rig.document().modified());
  CHECK(rig.bench->title().starts_with("* "));
  rig.key(keys::s, {keys::control});
  REQUIRE(rig.session().messages().prompt() != nullptr);
  choose(rig, "Cancel");
  CHECK(io::read_mesh(path).mesh.coordinates == original.coordinates);
  rig.key(keys::s, {keys::control});
  choose(rig, "Replace");
  const Mesh saved = io::read_mesh(path).mesh;
  CHECK(saved.coordinates == rig.mesh().coordinates);
  CHECK(saved.topology->markers()[0].name == original.topology->markers()[0].name);
  CHECK_FALSE(rig.document().modified());
  // Its own file it may replace from now on.
  rig.bench->apply(action::Undo{});
  rig.key(keys::s, {keys::control});
  REQUIRE(rig.settle());
  CHECK(rig.session().messages().prompt() == nullptr);
  CHECK(io::read_mesh(path).mesh.coordinates == original.coordinates);
}

TEST_CASE("save as goes through the dialog into another format") {
  Rig rig;
  rig.open(ring_mesh());
  rig.key(keys::s, {keys::control, keys::shift});
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.frames(3);
  rig.fill("dialog/name", "copy.xyz");
  rig.click("dialog/accept");
  CHECK(rig.bench->dialogs().file_dialog().is_open());  // no format of ours
  rig.frames(2);
  const auto error = rig.bench->widgets().find("dialog/error");
  REQUIRE(error.has_value());
  CHECK(error->max.y() <= rig.bench->widgets().find("dialog/accept")->min.y());
  rig.fill("dialog/name", "copy.msh");
  rig.click("dialog/accept");
  REQUIRE(rig.settle());
  const Mesh saved = io::read_mesh(rig.folder / "copy.msh").mesh;
  CHECK(saved.coordinates == rig.mesh().coordinates);
  CHECK(saved.topology->markers().find("flap").has_value());
  CHECK(rig.document().name() == "copy.msh");
}

TEST_CASE("a mesh with inverted elements is saved only when that is confirmed") {
  Rig rig;
  rig.open(tangled_mesh());
  const auto target = rig.folder / "bad.su2";
  rig.bench->apply(action::SaveMesh{target});
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->text.find("inverted") != std::string::npos);
  choose(rig, "Cancel");
  CHECK_FALSE(fs::exists(target));
  rig.bench->apply(action::SaveMesh{target});
  choose(rig, "Save it anyway");
  CHECK(fs::exists(target));
}

TEST_CASE("a file that cannot be written is reported and the mesh stays changed") {
  Rig rig;
  rig.open(ring_mesh());
  move_flap(rig);
  rig.bench->apply(action::SaveMesh{rig.folder / "no" / "such" / "folder.su2"});
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
  CHECK(rig.document().modified());
}

TEST_CASE("the exported recipe holds the commands of the session") {
  Rig rig;
  rig.open(ring_mesh());
  move_flap(rig);
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  const auto path = rig.folder / "session.json";
  rig.bench->apply(action::ExportRecipe{path});
  const io::Recipe recipe = io::read_recipe(path);
  REQUIRE(recipe.commands.size() == 2);
  CHECK(recipe.input == "mesh.su2");
  CHECK(std::get<MoveCommand>(recipe.commands[0]).bodies[0].motion.translate == Vec2(0.2, 0));
  CHECK(std::holds_alternative<SmoothCommand>(recipe.commands[1]));
}

TEST_CASE("quitting asks when there is something to lose") {
  Rig rig;
  rig.open(ring_mesh());
  move_flap(rig);
  rig.key(keys::q, {keys::control});
  CHECK_FALSE(rig.session().files().quit_accepted());
  choose(rig, "Cancel");
  CHECK_FALSE(rig.session().files().quit_accepted());
  rig.key(keys::q, {keys::control});
  choose(rig, "Don't save");
  CHECK(rig.session().files().quit_accepted());
}

TEST_CASE("a picture is written, and not over another without asking") {
  Rig rig(640, 480);
  rig.open(ring_mesh());
  const auto path = rig.folder / "shot.png";
  rig.bench->apply(action::TakeScreenshot{path});
  REQUIRE(rig.settle());
  REQUIRE(fs::exists(path));
  CHECK(fs::file_size(path) > 1000);
  rig.bench->apply(action::TakeScreenshot{path});
  rig.frames();
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::question);
}

TEST_CASE("the studio draws itself without a display") {
  TemporaryFolder folder;
  const auto mesh = write(folder, ring_mesh());
  const auto png = folder / "studio.png";
  HeadlessOptions options;
  options.mesh = mesh;
  options.picture = png;
  options.width = 640;
  options.height = 480;
  run_headless(options);
  CHECK(fs::file_size(png) > 1000);
  options.mesh = folder / "none.su2";
  CHECK_THROWS_AS(run_headless(options), InputError);
}

TEST_CASE("without a display the window says what to do instead") {
  const char* display = std::getenv("DISPLAY");
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  if ((display && *display) || (wayland && *wayland)) return;
  std::string message;
  try {
    run_studio({});
  } catch (const Error& error) {
    message = error.what();
  }
  CHECK(message.find("winslow studio --screenshot") != std::string::npos);
  CHECK(message.find("winslow render") != std::string::npos);
}

TEST_CASE("a copy in every format reads back as the open mesh, which stays where it was") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  REQUIRE(rig.settle());
  const auto formats = dialog_of(FilePurpose::export_mesh).kinds[0].extensions;
  CHECK(formats.size() >= 8);
  for (const std::string& extension : formats) {
    INFO("format ", extension);
    const auto path = rig.folder / ("copy" + extension);
    rig.bench->apply(action::ExportMesh{path});
    REQUIRE(rig.settle());
    while (rig.session().messages().prompt())
      rig.bench->apply(action::DismissPrompt{});  // markers lost
    const Mesh back = io::read_mesh(path).mesh;
    REQUIRE(back.coordinates.size() == rig.mesh().coordinates.size());
    CHECK(back.topology->element_count() == rig.mesh().topology->element_count());
    // STL has single precision and no order of its own.
    if (extension != ".stl") CHECK(back.coordinates == rig.mesh().coordinates);
  }
  CHECK(rig.document().name() == "mesh.su2");
  CHECK(rig.document().modified());
}

TEST_CASE("exporting asks before it replaces a file") {
  Rig rig;
  rig.open(ring_mesh());
  const auto path = rig.folder / "there.vtk";
  std::ofstream(path) << "precious\n";
  rig.bench->apply(action::ExportMesh{path});
  rig.frames();
  REQUIRE(rig.visible("prompt/Cancel"));
  rig.click("prompt/Cancel");
  CHECK(fs::file_size(path) == 9);
  rig.bench->apply(action::ExportMesh{path});
  rig.frames();
  rig.click("prompt/Replace");
  REQUIRE(rig.settle());
  CHECK(io::read_mesh(path).mesh.coordinates == rig.mesh().coordinates);
}

TEST_CASE("nothing is exported among the meshes that come with the program") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  const auto refused = [&](const std::string& name, auto&& action_at) {
    INFO("file ", name);
    const auto path = assets_folder() / name;
    rig.bench->apply(action_at(path));
    rig.frames(6);
    CHECK(rig.settle());
    REQUIRE(rig.session().messages().notice().has_value());
    CHECK(rig.session().messages().notice()->text == bundled_text);
    CHECK(rig.session().messages().prompt() == nullptr);
    CHECK_FALSE(fs::exists(path));
    rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  };
  using fs::path;
  refused("never.vtk", [](const path& p) { return action::ExportMesh{p}; });
  refused("never.csv", [](const path& p) { return action::ExportMarkers{p, {}}; });
  refused("never.json", [](const path& p) { return action::ExportRecipe{p}; });
  refused("iterations.csv", [](const path& p) { return action::ExportConvergence{p}; });
  refused("never.png", [](const path& p) { return action::SavePicture{p}; });
  refused("window.png", [](const path& p) { return action::TakeScreenshot{p}; });
  refused("never.gif", [](const path& p) { return action::StartRecording{p, {}}; });
}

TEST_CASE("the menu exports the selected markers as a curve") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.click("menu/File");
  rig.click("menu/export");
  rig.frames();
  REQUIRE(rig.visible("menu/Markers.dat"));
  rig.click("menu/Markers.dat");
  REQUIRE(rig.wait([&] { return rig.bench->dialogs().file_dialog().is_open(); }));
  rig.key(keys::enter);  // the name proposed
  REQUIRE(rig.settle());
  std::ifstream file(rig.folder / "mesh_markers.dat");
  std::string line;
  REQUIRE(std::getline(file, line));
  CHECK(line == "flap");
  int points = 0;
  while (std::getline(file, line) && !line.empty()) ++points;
  CHECK(points == 25);  // 24 nodes, the first again at the end
  CHECK_FALSE(std::getline(file, line));
}

TEST_CASE("closing the mesh asks when there is something to lose") {
  Rig rig;
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  REQUIRE(rig.settle());
  rig.key(keys::w, {keys::control});
  rig.frames();
  REQUIRE(rig.visible("prompt/Cancel"));
  rig.click("prompt/Cancel");
  CHECK(rig.session().document() != nullptr);
  rig.key(keys::w, {keys::control});
  rig.frames();
  rig.click("prompt/Don't save");
  CHECK(rig.session().document() == nullptr);
  CHECK(rig.session().selection().empty());
  CHECK(rig.bench->title() == "winslow");
  // Nothing of it is left behind: another one opens and moves as ever.
  rig.open(two_body_mesh(), "other.su2");
  rig.click("marker/left");
  CHECK(rig.session().selection().markers().size() == 1);
}

}  // namespace winslow::gui::test
