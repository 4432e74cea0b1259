#include "core/strategy/run_end.h"

#include <algorithm>

namespace winslow {

bool gains_no_more(const SmoothResult& result) {
  // What comes after the solution, to raise the worst element, is no part of how it ended.
  const auto last = std::find_if(result.history.rbegin(), result.history.rend(),
                                 [](const IterationRecord& r) { return r.stage != Stage::worst; });
  const bool ended_by_newton = last != result.history.rend() && last->stage == Stage::newton;
  return ended_by_newton && !result.converged && !result.out_of_iterations &&
         result.inverted == 0 && result.fraction_reached >= 1 && result.limited_by.empty();
}

}  // namespace winslow
