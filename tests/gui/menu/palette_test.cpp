#include <doctest/doctest.h>

#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

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
