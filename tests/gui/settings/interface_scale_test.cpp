#include "gui/settings/interface_scale.h"

#include <doctest/doctest.h>

namespace winslow::gui::test {

TEST_CASE("The interface has the scale that was chosen, or else the screen's") {
  InterfaceScale scale(1.5f);
  scale.set_window(3000, 2000);
  CHECK(scale.of(0) == 1.5f);
  CHECK(scale.of(1.25) == 1.25f);
  scale.set_screen(2);
  CHECK(scale.of(0) == 2.0f);
}

TEST_CASE("A small window has the largest scale of the list that it has room for") {
  InterfaceScale scale(1);
  scale.set_window(1100, 720);  // room for 1.53 in width, 1.6 in height
  CHECK(scale.fitting(1.5) == 1.5f);
  CHECK(scale.fitting(3) == 1.5f);
  scale.set_window(1100, 560);
  CHECK(scale.fitting(3) == 1.1f);
  scale.set_window(100, 100);  // never less than the smallest
  CHECK(scale.fitting(3) == 0.75f);
}

}  // namespace winslow::gui::test
