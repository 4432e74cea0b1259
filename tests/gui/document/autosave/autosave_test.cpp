#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "gui/document/autosave/session_folder.h"
#include "gui/document/autosave/step_file.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

void wait_until_kept(Rig& rig) {
  REQUIRE(rig.settle());
  REQUIRE(rig.wait([&] { return !rig.bench->autosave().busy(); }));
}

std::vector<fs::path> kept_sessions(const TemporaryFolder& profile) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(profile / "autosave", error))
    folders.push_back(entry.path());
  return folders;
}

/// Works a studio that then ends as if it were killed. Returns the mesh of each position; the
/// history is left at position 2 of 3.
std::vector<Coordinates> work_and_crash(const TemporaryFolder& profile,
                                        const TemporaryFolder& meshes) {
  Rig rig(1280, 720, profile.path());
  rig.bench->apply(action::OpenMesh{write(meshes, ring_mesh(), "wing.su2")});
  REQUIRE(rig.settle());
  std::vector<Coordinates> positions{rig.mesh().coordinates};
  for (double degrees : {10.0, -25.0, 5.0}) {
    turn_flap(rig, degrees);
    positions.push_back(rig.mesh().coordinates);
  }
  rig.bench->apply(action::Undo{});
  wait_until_kept(rig);
  return positions;
}

bool offered(Rig& rig) {
  return rig.wait([&] { return rig.session().messages().prompt() != nullptr; }) &&
         (rig.frames(3), true);
}

fs::path find(const fs::path& folder, const std::string& start, int number = 0) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(start)) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  REQUIRE(static_cast<int>(found.size()) > number);
  return found[static_cast<std::size_t>(number)];
}

void damage(const fs::path& file) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(100);
  stream.put('\x5a');
}

}  // namespace

TEST_CASE("after a crash the session is offered back, every position to the bit") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  const auto positions = work_and_crash(profile, meshes);
  // The mesh file need not be there any more.
  fs::remove(meshes / "wing.su2");
  {
    Rig rig(1280, 720, profile.path());
    REQUIRE(offered(rig));
    CHECK(rig.session().messages().prompt()->text.find("wing.su2 (3 commands, 20") !=
          std::string::npos);
    rig.click("prompt/Restore");
    REQUIRE(rig.wait([&] { return rig.session().document() != nullptr; }));
    wait_until_kept(rig);
    const History& history = rig.document().history();
    REQUIRE(history.size() == 4);
    CHECK(history.position() == 2);
    CHECK(rig.document().source().path == meshes / "wing.su2");
    CHECK(rig.document().modified());
    CHECK(history.result(3).converged);
    CHECK(history.result(3).history.size() > 2);
    CHECK(describe(history.command(1)) == "Rotate flap by 10 deg");
    for (std::size_t k = positions.size(); k-- > 0;) {
      rig.bench->apply(action::GoToStep{k});
      CHECK(rig.session().coordinates() == positions[k]);
    }
    // It is this studio's session now, and there is one of it.
    wait_until_kept(rig);
    CHECK(kept_sessions(profile).size() == 1);
  }
  // That one was not closed either.
  Rig rig(1280, 720, profile.path());
  CHECK(offered(rig));
}

TEST_CASE("after a crash a mesh that was repaired as it was opened is repaired again") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  std::ofstream(meshes / "twice.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 1\n"
                                         "f 1 3 2\nf 1 2 4\nf 2 3 5\nf 3 1 5\n";
  {
    Rig rig(1280, 720, profile.path());
    rig.bench->apply(
        action::OpenMesh{meshes / "twice.obj", false, {.defects = io::Defects::repair}});
    REQUIRE(rig.settle());
    REQUIRE(rig.session().document() != nullptr);
    wait_until_kept(rig);
  }
  Rig rig(1280, 720, profile.path());
  REQUIRE(offered(rig));
  rig.click("prompt/Restore");
  REQUIRE(rig.wait([&] { return rig.session().document() != nullptr; }));
  CHECK(rig.mesh().topology->node_count() == 4);
  CHECK(rig.document().source().reading.defects == io::Defects::repair);
}

TEST_CASE("nothing is left after a clean quit, and nothing is offered") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  {
    Rig rig(1280, 720, profile.path());
    rig.bench->apply(action::OpenMesh{write(meshes, ring_mesh())});
    wait_until_kept(rig);
    CHECK(kept_sessions(profile).size() == 1);
    turn_flap(rig, 10);
    rig.bench->apply(action::Quit{true});
  }
  CHECK(kept_sessions(profile).empty());
  Rig rig(1280, 720, profile.path());
  wait_until_kept(rig);
  CHECK(rig.session().messages().prompt() == nullptr);
}

