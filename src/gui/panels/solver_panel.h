#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// How the mesh is smoothed, and the switches to run, pause, step and cancel.
class SolverPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_state(const PanelContext& context);
  void draw_buttons(const PanelContext& context);
  bool draw_options(SmoothOptions& options);
  bool draw_variational(SmoothOptions& options);
  bool draw_pointwise(SmoothOptions& options);
};

}  // namespace winslow::gui
