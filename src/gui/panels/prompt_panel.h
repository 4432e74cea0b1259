#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The question or the error that waits for an answer, as a dialog.
class PromptPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
