#pragma once

#include <span>
#include <string>

#include "gui/menu/panel_context.h"
#include "gui/panels/layout.h"

/// The columns beside the mesh where they are folded: a strip of icons, each of which opens the
/// column at one of its parts.
namespace winslow::gui {

/// A tab of the column on the right.
struct SideTabInfo {
  SideTab which;
  std::string label, tooltip;
  Icon icon;
};
std::span<const SideTabInfo> side_tabs();

void draw_folded_left(const PanelContext& context, const Area& area);
void draw_folded_right(const PanelContext& context, const Area& area);
/// Handles at the columns' edges that fold them.
void draw_fold_handles(const PanelContext& context, const Layout& layout);

}  // namespace winslow::gui
