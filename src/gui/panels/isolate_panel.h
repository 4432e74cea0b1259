#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Isolates the elements on one side of a threshold of the metric that is shown.
class IsolatePanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_threshold(const PanelContext& context, Isolation& isolation);
};

}  // namespace winslow::gui
