#pragma once

#include "gui/menu/panel_context.h"
#include "gui/panels/marker_roles.h"

namespace winslow::gui {

/// The markers of the mesh: colour, whether they are drawn, whether the mouse may take them, and
/// whether they move or stay.
class MarkersPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_row(const PanelContext& context, Index marker);
  std::optional<Index> begin_popup(const PanelContext& context, const char* popup) const;
  bool draw_colors(const PanelContext& context);
  void draw_other_color(const PanelContext& context);
  void draw_surface(const PanelContext& context, Index marker) const;

  MarkerRoles roles_;
  std::string coloured_;  // marker whose colour is being chosen
};

}  // namespace winslow::gui
