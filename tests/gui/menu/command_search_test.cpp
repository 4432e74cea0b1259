#include "gui/menu/command_search.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

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
  CHECK(move.markers == std::vector<std::string>{"right"});
  CHECK(move.motion.rotate == 30);
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
  REQUIRE(rig.session().jobs().layer_preview().wanted());
  CHECK(rig.session().jobs().layer_preview().wanted()->walls.front().spacing.count == 7);
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
