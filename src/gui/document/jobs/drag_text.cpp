#include "gui/document/jobs/drag_text.h"

#include <cmath>

namespace winslow::gui {

std::string blocked_text(const BodyDrag& drag) {
  const auto& contact = drag.frame().contact;
  if (!contact) return drag.limit();
  if (contact->other == contact->moving) return "Blocked by the body itself";
  return contact->other.empty() ? "Blocked by an unnamed boundary"
                                : "Blocked by \"" + contact->other + '"';
}

std::string updating_text(const BodyDrag& drag) {
  const auto percent = static_cast<int>(std::floor(100 * drag.frame().share));
  return "Updating mesh... " + std::to_string(percent) + " %";
}

}  // namespace winslow::gui
