#pragma once

#include <string>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The markers of the mesh: colour, whether they are drawn, whether the mouse may take them, and
/// whether they move or stay.
class MarkersPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_row(const PanelContext& context, Index marker);
  void draw_colors(const PanelContext& context);

  std::string coloured_;  // marker whose colour is being chosen
};

}  // namespace winslow::gui
