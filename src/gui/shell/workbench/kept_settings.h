#pragma once

#include "gui/files/recent_files.h"
#include "gui/settings/settings.h"
#include "gui/shell/workbench/regions.h"
#include "gui/view/navigation/view_control.h"

/// What of a workbench outlives it.
namespace winslow::gui {

/// As it would be kept now.
Settings settings_of(const ViewControl& view, const WindowFrame& window, const RecentFiles& recent);
/// As it was kept from the last run.
void take_settings(const Settings& settings, ViewControl& view, WindowFrame& window,
                   RecentFiles& recent);

}  // namespace winslow::gui
