#include "core/strategy/run_end.h"

namespace winslow {

bool gains_no_more(const SmoothResult& result) {
  const bool ended_by_newton =
      !result.history.empty() && result.history.back().stage == Stage::newton;
  return ended_by_newton && !result.converged && !result.out_of_iterations &&
         result.inverted == 0 && result.fraction_reached >= 1 && result.limited_by.empty();
}

}  // namespace winslow
