#pragma once

#include "gui/panels/panel.h"
#include "gui/widgets/convergence_plot.h"

namespace winslow::gui {

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