TEST_CASE("nothing is kept of a mesh that was closed; the next one is kept again") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  {
    Rig rig(1280, 720, profile.path());
    const auto mesh = write(meshes, ring_mesh());
    rig.bench->apply(action::OpenMesh{mesh});
    wait_until_kept(rig);
    turn_flap(rig, 10);
    wait_until_kept(rig);
    CHECK(kept_sessions(profile).size() == 1);
    rig.bench->apply(action::CloseMesh{true});
    wait_until_kept(rig);
    CHECK(kept_sessions(profile).empty());
    rig.bench->apply(action::OpenMesh{mesh});
    wait_until_kept(rig);
    CHECK(kept_sessions(profile).size() == 1);
    rig.bench->apply(action::CloseMesh{true});
    wait_until_kept(rig);
  }
  Rig rig(1280, 720, profile.path());
  wait_until_kept(rig);
  CHECK(rig.session().messages().prompt() == nullptr);
}

TEST_CASE("a session that is discarded is gone") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  work_and_crash(profile, meshes);
  Rig rig(1280, 720, profile.path());
  REQUIRE(offered(rig));
  rig.click("prompt/Discard");
  REQUIRE(rig.wait([&] { return kept_sessions(profile).empty(); }));
  CHECK(rig.session().document() == nullptr);
  CHECK(rig.session().messages().prompt() == nullptr);
}

TEST_CASE("two studios at the same time leave each other's sessions alone") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  auto first = std::make_unique<Rig>(1100, 720, profile.path());
  first->bench->apply(action::OpenMesh{write(meshes, ring_mesh(), "one.su2")});
  REQUIRE(first->settle());
  turn_flap(*first, 10);
  wait_until_kept(*first);
  const Coordinates of_first = first->mesh().coordinates;
  {
    Rig second(1100, 720, profile.path());
    second.frames(5);
    wait_until_kept(second);
    CHECK(second.session().messages().prompt() == nullptr);
    second.bench->apply(action::OpenMesh{write(meshes, two_body_mesh(), "two.su2")});
    wait_until_kept(second);
    CHECK(kept_sessions(profile).size() == 2);
    second.bench->apply(action::Quit{true});
  }
  CHECK(kept_sessions(profile).size() == 1);
  first.reset();
  Rig third(1100, 720, profile.path());
  REQUIRE(offered(third));
  CHECK(third.session().messages().prompt()->text.find("one.su2") != std::string::npos);
  third.click("prompt/Restore");
  REQUIRE(third.wait([&] { return third.session().document() != nullptr; }));
  CHECK(third.session().coordinates() == of_first);
}

TEST_CASE("a damaged step costs that step and those after it, and is said") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  const auto positions = work_and_crash(profile, meshes);
  damage(find(kept_sessions(profile).at(0), "step-", 1));
  Rig rig(1280, 720, profile.path());
  REQUIRE(offered(rig));
  rig.click("prompt/Restore");
  REQUIRE(rig.wait([&] { return rig.session().document() && rig.session().messages().prompt(); }));
  CHECK(rig.session().messages().prompt()->text.find("checksum") != std::string::npos);
  CHECK(rig.document().history().size() == 2);
  CHECK(rig.session().coordinates() == positions[1]);
}

TEST_CASE("what was opened is kept, whatever becomes of its file before that is written") {
  enum class Fate { stays, replaced, deleted };
  const auto check = [](const Mesh& mesh, Fate fate) {
    TemporaryFolder root, meshes;
    const fs::path path = write(meshes, mesh, "wing.su2");
    const Document document(Document::load(path));
    if (fate == Fate::replaced) write(meshes, ring_mesh(30, 5), "wing.su2");
    if (fate == Fate::deleted) fs::remove(path);
    SessionFolder folder(root.path());
    const auto keep = [&](std::uint64_t generation, const fs::path& mesh, const Document& of) {
      folder.write(
          {generation, path, path, mesh, of.source().stamp, of.history(), of.edits().tags()});
      return read_session(folder.path());
    };
    const RestoredSession back = keep(1, path, document);
    const Mesh& was = document.state().mesh;
    const Mesh& is = back.loaded.state.mesh;
    CHECK(is.coordinates == was.coordinates);
    REQUIRE(is.topology->element_count() == was.topology->element_count());
    for (Index e = 0; e < was.topology->element_count(); ++e)
      CHECK(std::ranges::equal(is.topology->element(e), was.topology->element(e)));
    REQUIRE(is.topology->markers().size() == was.topology->markers().size());
    for (std::size_t m = 0; m < was.topology->markers().size(); ++m)
      CHECK(is.topology->markers()[m].name == was.topology->markers()[m].name);
    CHECK(back.loaded.path == path);
    CHECK(back.loaded.quality.inverted == document.loaded_quality().inverted);
    // The file itself, with all that its format holds, if it is still the one.
    CHECK((back.loaded.file.details != nullptr) == (fate == Fate::stays));
    // Kept again by the studio that has restored it.
    const RestoredSession again = keep(2, kept_mesh(folder.path()), Document(back.loaded));
    CHECK(again.loaded.state.mesh.coordinates == was.coordinates);
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 3);  // with lock, manifest
  };
  for (const Fate fate : {Fate::stays, Fate::replaced, Fate::deleted}) {
    check(ring_mesh(), fate);
    check(two_body_mesh(), fate);
    check(tangled_mesh(), fate);
  }
}

