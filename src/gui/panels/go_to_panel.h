#pragma once

#include <array>
#include <string>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Goes to a node or an element by its id, and says what it is.
class GoToPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

 private:
  void draw_field(const PanelContext& context);
  void draw_item(const PanelContext& context);

  std::array<char, 128> text_{};
  std::string error_;
};

}  // namespace winslow::gui
