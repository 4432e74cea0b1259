#pragma once

#include "gui/menu/panel_context.h"
#include "gui/panels/layers/layer_forms.h"
#include "gui/panels/layers/layer_lists.h"

namespace winslow::gui {

/// Layers at walls: what they are to be like, where they will stand, and how they came out.
class LayersPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void follow(const PanelContext& context);
  void draw_settings(const PanelContext& context);
  void draw_walls(const PanelContext& context);
  void draw_corners();
  void draw_insertion(const PanelContext& context);
  void draw_plan(const PanelContext& context);
  void draw_status(const PanelContext& context);
  void draw_choices(const PanelContext& context);
  void draw_in_place(const PanelContext& context);
  LayersCommand command(const PanelContext& context, LayerTask task) const;
  LayersCommand in_place(const PanelContext& context, LayerTask task) const;

  SpacingForm form_;
  PartForm part_;
  WallList walls_;
  ColumnList columns_;
  LayerResult result_;
  LayerOptions corners_;
  bool control_ = true, preview_ = true;
  bool open_ = false;               // the settings are
  std::uint64_t generation_ = 0;    // of the mesh that the walls are of
  std::vector<std::string> names_;  // markers selected
  std::vector<std::string> shown_;  // of the wall whose settings the form has; empty: no wall's
};

}  // namespace winslow::gui
