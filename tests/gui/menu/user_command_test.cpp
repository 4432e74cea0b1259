#include <doctest/doctest.h>

#include <filesystem>
#include <set>

#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"
#include "support/space_meshes.h"

namespace winslow::gui::test {

namespace {

/// What commands see of a studio, and where they put what is to happen.
struct View {
  explicit View(const Rig& rig)
      : context{rig.session(),
                rig.bench->view_control().options(),
                rig.bench->view_control().state(),
                theme,
                actions,
                rig.bench->capture(),
                rig.bench->recent(),
                rig.bench->demo()} {}
  Theme theme;
  ActionQueue actions;
  PanelContext context;
};

/// All commands, those of submenus among them.
std::vector<UserCommand> flat_commands(const Rig& rig) {
  const View view(rig);
  std::vector<UserCommand> all;
  for (const UserCommand& command : user_commands()) {
    if (!command.items) {
      all.push_back(command);
      continue;
    }
    for (const UserCommand& item : command.items(view.context)) all.push_back(item);
  }
  return all;
}

/// Fails if a key would do two things at once.
void check_chords(const Rig& rig, const char* state) {
  const View view(rig);
  std::map<std::string, std::string> owner;
  for (const UserCommand& command : user_commands()) {
    if (!why_blocked(command, view.context).empty()) continue;
    for (const Chord& chord : command.keys) {
      const auto placed = owner.try_emplace(chord_text(chord), command.id);
      const auto& before = *placed.first;
      INFO(state, ": ", before.first, " belongs to ", before.second, " and ", command.id);
      CHECK(placed.second);
    }
  }
}

/// Runs each command that is not blocked, as a menu would, and puts away what it has opened.
int run_all(Rig& rig) {
  int count = 0;
  for (const UserCommand& command : flat_commands(rig)) {
    View view(rig);
    if (command.id == "quit" || !why_blocked(command, view.context).empty()) continue;
    INFO("command ", command.id);
    REQUIRE(command.run);
    command.run(view.context);
    CHECK_FALSE(view.actions.empty());
    for (const Action& action : view.actions) rig.bench->apply(action);
    REQUIRE(rig.settle());
    for (int k = 0; k < 4; ++k) rig.key(keys::escape);
    CHECK(rig.session().messages().prompt() == nullptr);
    ++count;
  }
  return count;
}

/// Pictures without a name go to the working folder.
class WorkingFolder {
 public:
  explicit WorkingFolder(const std::filesystem::path& path)
      : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(path);
  }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  std::filesystem::path before_;
};

}  // namespace

TEST_CASE("every command has a name of its own, a label and something to do") {
  std::set<std::string> ids;
  for (const UserCommand& command : user_commands()) {
    INFO("command ", command.id);
    CHECK(ids.insert(command.id).second);
    CHECK_FALSE(command.label.empty());
    CHECK_FALSE(command.tooltip.empty());
    CHECK((command.run != nullptr) != (command.items != nullptr));
  }
  CHECK(ids.size() > 20);
}

TEST_CASE("no key does two things") {
  Rig rig;
  check_chords(rig, "no mesh");
  rig.open(ring_mesh());
  check_chords(rig, "a mesh");
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  check_chords(rig, "a selection");
  rig.bench->apply(action::StepSolver{1});
  REQUIRE(rig.session().job().active());
  check_chords(rig, "a solver that pauses");
  rig.bench->apply(action::CancelSolver{});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.1, 0)}});
  check_chords(rig, "a solver at work");
  REQUIRE(rig.settle());
  rig.bench->apply(action::Undo{});
  check_chords(rig, "something to redo");
}

TEST_CASE("every command that can be run runs, with a mesh and without one") {
  Rig rig(800, 600);
  const WorkingFolder folder(rig.folder.path());
  CHECK(run_all(rig) >= 8);
  rig.open(two_body_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("left")}});
  rig.bench->apply(action::ApplyMotion{{0, Vec2(0, 0), Vec2(0.1, 0)}});
  REQUIRE(rig.settle());
  CHECK(run_all(rig) >= 20);
  CHECK_FALSE(rig.session().files().quit_accepted());
}

