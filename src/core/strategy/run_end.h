#pragma once

#include "core/strategy/run.h"

namespace winslow {

/// A run has ended valid before its tolerance and its limit of iterations: Newton's method found no
/// way down any more, or one that gains next to nothing (EnergyNewton::stalled()).
bool gains_no_more(const SmoothResult& result);

}  // namespace winslow
