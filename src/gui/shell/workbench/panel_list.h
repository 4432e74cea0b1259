#pragma once

#include "gui/shell/workbench/panel_registry.h"

namespace winslow::gui {

/// Every panel that has a place of its own in the window.
///
/// TO ADD A PANEL, add a line to the list in panel_list.cpp.
PanelRegistry make_panels();

}  // namespace winslow::gui