TEST_CASE("a key runs its command only where the command can be run") {
  Rig rig;
  rig.key(keys::s, {keys::control, keys::shift});  // save as, without a mesh
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
  rig.open(two_body_mesh());
  rig.key(GLFW_KEY_TAB);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("left")});
  rig.key(GLFW_KEY_TAB);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
  rig.key(keys::a, {keys::control});
  CHECK(rig.session().selection().markers().size() == 2);
  rig.key(keys::escape);
  CHECK(rig.session().selection().empty());
}

TEST_CASE("fuzzy search wants the letters in order and prefers words and neighbours") {
  CHECK_FALSE(fuzzy_score("svq", "Save as..."));
  CHECK_FALSE(fuzzy_score("as", "Side"));
  CHECK(fuzzy_score("", "anything") == 0);
  CHECK(fuzzy_score("SA", "save").has_value());
  CHECK(*fuzzy_score("sa", "Save as...") > *fuzzy_score("sa", "Single step, again"));
  CHECK(*fuzzy_score("save", "Save") > *fuzzy_score("save", "Save as..."));
  CHECK(*fuzzy_score("undo", "Undo: Smooth") > *fuzzy_score("undo", "Bundle of knots, old"));
}

TEST_CASE("two edits of one frame both hold: neither replaces what the other says") {
  Rig rig;
  rig.open(ring_mesh());
  const ViewOptions before = rig.bench->view_control().options();
  View view(rig);
  // Both see the options as they are at the beginning of the frame.
  user_command("legend").run(view.context);
  user_command("node_ids").run(view.context);
  const SmoothOptions& solver = rig.session().solver_settings().smooth_options();
  SmoothOptions damped = solver, serial = solver;
  damped.damping = 0.1;
  serial.threads = 1;
  view.context.emit(action::EditSmoothOptions{difference(solver, damped)});
  view.context.emit(action::EditSmoothOptions{difference(solver, serial)});
  for (const Action& a : view.actions) rig.bench->apply(a);
  CHECK(rig.bench->view_control().options().legend != before.legend);
  CHECK(rig.bench->view_control().options().node_ids != before.node_ids);
  CHECK(rig.session().solver_settings().smooth_options().damping == 0.1);
  CHECK(rig.session().solver_settings().smooth_options().threads == 1);
}

namespace {

/// Ids of the rows in sight for what was typed, from above to below.
std::vector<std::string> rows_for(Rig& rig, const std::string& query) {
  rig.key(keys::p, {keys::control});
  REQUIRE(rig.visible("palette_query"));
  rig.type(query);
  rig.frames();
  std::vector<std::pair<double, std::string>> rows;
  for (const auto& [id, rect] : rig.bench->widgets().all())
    if (id.starts_with("palette/")) rows.emplace_back(rect.min.y(), id.substr(8));
  rig.key(keys::escape);
  std::ranges::sort(rows);
  std::vector<std::string> ids;
  for (auto& [y, id] : rows) ids.push_back(id);
  return ids;
}

bool among_first(const std::vector<std::string>& rows, const std::string& id, std::size_t count) {
  const auto end = rows.begin() + static_cast<std::ptrdiff_t>(std::min(count, rows.size()));
  return std::find(rows.begin(), end, id) != end;
}

}  // namespace

TEST_CASE("whole words count more than beginnings, those more than words of the same matter") {
  const auto e = search_score("case e", "Guided demos: Case E: Layers of quadrilaterals", "");
  const auto g = search_score("case e", "Guided demos: Case G: Main element deformed", "");
  REQUIRE(e.has_value());
  REQUIRE(g.has_value());
  CHECK(*e > *g);
  CHECK(*search_score("layers", "Insert layers...", "") > *search_score("layers", "Layered", ""));
  CHECK(*search_score("turn", "Turn", "") > *search_score("turn", "Rotate", "turn angle"));
  CHECK(search_score("turn", "Rotate", "turn angle").has_value());
  CHECK(search_score("layer", "Hold layers", "").has_value());
  CHECK(search_score("legnd", "Legend", "").has_value());  // by its letters
  CHECK_FALSE(search_score("zzz", "Legend", "view").has_value());
  CHECK(search_score("", "a", "") == search_score("", "b", ""));
}

