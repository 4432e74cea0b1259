#include "gui/shell/workbench/key_gate.h"

namespace winslow::gui {

void KeyGate::after_frame(const InputState& input, std::optional<std::uint64_t> shape,
                          std::optional<std::uint64_t> seen) {
  seen_ = seen.value_or(0);
  if (!shape)
    wanted_ = 0;
  else if ((input.keys & ~down_).any())
    wanted_ = *shape;
  down_ = input.keys;
}

}  // namespace winslow::gui
