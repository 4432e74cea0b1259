#include "gui/document/jobs/drag_text.h"

#include <cmath>

namespace winslow::gui {

std::string blocked_text(const EdgePair& contact) {
  if (contact.other == contact.moving) return "Blocked by the body itself";
  return contact.other.empty() ? "Blocked by an unnamed boundary"
                               : "Blocked by \"" + contact.other + '"';
}

std::string blocked_text(const BodyDrag& drag) {
  if (!drag.error().empty()) return "The mesh cannot follow any further";
  const auto& contact = drag.frame().contact;
  return contact ? blocked_text(*contact) : "No valid mesh was found";
}

std::string updating_text(const BodyDrag& drag) {
  const auto percent = static_cast<int>(std::floor(100 * drag.frame().share));
  return "Updating mesh... " + std::to_string(percent) + " %";
}

}  // namespace winslow::gui