TEST_CASE("the palette finds motions, layers, bodies and formats by their names") {
  Rig rig;
  rig.open(ring_mesh());
  CHECK(rows_for(rig, "case e").front() == "demo/E");
  CHECK(among_first(rows_for(rig, "rotate"), "rotate", 3));
  CHECK(among_first(rows_for(rig, "rotate"), "rotate_body/flap", 4));
  CHECK(among_first(rows_for(rig, "layers"), "hold_layers", 6));
  CHECK(among_first(rows_for(rig, "layers"), "insert_layers", 6));
  CHECK(rows_for(rig, "insert").front() == "insert_layers");
  CHECK(among_first(rows_for(rig, "select"), "select_all", 8));
  CHECK(among_first(rows_for(rig, "select"), "select/flap", 8));
  CHECK(among_first(rows_for(rig, "flap"), "select/flap", 4));
  CHECK(among_first(rows_for(rig, "vtu"), "Mesh.vtu", 3));
  CHECK(among_first(rows_for(rig, "vtu"), "open", 6));
}

TEST_CASE("a body is selected and about to be rotated from the palette") {
  Rig rig(1280, 900);
  rig.open(two_body_mesh());
  rig.key(keys::p, {keys::control});
  rig.type("rotate right");
  rig.key(keys::enter);
  rig.frames(4);
  CHECK(rig.session().selection().markers() == std::vector<Index>{rig.marker("right")});
  rig.type("30");  // the field has the keyboard
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const auto& move = std::get<MoveCommand>(rig.document().history().command(1));
  CHECK(move.bodies[0].markers == std::vector<std::string>{"right"});
  CHECK(move.bodies[0].motion.rotate == 30);
}

TEST_CASE("menus name the program's purpose: motion and layers") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("menu/Motion");
  for (const char* entry : {"menu/rotate", "menu/move", "menu/pivot", "menu/select", "menu/deform"})
    CHECK(rig.visible(entry));
  rig.key(keys::escape);
  rig.click("menu/Layers");
  for (const char* entry : {"menu/insert_layers", "menu/respace_layers", "menu/hold_layers"})
    CHECK(rig.visible(entry));
  rig.key(keys::escape);
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.frames();
  rig.click("menu/Layers");
  rig.click("menu/insert_layers");
  rig.frames(4);
  CHECK(rig.visible("layers/count"));  // unfolded
  rig.key(keys::a, {keys::control});
  rig.type("7");
  rig.key(keys::tab);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().layers().preview().wanted());
  CHECK(rig.session().layers().preview().wanted()->walls.front().spacing.count == 7);
}

TEST_CASE("in a volume mesh the layers of selected walls can be held, and held once") {
  Rig rig;
  rig.open(winslow::test::layered_cube(winslow::test::Volumes::prisms));
  rig.click("menu/Layers");
  CHECK(rig.visible("menu/hold_layers"));
  rig.key(keys::escape);
  CHECK(cannot_hold_layers(View(rig).context, {}) == "Select the walls first.");
  const std::vector<Index> floor{rig.marker("floor")};
  CHECK(cannot_hold_layers(View(rig).context, floor).empty());
  rig.bench->apply(action::SelectMarkers{floor});
  rig.frames();
  rig.click("menu/Layers");
  rig.click("menu/hold_layers");
  REQUIRE(rig.settle());
  CHECK(rig.document().state().held_walls == std::vector<std::string>{"floor"});
  CHECK(cannot_hold_layers(View(rig).context, floor) == "These layers are held already.");
}

