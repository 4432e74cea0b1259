#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The markers of the mesh: colour, number of edges, and whether they move or stay.
class MarkersPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_row(const PanelContext& context, Index marker);
};

}  // namespace winslow::gui
