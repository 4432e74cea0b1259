#include <doctest/doctest.h>

#include <fstream>

#include "gui/panels/files/file_dialog.h"
#include "gui/support/keys.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

TEST_CASE("Ctrl+Z in a field that is entered again takes nothing back from another text") {
  Rig rig;
  rig.open(ring_mesh());
  rig.click("marker/flap");
  // Shown with six digits when the field is left: shorter than what was typed.
  rig.click("motion/dx");
  rig.key(keys::a, {keys::control});
  rig.type("0.12345678901234");
  rig.key(keys::tab);
  rig.click("motion/dx");
  for (int i = 0; i < 12; ++i) rig.key(keys::z, {keys::control});
  rig.key(GLFW_KEY_END);
  rig.type("5");
  rig.key(keys::tab);
  rig.click("motion/apply");
  REQUIRE(rig.settle());
  REQUIRE(rig.document().history().size() == 2);
  const RigidMotion motion =
      std::get<MoveCommand>(rig.document().history().command(1)).motion.about({0, 0});
  CHECK(motion.translate.x() == doctest::Approx(0.1234575).epsilon(1e-12));
  CHECK(motion.translate.y() == 0);
}

TEST_CASE("Ctrl+Z after a name was taken from the list keeps the dialog whole") {
  Rig rig;
  write(rig.folder, ring_mesh(), "a.su2");
  rig.key(keys::o, {keys::control});
  REQUIRE(rig.bench->dialogs().file_dialog().is_open());
  rig.type(rig.folder.path().string() + "/");
  REQUIRE(rig.wait([&] {
    return !rig.bench->dialogs().file_dialog().busy() &&
           rig.bench->dialogs().file_dialog().folder() == rig.folder.path();
  }));
  rig.key(keys::z, {keys::control});  // the path was taken out of the field
  rig.type("a name longer than that of the file");
  rig.key(GLFW_KEY_DOWN);
  for (int i = 0; i < 3; ++i) rig.key(keys::z, {keys::control});
  rig.key(GLFW_KEY_DOWN);
  rig.key(keys::enter);
  REQUIRE(rig.settle());
  REQUIRE(rig.session().document() != nullptr);
  CHECK(rig.document().name() == "a.su2");
}

}  // namespace winslow::gui::test
