#include "core/outer/outer_solver.h"

namespace winslow {

std::string_view stage_name(Stage stage) {
  constexpr std::array<std::string_view, 6> names{"picard", "untangle", "relax",
                                                  "path",   "newton",   "worst"};
  return names[static_cast<std::size_t>(stage)];
}

}  // namespace winslow
