#pragma once

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// Why the layers at these markers cannot be held now, as UserCommand::blocked.
std::string cannot_hold_layers(const PanelContext& context, const std::vector<Index>& markers);
/// Keeps the heights of the layers at these markers, whatever moves.
void hold_layers(const PanelContext& context, const std::vector<Index>& markers);

}  // namespace winslow::gui
