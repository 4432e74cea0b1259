#include "gui/shell/workbench/workbench_parts.h"

#include <doctest/doctest.h>

namespace winslow::gui::test {

TEST_CASE("a key waits until the mesh that the last key led to is in the picture") {
  using Keys = InputQueue::Keys;
  KeyGate gate;
  CHECK(gate.keys() == Keys::take);
  InputState pressed;
  pressed.keys.set(65);
  gate.after_frame(pressed, 3, 2);
  CHECK(gate.keys() == Keys::hold);
  gate.after_frame(pressed, 4, 3);  // the key is held down still, and the mesh goes on
  CHECK(gate.keys() == Keys::take);
  gate.after_frame({}, 4, 3);
  CHECK(gate.keys() == Keys::take);
  gate.after_frame(pressed, 5, 3);
  CHECK(gate.keys() == Keys::hold);
}

TEST_CASE("without a mesh no key waits") {
  KeyGate gate;
  InputState pressed;
  pressed.keys.set(65);
  gate.after_frame(pressed, 3, {});
  CHECK(gate.keys() == InputQueue::Keys::hold);  // for the first picture
  gate.after_frame({}, {}, {});
  CHECK(gate.keys() == InputQueue::Keys::take);
}

}  // namespace winslow::gui::test
