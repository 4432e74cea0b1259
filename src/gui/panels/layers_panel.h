#pragma once

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Layers at walls: what they are to be like, where they will stand, and how they came out.
class LayersPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_spacing();
  void draw_y_plus();
  void draw_corners();
  void draw_insertion(const PanelContext& context);
  void draw_plan(const PanelContext& context);
  void draw_result(const PanelContext& context);
  void draw_cut_columns(const PanelContext& context, const LayerStack& stack);
  LayerOptions options(const PanelContext& context) const;
  std::vector<double> wanted_heights() const;

  LayerSpacing spacing_;
  LayerOptions corners_;
  double total_ = 0.1;
  bool has_total_ = false, from_y_plus_ = false, control_ = true, preview_ = true;
  double y_plus_ = 1, reynolds_ = 1e6, length_ = 1;
};

}  // namespace winslow::gui
