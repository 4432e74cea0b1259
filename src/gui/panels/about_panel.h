#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// What the studio is made of: versions, graphics, licence.
class AboutPanel : public Panel {
 public:
  void draw(const PanelContext& context) override;

  void open() { wanted_ = true; }
  /// A line a part: "OpenGL  4.5 ...". Needs a current OpenGL context.
  static std::vector<std::pair<std::string, std::string>> facts();

 private:
  bool wanted_ = false;
  std::vector<std::pair<std::string, std::string>> facts_;
};

}  // namespace winslow::gui
