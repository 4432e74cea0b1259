#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The quality table as in the paper: minimum, average and maximum of each metric, before and now
/// side by side.
class QualityPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_choice(const PanelContext& context);
  void draw_table(const PanelContext& context);
};

}  // namespace winslow::gui
