#pragma once

#include <string>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// The commands applied so far: to go back to any of them, to change one and run those after it
/// again, to write them as a recipe.
class HistoryPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_steps(const PanelContext& context);
  void draw_step(const PanelContext& context, std::size_t position);
  void draw_menu(const PanelContext& context, std::size_t position);
  void draw_buttons(const PanelContext& context);
  void draw_recipes(const PanelContext& context);
  void draw_queue(const PanelContext& context);
  void draw_kept(const PanelContext& context);

  std::size_t shown_size_ = 0;  // a new step scrolls into view
};

}  // namespace winslow::gui
