#include <doctest/doctest.h>

#include <fstream>

#include "core/command/motion_frames.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "gui/files/assets.h"
#include "gui/shell/headless/headless_studio.h"
#include "gui/support/rig.h"
#include "io/format/mesh_file.h"
#include "io/recipe/recipe.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

MoveCommand turn_flap() {
  MoveCommand command{{{{"flap"}, {25, Vec2(0, 0), {0.3, 0}}}}, {}, {}};
  command.smooth.targets = TargetBlend::regular();  // every iteration moves nodes by pixels
  return command;
}

fs::path write_recipe_file(const TemporaryFolder& folder, std::vector<Command> commands,
                           const std::string& input = "mesh.su2") {
  const fs::path path = folder / "recipe.json";
  io::write_recipe(path, {input, "", std::move(commands)});
  return path;
}

HeadlessOptions small_window() {
  HeadlessOptions options;
  options.width = 900;
  options.height = 600;
  return options;
}

std::string failure(const HeadlessOptions& options) {
  try {
    run_headless(options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a recipe replayed without a display gives what the studio gives") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  rig.bench->apply(action::RunCommand{turn_flap(), false});
  REQUIRE(rig.settle());
  rig.frames(4);
  const auto interactive = rig.folder / "interactive.png";
  write_png(interactive, rig.bench->pictures().picture({.size = {}, .panels = false}));

  HeadlessOptions options = small_window();
  options.recipe = write_recipe_file(rig.folder, {turn_flap()});
  options.recording.picture.panels = false;
  options.picture = rig.folder / "headless.png";
  const HeadlessResult result = run_headless(options);
  CHECK(result.inverted == 0);
  CHECK(result.converged);
  CHECK(content(options.picture) == content(interactive));
  const std::string once = content(options.picture);
  run_headless(options);
  CHECK(content(options.picture) == once);
}

TEST_CASE("frames of a replay lead from the mesh as it was to the mesh as it is") {
  TemporaryFolder folder;
  write(folder, ring_mesh());
  HeadlessOptions options = small_window();
  options.recipe = write_recipe_file(folder, {turn_flap(), ScrambleCommand{2}});
  options.recording.picture = {.size = std::array{400, 200}, .panels = false};
  options.frames = folder / "frames";
  options.picture = folder / "end.png";
  run_headless(options);
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(options.frames)) frames.push_back(entry.path());
  std::sort(frames.begin(), frames.end());
  // The same meshes as without the studio: those of iterations and those between them.
  const auto meshes = motion_frames({turn_flap(), ScrambleCommand{2}}, make_state(ring_mesh()));
  CHECK(frames.size() == meshes.size());
  CHECK(frames.size() > 25);
  // The last step of Newton's method is smaller than a pixel.
  int alike = 0;
  for (std::size_t k = 1; k < frames.size(); ++k)
    alike += content(frames[k]) == content(frames[k - 1]);
  CHECK(alike <= 1);
}

TEST_CASE("a turn of a bundled mesh has a frame for every degree, and all of them are valid") {
  const fs::path path = assets_folder() / "coarse" / "naca0012.su2";
  MoveCommand move;
  move.bodies[0].markers = {"airfoil"};
  move.bodies[0].motion.rotate = 60;
  const auto meshes = motion_frames({move}, make_state(io::read_mesh(path).mesh));
  CHECK(meshes.size() > 60);
  for (const Mesh& mesh : meshes)
    CHECK(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);

  TemporaryFolder folder;
  HeadlessOptions options = small_window();
  options.mesh = path;
  options.recipe = write_recipe_file(folder, {move}, path.string());
  options.recording.picture = {.size = std::array{200, 120}, .panels = false};
  options.frames = folder / "frames";
  run_headless(options);
  const auto drawn = std::distance(fs::directory_iterator(options.frames), {});
  CHECK(static_cast<std::size_t>(drawn) == meshes.size());
}

TEST_CASE("what is wrong with a replay is said before or where it happens") {
  TemporaryFolder folder;
  write(folder, ring_mesh());
  HeadlessOptions options = small_window();
  options.picture = folder / "p.png";
  options.recipe = folder / "none.json";
  CHECK(failure(options).find("none.json") != std::string::npos);
  options.recipe = write_recipe_file(folder, {turn_flap()}, "none.su2");
  CHECK(failure(options).find("none.su2") != std::string::npos);
  MoveCommand wrong = turn_flap();
  wrong.bodies[0].markers = {"rudder"};
  options.recipe = write_recipe_file(folder, {wrong});
  CHECK(failure(options).find("rudder") != std::string::npos);
  options.recipe = write_recipe_file(folder, {}, "");
  CHECK(failure(options).find("no mesh") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "p.png"));
}

