#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// How the mesh is coloured and drawn.
class ViewPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  bool draw_color(const PanelContext& context, ViewOptions& view);
  bool draw_map(ViewOptions& view);
  bool draw_range(const PanelContext& context, ViewOptions& view);
  bool draw_elements(ViewOptions& view, bool in_space);
  bool draw_boundary(ViewOptions& view);
  bool draw_ids(ViewOptions& view);
  bool draw_roles(ViewOptions& view);
  bool draw_space(ViewOptions& view);
  bool draw_comparison(ViewOptions& view);
  bool draw_magnifier(const PanelContext& context, ViewOptions& view);
  bool draw_appearance(ViewOptions& view);
};

}  // namespace winslow::gui
