#pragma once

#include "gui/support/rig.h"

namespace winslow::gui::test {

/// Number of the last outer iteration on screen; -1 before the first.
inline int iterations(const Rig& rig) {
  const auto history = rig.session().mesh().convergence();
  return history.empty() ? -1 : history.back().iteration;
}

/// The solver has stopped between two iterations.
inline bool solver_paused(const Rig& rig) {
  const auto& snapshot = rig.session().job().snapshot();
  return snapshot && snapshot->state == JobState::paused;
}

}  // namespace winslow::gui::test
