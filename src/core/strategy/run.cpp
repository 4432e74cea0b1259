#include "core/strategy/run.h"

namespace winslow {

std::string why_incomplete(const SmoothResult& result) {
  if (result.contact) return describe(*result.contact);
  if (!result.limited_by.empty()) return result.limited_by + " beyond";
  if (result.out_of_iterations) return "the limit of iterations was reached";
  std::string text = "no valid mesh was found beyond";
  if (result.gap) text += "; " + describe(*result.gap);
  return text;
}

}  // namespace winslow
