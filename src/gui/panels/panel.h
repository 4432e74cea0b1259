#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// A part of the studio: draws itself into the current ImGui window from a view of the session and
/// emits actions. No panel knows another.
class Panel {
 public:
  virtual ~Panel() = default;
  virtual void draw(const PanelContext& context) = 0;
};

}  // namespace winslow::gui
