#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The recording under way: how many frames there are, how far the film is.
class RecordingPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;
};

}  // namespace winslow::gui
