#pragma once

#include <string>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// One line: the mesh, its quality, what the solver does.
class StatusBar : public Panel {
 public:
  void draw(const PanelContext& context) override;
  /// What is under way: "Solving: 35 % of the motion, iteration 12".
  static std::string state_text(const Session& session);
};

}  // namespace winslow::gui