namespace {

void open_palette(Rig& rig) {
  rig.key(keys::p, {keys::control});
  REQUIRE(rig.visible("palette_query"));
}

/// Row of the palette that lies highest on screen.
std::string top_row(const Rig& rig) {
  std::string best;
  double top = 1e9;
  for (const auto& [id, rect] : rig.bench->widgets().all())
    if (id.starts_with("palette/") && rect.min.y() < top) {
      top = rect.min.y();
      best = id.substr(8);
    }
  return best;
}

}  // namespace

TEST_CASE("the palette finds a command by a few letters and runs it") {
  Rig rig;
  rig.open(ring_mesh());
  open_palette(rig);
  rig.type("legnd");
  CHECK(top_row(rig) == "legend");
  const bool before = rig.bench->view_control().options().legend;
  rig.key(keys::enter);
  CHECK(rig.bench->view_control().options().legend != before);
  CHECK_FALSE(rig.visible("palette_query"));
}

TEST_CASE("arrow keys choose in the palette, Esc leaves it, a click runs a row") {
  Rig rig;
  rig.open(ring_mesh());
  open_palette(rig);
  rig.type("zzz");  // letters of no command
  CHECK(top_row(rig).empty());
  rig.key(keys::escape);
  CHECK_FALSE(rig.visible("palette_query"));
  open_palette(rig);
  rig.type("save");
  REQUIRE(top_row(rig) == "save");
  rig.key(GLFW_KEY_DOWN);
  rig.key(keys::enter);
  CHECK(rig.bench->dialogs().file_dialog().is_open());  // "Save as...", the row below
  rig.key(keys::escape);
  open_palette(rig);
  rig.type("nodes");
  rig.click("palette/nodes");
  CHECK(rig.bench->view_control().options().nodes);
}

TEST_CASE("a command that cannot be run is shown with the reason and does nothing") {
  Rig rig;
  open_palette(rig);
  rig.type("save as");
  CHECK(top_row(rig) == "save_as");
  rig.key(keys::enter);
  CHECK_FALSE(rig.bench->dialogs().file_dialog().is_open());
  CHECK(rig.visible("palette_query"));
  rig.key(keys::escape);
  rig.open(ring_mesh());
  open_palette(rig);
  rig.type("save as");
  rig.key(keys::enter);
  CHECK(rig.bench->dialogs().file_dialog().is_open());
}

TEST_CASE("the palette begins with what was run last") {
  Rig rig;
  rig.open(ring_mesh());
  open_palette(rig);
  CHECK(top_row(rig) == user_commands().front().id);
  rig.type("next style");
  rig.key(keys::enter);
  open_palette(rig);
  CHECK(top_row(rig) == "style");
  const ElementStyle before = style_of(rig.bench->view_control().options());
  rig.key(keys::enter);
  CHECK(style_of(rig.bench->view_control().options()) != before);
}

TEST_CASE("? and F1 show the keys, Esc, ? and any click put them away") {
  Rig rig;
  rig.type("?");
  REQUIRE(rig.visible("help/close"));
  rig.key(keys::escape);
  CHECK_FALSE(rig.visible("help/close"));
  rig.key(keys::f1);
  REQUIRE(rig.visible("help/close"));
  rig.type("?");
  CHECK_FALSE(rig.visible("help/close"));
  rig.type("?");
  rig.click(ScreenPoint(20, 400));
  CHECK_FALSE(rig.visible("help/close"));
}

TEST_CASE("the list of keys fits into the window") {
  Rig rig(1280, 720);
  rig.key(keys::f1);
  rig.frames(3);
  const auto foot = rig.bench->widgets().find("help/close");
  REQUIRE(foot.has_value());
  CHECK(foot->max.y() < 720 - 10);
  // Every group is there, in full.
  for (const char* group : {"File", "Edit", "Solver", "View", "Help", "Mouse"}) {
    const auto block = rig.bench->widgets().find(std::string("help/") + group);
    INFO("group ", group);
    REQUIRE(block.has_value());
    CHECK(block->min.x() > 10);
    CHECK(block->max.x() < 1280 - 10);
    CHECK(block->max.y() < foot->min.y() + 1);
  }
}

}  // namespace winslow::gui::test
