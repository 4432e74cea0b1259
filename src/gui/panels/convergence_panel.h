#pragma once

#include <imgui.h>

#include "core/outer/outer_solver.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Which curves are drawn.
struct PlotSeries {
  bool residual = true, move = true, inverted = true, sine = true;
};

/// A convergence history: residual and largest move on a logarithmic axis with the tolerance as a
/// line; below, where there is room, the number of inverted elements (left axis) and the smallest
/// sine (right axis). The mouse over it reads out one iteration.
struct ConvergencePlot {
  std::span<const IterationRecord> history;
  std::optional<double> tolerance;
  PlotSeries series;
};

/// One line that names the curves; a click shows or hides one. Its entries have the ids
/// ID/residual, ID/move, ID/inverted and ID/sine. True if one was clicked.
bool draw_convergence_key(std::string_view id, PlotSeries& series, float scale);

/// Draws the plot as an item of the current window. Returns the record under the mouse, if any.
std::optional<IterationRecord> draw_convergence_plot(std::string_view id,
                                                     const ConvergencePlot& plot,
                                                     const ImVec2& size, float scale);

/// The iterations of the job under way, or of the command that led to the present mesh.
class ConvergencePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
  /// No step of the history has iterations to show: a strip is enough.
  static bool empty(const PanelContext& context);

 private:
  void draw_header(const PanelContext& context);
  static void draw_strip(const PanelContext& context);

  PlotSeries series_;
};

}  // namespace winslow::gui
