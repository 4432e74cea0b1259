#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The keys and the mouse, as a dialog.
class HelpPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

  void open() { wanted_ = true; }

 private:
  bool wanted_ = false;
};

}  // namespace winslow::gui
