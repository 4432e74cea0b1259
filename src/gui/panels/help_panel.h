#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// All keys and what the mouse does, over everything else; Esc or any click closes it.
class HelpPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

  void open() { wanted_ = true; }

 private:
  bool wanted_ = false;
};

}  // namespace winslow::gui
