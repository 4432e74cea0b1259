#pragma once

#include "gui/base/screen.h"
#include "gui/panels/panel.h"
#include "gui/panels/picture/picture_settings.h"

namespace winslow::gui {

/// What a picture shows and how large it is; its file is chosen next.
class PictureDialog : public Panel {
 public:
  void open() { wanted_ = opened_ = true; }
  /// On screen, pixels: of the window, and of the mesh alone.
  void set_extents(const ScreenVector& window, const ScreenVector& mesh);
  void draw(const PanelContext& context) override;

 private:
  bool wanted_ = false, opened_ = false;
  ScreenVector window_{1, 1}, mesh_{1, 1};
  PictureSettings settings_;
};

}  // namespace winslow::gui
