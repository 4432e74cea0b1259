#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// One line: the mesh, its quality, what the solver does.
class StatusBar : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
