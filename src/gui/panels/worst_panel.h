#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The list of the worst elements: a click goes to one.
class WorstPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_choices(const PanelContext& context);
  void draw_steps(const PanelContext& context);
  void draw_list(const PanelContext& context);

  std::vector<WorstElement> list_;  // as drawn
  std::uint64_t list_generation_ = 0;
  ElementField list_field_ = Metric::normalized_jacobian;
  bool hovered_ = false;                 // in the last frame
  std::optional<MeshItem> scrolled_to_;  // the list is scrolled once to what comes into focus
};

}  // namespace winslow::gui