TEST_CASE("a damaged manifest or mesh is reported, and can be deleted") {
  for (const bool manifest : {true, false}) {
    TemporaryFolder profile;
    TemporaryFolder meshes;
    work_and_crash(profile, meshes);
    const fs::path folder = kept_sessions(profile).at(0);
    std::ofstream(find(folder, manifest ? "session" : "mesh")) << "{ nonsense";
    Rig rig(1280, 720, profile.path());
    REQUIRE(offered(rig));
    if (!manifest) {
      rig.click("prompt/Restore");
      REQUIRE(offered(rig));
    }
    CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
    CHECK(rig.session().document() == nullptr);
    rig.click("prompt/Delete it");
    CHECK(rig.wait([&] { return kept_sessions(profile).empty(); }));
  }
}

TEST_CASE("a manifest of odd content is refused in words") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) -> std::string {
    std::ofstream(folder / manifest_name, std::ios::binary) << text;
    try {
      read_session(folder / ".");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  const auto about = [](const std::string& source) {
    return R"({"winslow_session": 1, "source": ")" + source +
           R"(", "steps": [], "time": "now", "mesh": "mesh-1.su2"})";
  };
  const std::string nested(1000000, '[');
  CHECK(refusal(nested).find("more than 100 lists in each other") != std::string::npos);
  CHECK(refusal(R"({"winslow_session": 1, "steps": )" + nested).find("in each other") !=
        std::string::npos);
  CHECK(refusal(about("a.su2\\u0000.vtk")).find("no fitting \"source\"") != std::string::npos);
  CHECK(refusal(about(std::string(70000, 'a'))).find("no fitting \"source\"") != std::string::npos);
  // With a name that can be one it goes on to the mesh, which is not there.
  CHECK(refusal(about("a.su2")).find("mesh-1.su2") != std::string::npos);
}

TEST_CASE("a session of a million nested lists does not keep the studio from starting") {
  TemporaryFolder profile;
  const fs::path folder = profile / "autosave/1-1";
  fs::create_directories(folder);
  std::ofstream(folder / manifest_name) << std::string(1000000, '[');
  Rig rig(1280, 720, profile.path());
  REQUIRE(offered(rig));
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::error);
}

TEST_CASE("what came after an undone step is written once and goes when it is forgotten") {
  TemporaryFolder profile;
  Rig rig(1280, 720, profile.path());
  rig.open(ring_mesh());
  turn_flap(rig, 10);
  turn_flap(rig, 5);
  wait_until_kept(rig);
  const fs::path folder = kept_sessions(profile).at(0);
  const fs::path first = find(folder, "step-", 0);
  const fs::path second = find(folder, "step-", 1);
  const auto time = fs::last_write_time(first);
  rig.bench->apply(action::Undo{});
  turn_flap(rig, 8);
  wait_until_kept(rig);
  CHECK(fs::exists(first));
  CHECK(fs::last_write_time(first) == time);
  CHECK_FALSE(fs::exists(second));
}

