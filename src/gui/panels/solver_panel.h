#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// How the mesh is smoothed, and the switches to run, pause, step, cancel and go back.
class SolverPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_method(const PanelContext& context);
  void draw_pace(const PanelContext& context);
  void draw_state(const PanelContext& context);
  void draw_steps(const PanelContext& context);
  void draw_resets(const PanelContext& context);
  void draw_options(const PanelContext& context);

  int steps_ = 10;
};

}  // namespace winslow::gui
