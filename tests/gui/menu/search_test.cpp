#include <doctest/doctest.h>

#include <algorithm>

#include "gui/menu/command_search.h"
#include "gui/support/keys.h"
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

}  // namespace winslow::gui::test
