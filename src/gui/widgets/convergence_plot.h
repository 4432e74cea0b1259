#pragma once

#include <imgui.h>

#include <optional>
#include <span>
#include <string_view>

#include "core/outer/outer_solver.h"

namespace winslow::gui {

/// A semilogarithmic plot of a convergence history: residual and largest move on the left axis, the
/// tolerance as a line, the number of inverted elements on the right. The mouse over it reads out
/// one iteration.
struct ConvergencePlot {
  std::span<const IterationRecord> history;
  std::optional<double> tolerance;
};

/// Draws the plot as an item of the current window. Returns the record under the mouse, if any.
std::optional<IterationRecord> draw_convergence_plot(std::string_view id,
                                                     const ConvergencePlot& plot,
                                                     const ImVec2& size, float scale);

}  // namespace winslow::gui