TEST_CASE("the file of a step reads back to the bit and refuses every cut of it") {
  TemporaryFolder folder;
  const MeshState before = make_state(ring_mesh(4, 2));
  MeshState after = before;
  Coordinates& x = after.mesh.coordinates;
  x.set_xy(0, Vec2(0.1, -0.0));
  x.set_xy(1, Vec2(1e-310, 3));
  SmoothResult smooth;
  smooth.converged = true;
  smooth.linear_solver = "KLU";
  smooth.history.resize(2);
  smooth.history[1].residual = 0.3;
  smooth.history[1].stage = Stage::newton;
  const auto path = folder / "step.bin";
  write_step(path, after, before, smooth);
  const CommandResult back = read_step(path, before);
  const Coordinates& there = back.state.mesh.coordinates;
  CHECK(there == x);
  CHECK(std::signbit(there.xy(0).y()));
  CHECK(back.state.mesh.topology == before.mesh.topology);
  CHECK(back.state.vcvs.plane() == before.vcvs.plane());
  CHECK(back.smooth.linear_solver == "KLU");
  REQUIRE(back.smooth.history.size() == 2);
  CHECK(back.smooth.history[1].residual == 0.3);
  CHECK(back.smooth.history[1].stage == Stage::newton);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    std::ofstream(path, std::ios::binary) << bytes.substr(0, size);
    CHECK_THROWS_AS(read_step(path, before), InputError);
  }
  CHECK_THROWS_AS(read_step(folder / "none.bin", before), InputError);
}

namespace {

/// Drags the selected body along x by its arrow, and waits for the mesh.
void drag_along_x(Rig& rig, double pixels) {
  const auto arrow = rig.bench->widgets().find("gizmo/arrow/x");
  REQUIRE(arrow.has_value());
  const auto along = rig.bench->widgets().find("gizmo/arrow/x")->centre();
  const View& view = rig.bench->view_control().view();
  const ScreenPoint root = view.project(rig.session().selection().space_pivot()).at;
  const ScreenVector way = (along - root) / (along - root).norm();
  rig.drag(along, along + pixels * way);
  REQUIRE(rig.wait([&] {
    return rig.session().mesh().work().body_drag() == nullptr ||
           rig.session().mesh().work().body_drag()->settled();
  }));
  rig.release();
  REQUIRE(rig.settle());
}

}  // namespace

TEST_CASE("after a crash a volume mesh comes back as a drag has left it, to the bit") {
  TemporaryFolder profile;
  TemporaryFolder meshes;
  const Mesh mesh = winslow::test::box_with_body(5, winslow::test::Volumes::tetrahedra);
  std::vector<Coordinates> positions;
  std::string description;
  {
    Rig rig(1000, 760, profile.path());
    rig.bench->apply(action::OpenMesh{write(meshes, mesh, "box.su2")});
    REQUIRE(rig.settle());
    set_view(rig, [](ViewOptions& view) { view.left_panel = true; });
    rig.click("marker/body");
    rig.key(GLFW_KEY_7);
    rig.frames();
    positions.push_back(rig.mesh().coordinates);
    for (const double pixels : {40.0, -25.0}) {
      drag_along_x(rig, pixels);
      positions.push_back(rig.mesh().coordinates);
    }
    REQUIRE(rig.document().history().size() == 3);
    REQUIRE(positions[1] != positions[0]);
    REQUIRE(positions[2] != positions[1]);
    description = describe(rig.document().history().command(2));
    rig.key(keys::z, {keys::control});
    REQUIRE(rig.settle());
    REQUIRE(rig.wait([&] { return !rig.bench->autosave().busy(); }));
  }  // as if it were killed
  Rig rig(1000, 760, profile.path());
  REQUIRE(rig.wait([&] { return rig.session().messages().prompt() != nullptr; }));
  rig.frames(3);
  rig.click("prompt/Restore");
  REQUIRE(rig.wait([&] { return rig.session().document() != nullptr; }));
  REQUIRE(rig.settle());
  CHECK(rig.session().in_space());
  REQUIRE(rig.document().history().size() == 3);
  CHECK(rig.document().history().position() == 1);
  CHECK(rig.mesh().coordinates == positions[1]);
  CHECK(describe(rig.document().history().command(2)) == description);
  rig.key(keys::z, {keys::control});
  REQUIRE(rig.settle());
  CHECK(rig.mesh().coordinates == positions[0]);
  for (int k = 0; k < 2; ++k) rig.key(keys::z, {keys::control, keys::shift});
  REQUIRE(rig.settle());
  CHECK(rig.mesh().coordinates == positions[2]);
  // It can be gone on with: the same body is dragged from there.
  set_view(rig, [](ViewOptions& view) { view.left_panel = true; });
  rig.click("marker/body");
  rig.key(GLFW_KEY_7);
  rig.frames();
  drag_along_x(rig, 30);
  CHECK(rig.document().history().size() == 4);
}

}  // namespace winslow::gui::test
