#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The quality table: minimum, average and maximum of each metric, as loaded and now; the worst
/// elements.
class QualityPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_table(const PanelContext& context);
  void draw_worst(const PanelContext& context);
};

}  // namespace winslow::gui
