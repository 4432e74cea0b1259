#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The commands applied so far, to go back to any of them.
class HistoryPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_step(const PanelContext& context, std::size_t position);

  std::size_t shown_size_ = 0;  // a new step scrolls into view
};

}  // namespace winslow::gui
