#include <doctest/doctest.h>

#include <fstream>

#include "gui/files/assets.h"
#include "gui/files/file_kinds.h"
#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::test {

namespace fs = std::filesystem;

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
