#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"
#include "io/format/mesh_file.h"

namespace winslow::gui::test {

namespace {

void edit_mesh(Rig& rig) {
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  REQUIRE(rig.settle());
}

double rightmost_of_flap(const Mesh& mesh) {
  double most = -1e9;
  for (const Index node : mesh.topology->markers().nodes(*mesh.topology->markers().find("flap")))
    most = std::max(most, mesh.coordinates.xy(node).x());
  return most;
}

}  // namespace

TEST_CASE("what would be lost can be saved first, and then it goes on") {
  Rig rig;
  rig.open(ring_mesh());
  const auto path = rig.document().path();
  edit_mesh(rig);
  rig.key(keys::q, {keys::control});
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->title == "Save changes to mesh.su2?");
  CHECK_FALSE(rig.session().files().quit_accepted());
  rig.click("prompt/Save");
  REQUIRE(rig.wait([&] { return rig.session().files().quit_accepted(); }, 60));
  CHECK(rightmost_of_flap(io::read_mesh(path).mesh) == doctest::Approx(0.7));
}

TEST_CASE("opening another mesh after a save opens it, and Enter saves") {
  Rig rig;
  rig.open(ring_mesh());
  const auto path = rig.document().path();
  edit_mesh(rig);
  const auto other = write(rig.folder, two_body_mesh(), "other.su2");
  rig.bench->apply(action::OpenMesh{other});
  rig.frames();
  rig.key(keys::enter);
  REQUIRE(rig.wait([&] { return rig.document().name() == "other.su2"; }, 60));
  CHECK(rightmost_of_flap(io::read_mesh(path).mesh) == doctest::Approx(0.7));
}

TEST_CASE("a save that is cancelled leaves all as it is, also later") {
  Rig rig;
  rig.open(ring_mesh());
  edit_mesh(rig);
  rig.key(keys::w, {keys::control});
  rig.frames();
  rig.key(keys::escape);  // Cancel
  rig.frames();
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().modified());
  // A save for its own sake does not close the mesh.
  rig.bench->apply(action::SaveMesh{{}, true});
  REQUIRE(rig.settle());
  CHECK_FALSE(rig.document().modified());
  CHECK(rig.session().document() != nullptr);
}

TEST_CASE("a mesh that is still being solved is saved once that is done") {
  Rig rig;
  rig.open(ring_mesh());
  const auto path = rig.document().path();
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.2, 0)}});
  rig.bench->apply(action::CloseMesh{});
  rig.frames();
  if (rig.session().messages().prompt()) rig.click("prompt/Save");
  REQUIRE(rig.wait([&] { return rig.session().document() == nullptr; }, 60));
  CHECK(rightmost_of_flap(io::read_mesh(path).mesh) == doctest::Approx(0.7));
}

TEST_CASE("a bundled mesh is saved elsewhere: the question leads to the dialog of files") {
  Rig rig;
  rig.bench->apply(action::OpenMesh{std::string(WINSLOW_ASSETS) + "/coarse/circle.su2"});
  REQUIRE(rig.settle());
  rig.bench->apply(action::Scramble{1});
  REQUIRE(rig.settle());
  rig.bench->apply(action::RunSmooth{});
  REQUIRE(rig.settle());
  rig.key(keys::w, {keys::control});
  rig.frames();
  rig.click("prompt/Save");
  rig.frames(3);
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.fill("dialog/name", (rig.folder / "copy.su2").string());
  rig.click("dialog/accept");
  REQUIRE(rig.wait([&] { return rig.session().document() == nullptr; }, 60));
  CHECK(std::filesystem::exists(rig.folder / "copy.su2"));
}

TEST_CASE("warnings of a file need no answer: they are in the banner") {
  Rig rig;
  const auto path = write(rig.folder, ring_mesh(), "warned.su2");
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  in.close();
  std::ofstream(path) << text.str() << "SOMETHING= 1\nSOMETHING_ELSE= 3\n";
  rig.bench->apply(action::OpenMesh{path});
  REQUIRE(rig.settle());
  REQUIRE(!rig.document().warnings().empty());
  CHECK(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.session().messages().banner());
  CHECK(rig.session().messages().banner()->text.find(rig.document().warnings().front()) !=
        std::string::npos);
  rig.frames();
  rig.click("banner/keep");
  CHECK_FALSE(rig.session().messages().banner());
}

}  // namespace winslow::gui::test
