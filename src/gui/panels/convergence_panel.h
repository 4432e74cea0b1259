#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The convergence plot of the present job, or of the last one.
class ConvergencePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
