#pragma once

#include "gui/panels/layout.h"
#include "gui/widgets/ui_layer.h"

namespace winslow::gui {

/// The interface of a framebuffer: of the window, or of a picture with a size of its own.
struct WindowFrame {
  explicit WindowFrame(float scale) : ui(scale) {}

  UiLayer ui;
  Layout layout;
  int width = 1, height = 1;  ///< of the framebuffer, pixels
};

}  // namespace winslow::gui