TEST_CASE("a script works the studio through its widgets, mouse and keys") {
  TemporaryFolder folder;
  write(folder, two_body_mesh());
  std::ofstream(folder / "tour.txt") << R"(# a tour
open mesh.su2
click -2 0            # the body on the left
fill motion/dx 0.25
screenshot selected.png
drag -2 0 -1.75 0.25
wait
key Ctrl+Z
picture mesh.svg no-legend
away
picture large.png mesh-alone 2
widgets tool/run
)";
  HeadlessOptions options = small_window();
  options.script = folder / "tour.txt";
  options.folder = folder.path();
  std::vector<std::string> said;
  options.say = [&](const std::string& line) { said.push_back(line); };
  run_headless(options);
  CHECK(fs::exists(folder / "selected.png"));
  CHECK(fs::exists(folder / "mesh.svg"));
  CHECK(fs::exists(folder / "large.png"));
  REQUIRE(said.size() == 4);
  CHECK(said.back() == "tool/run");
}

TEST_CASE("a script's clicks scroll to the control they name, or say that they cannot") {
  TemporaryFolder folder;
  write(folder, two_body_mesh());
  HeadlessOptions options = small_window();
  options.script = folder / "s.txt";
  const auto play = [&](const std::string& text) {
    std::ofstream(options.script) << "open mesh.su2\nsize 1280 420\n" << text;
    HeadlessStudio studio(options.width, options.height);
    play_script(read_script(options.script), studio, {}, [](const std::string&) {});
    const auto field = studio.bench().widgets().find("solver/max_iterations");
    return std::pair{studio.bench().session().solver_settings().smooth_options().max_iterations,
                     field && field->shown};
  };
  const auto [before, shown_before] = play("click solver/advanced\n");
  CHECK_FALSE(shown_before);
  REQUIRE(before != 37);
  const auto [after, shown] = play("click solver/advanced\nfill solver/max_iterations 37\n");
  CHECK(after == 37);
  CHECK(shown);
  // A row of a table reaches beyond its first column.
  CHECK(play("click tab/vcv\nclick vcv/node\nkey Ctrl+A\ntype 40\nkey Enter\n"
             "click vcv/row/1\n")
            .first == before);
  // A window without room for a control has nowhere to scroll it to.
  std::ofstream(options.script) << "open mesh.su2\nsize 320 240\nclick tool/record\n";
  CHECK(failure(options).find("s.txt:3: the widget \"tool/record\" cannot") != std::string::npos);
}

TEST_CASE("scripts click with the right button, and twice") {
  TemporaryFolder folder;
  write(folder, ring_mesh());
  HeadlessOptions options = small_window();
  options.mesh = folder / "mesh.su2";
  options.script = folder / "script.txt";
  std::ofstream(options.script) << "right-click 0 0\nwait 3\nwidgets menu_title\nkey Escape\n"
                                   "wait 3\ndouble-click marker/flap\nwait 3\nwidgets menu_title\n";
  std::string said;
  options.say = [&](const std::string& line) { said += line + '\n'; };
  run_headless(options);
  CHECK(said == "menu_title/flap\n");
}

TEST_CASE("a script's mistakes name the line") {
  TemporaryFolder folder;
  const auto message = [&](const std::string& text) {
    std::ofstream(folder / "s.txt") << text;
    HeadlessOptions options = small_window();
    options.script = folder / "s.txt";
    return failure(options);
  };
  CHECK(message("wait\nclik tool/run\n").find("s.txt:2: found \"clik\"") != std::string::npos);
  CHECK(message("drag 1 2 3\n").find("s.txt:1: ") != std::string::npos);
  CHECK(message("type \"open\n").find("quote") != std::string::npos);
  CHECK(message("\nclick no/such/widget\n").find("s.txt:2: ") != std::string::npos);
  CHECK(message("key Hyper\n").find("Hyper") != std::string::npos);
  CHECK(message("wheel 0 0 fast\n").find("fast") != std::string::npos);
  CHECK(message("screenshot p.jpg\n").find("p.jpg: pictures are written") != std::string::npos);
}

TEST_CASE("keys are named as on the keyboard") {
  CHECK(parse_keys("f") == std::vector{keys::f});
  CHECK(parse_keys("Ctrl+Shift+Z") == std::vector{keys::control, keys::shift, keys::z});
  CHECK(parse_keys("Escape") == std::vector{keys::escape});
  CHECK(parse_keys("F12") == std::vector{keys::f12});
  CHECK(parse_keys("Ctrl++") == std::vector{keys::control, static_cast<int>('+')});
  CHECK_THROWS_AS(parse_keys("F13"), UsageError);
  CHECK_THROWS_AS(parse_keys(""), UsageError);
}

}  // namespace winslow::gui::test
