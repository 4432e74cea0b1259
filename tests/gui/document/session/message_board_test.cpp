#include "gui/document/session/message_board.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/quality/quality.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"
#include "gui/support/session_parts.h"
#include "io/format/mesh_file.h"
#include "support/paths.h"

namespace winslow::gui::test {

TEST_CASE("questions wait in the order in which they were asked") {
  const NothingOpen nothing;
  const LiveMesh& mesh = nothing.mesh;
  MessageBoard board(mesh);
  CHECK(board.prompt() == nullptr);
  board.ask({Prompt::Kind::question, "First?", {}, {}});
  board.report_error("Second", "text");
  REQUIRE(board.prompt() != nullptr);
  CHECK(board.prompt()->title == "First?");
  board.on(action::DismissPrompt{});
  REQUIRE(board.prompt() != nullptr);
  CHECK(board.prompt()->kind == Prompt::Kind::error);
  CHECK(board.prompt()->choices.size() == 1);
  board.on(action::DismissPrompt{});
  CHECK(board.prompt() == nullptr);
  board.on(action::DismissPrompt{});
}

TEST_CASE("the banner says what the mesh calls for until it is put away, for this mesh alone") {
  SessionParts parts(tangled_mesh());
  MessageBoard& board = parts.messages;
  REQUIRE(board.banner().has_value());
  CHECK(board.banner()->kind == Banner::Kind::inverted_input);
  // Where to look: the element that is worst.
  const auto sines =
      element_values(parts.mesh.document()->state().mesh, Metric::normalized_jacobian);
  const auto worst = static_cast<Index>(std::ranges::min_element(sines) - sines.begin());
  CHECK(board.banner()->worst == MeshItem{MeshItem::Kind::element, worst});
  CHECK_FALSE(board.banner_dismissed());
  board.on(action::DismissBanner{});
  CHECK_FALSE(board.banner().has_value());
  CHECK(board.banner_dismissed());
  REQUIRE(parts.jobs.start(SmoothCommand{}, false));
  parts.finish();
  CHECK_FALSE(board.banner_dismissed());
}

TEST_CASE(
    "a motion that ended early is said before that it has not converged, not that it is bad") {
  const NothingOpen nothing;
  const LiveMesh& mesh = nothing.mesh;
  MessageBoard board(mesh);
  SmoothResult result;
  result.converged = false;
  board.set_banner(Banner::Kind::partial_motion, "half of the way");
  board.set_banner_of_result(result);
  CHECK(board.banner()->kind == Banner::Kind::partial_motion);
  result.inverted = 3;
  board.set_banner_of_result(result);
  CHECK(board.banner()->kind == Banner::Kind::inverted_result);
  board.clear_banner();
  result.inverted = 0;
  board.set_banner_of_result(result);
  CHECK(board.banner()->kind == Banner::Kind::not_converged);
  CHECK_FALSE(board.banner()->worst.has_value());
}

TEST_CASE("a command that spoils the cells at walls is named, in each place of the history") {
  SessionParts parts(ring_mesh(48, 24));
  MessageBoard& board = parts.messages;
  CHECK_FALSE(board.banner().has_value());
  SmoothCommand regular;  // makes cells of one shape of stretched ones
  regular.smooth.targets = TargetBlend::regular();
  REQUIRE(parts.jobs.start(regular, false));
  parts.finish();
  REQUIRE(board.banner().has_value());
  CHECK(board.banner()->kind == Banner::Kind::damaged);
  const std::string text = board.banner()->text;
  CHECK(text.starts_with("First heights changed by a factor of more than 1.5"));
  CHECK(text.find(" at (") != std::string::npos);
  CHECK(text.ends_with("avoid that."));
  REQUIRE(board.banner()->worst.has_value());
  CHECK(parts.mesh.topology()->on_boundary(board.banner()->worst->id));
  CHECK(board.banner()->worst->kind == MeshItem::Kind::node);
  REQUIRE(parts.jobs.start(regular, false));  // nothing changes any more
  parts.finish();
  CHECK_FALSE(board.banner().has_value());
  parts.history.on(action::Undo{});
  REQUIRE(board.banner().has_value());
  CHECK(board.banner()->text == text);
  parts.history.on(action::Undo{});
  CHECK_FALSE(board.banner().has_value());
}

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
  rig.bench->apply(action::OpenMesh{winslow::test::assets("coarse/circle.su2")});
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
  REQUIRE(!rig.document().source().warnings.empty());
  CHECK(rig.session().messages().prompt() == nullptr);
  REQUIRE(rig.session().messages().banner());
  CHECK(rig.session().messages().banner()->text.find(rig.document().source().warnings.front()) !=
        std::string::npos);
  rig.frames();
  rig.click("banner/keep");
  CHECK_FALSE(rig.session().messages().banner());
}

namespace {

/// A tetrahedron with a point twice, a facet twice, one facet seen from inside, and a loose point.
std::filesystem::path broken_surface(const TemporaryFolder& folder) {
  const auto path = folder / "broken.obj";
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 1\nv 9 9 9\n"
                         "f 1 3 2\nf 1 2 4\nf 2 5 3\nf 3 5 1\nf 1 3 5\n";
  return path;
}

}  // namespace

TEST_CASE("a file that a repair mends is opened by the button of the error, changes counted") {
  Rig rig;
  const auto path = broken_surface(rig.folder);
  rig.bench->apply(action::OpenMesh{path});
  REQUIRE(rig.settle());
  CHECK(rig.session().document() == nullptr);
  const Prompt* prompt = rig.session().messages().prompt();
  REQUIRE(prompt != nullptr);
  CHECK(prompt->title == "Cannot open broken.obj");
  CHECK(prompt->text.find("broken.obj:") != std::string::npos);
  rig.frames();
  SUBCASE("not now") {
    rig.click("prompt/Cancel");
    REQUIRE(rig.settle());
    CHECK(rig.session().document() == nullptr);
    CHECK(rig.session().messages().prompt() == nullptr);
  }
  SUBCASE("repaired") {
    rig.click("prompt/Repair");
    REQUIRE(rig.settle());
    REQUIRE(rig.session().document() != nullptr);
    CHECK(rig.mesh().topology->node_count() == 4);
    CHECK(rig.mesh().topology->element_count() == 4);
    CHECK(rig.document().source().reading.defects == io::Defects::repair);
    REQUIRE(rig.session().messages().banner());
    const std::string& said = rig.session().messages().banner()->text;
    CHECK(said.find("repaired: 1 point lies where an earlier one does") != std::string::npos);
    CHECK(said.find("repaired: 1 element has the points of an earlier one") != std::string::npos);
    // The file is as it was until the mesh is saved.
    CHECK_THROWS_AS(io::read_mesh(path), io::MendableError);
  }
}

TEST_CASE("a file that no repair mends is refused without that button") {
  Rig rig;
  const auto path = rig.folder / "fin.obj";
  std::ofstream(path)
      << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n";
  rig.bench->apply(action::OpenMesh{path});
  REQUIRE(rig.settle());
  REQUIRE(rig.session().messages().prompt() != nullptr);
  rig.frames();
  CHECK(rig.visible("prompt/OK"));
  CHECK_FALSE(rig.visible("prompt/Repair"));
}

}  // namespace winslow::gui::test
