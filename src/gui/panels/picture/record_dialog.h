#pragma once

#include <optional>

#include "gui/base/screen.h"
#include "gui/panels/panel.h"
#include "gui/panels/picture/picture_settings.h"

namespace winslow::gui {

/// How the mesh is recorded; where to is chosen next.
class RecordDialog : public Panel {
 public:
  /// step: of the history, that is to be carried out again and recorded.
  void open(std::optional<std::size_t> step);
  /// On screen, pixels: of the window, and of the mesh alone.
  void set_extents(const ScreenVector& window, const ScreenVector& mesh);
  void draw(const PanelContext& context) override;

 private:
  bool wanted_ = false, opened_ = false;
  std::optional<std::size_t> step_;
  ScreenVector window_{1, 1}, mesh_{1, 1};
  PictureSettings settings_;
  RecordingSpec spec_;
};

}  // namespace winslow::gui
