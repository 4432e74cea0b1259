#include <doctest/doctest.h>

#include <filesystem>
#include <set>

#include "gui/menu/command_search.h"
#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"

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
  const SmoothOptions& solver = rig.session().jobs().smooth_options();
  SmoothOptions damped = solver, serial = solver;
  damped.damping = 0.1;
  serial.threads = 1;
  view.context.emit(action::EditSmoothOptions{difference(solver, damped)});
  view.context.emit(action::EditSmoothOptions{difference(solver, serial)});
  for (const Action& a : view.actions) rig.bench->apply(a);
  CHECK(rig.bench->view_control().options().legend != before.legend);
  CHECK(rig.bench->view_control().options().node_ids != before.node_ids);
  CHECK(rig.session().jobs().smooth_options().damping == 0.1);
  CHECK(rig.session().jobs().smooth_options().threads == 1);
}

}  // namespace winslow::gui::test
