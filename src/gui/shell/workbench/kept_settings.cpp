#include "gui/shell/workbench/kept_settings.h"

#include <cmath>

namespace winslow::gui {

Settings settings_of(const ViewControl& view, const WindowFrame& window,
                     const RecentFiles& recent) {
  Settings settings;
  settings.view = view.options();
  settings.left_width = window.layout.left_width;
  settings.right_width = window.layout.right_width;
  settings.plot_height = window.layout.plot_height;
  settings.folded = window.ui.folded();
  settings.views = view.space().views(view.options());
  settings.recent = recent.paths();
  const float scale = view.scale().screen();
  // The screen's own scale: a window has its size whatever the user makes of what is in it.
  settings.window = {static_cast<int>(std::lround(static_cast<float>(window.width) / scale)),
                     static_cast<int>(std::lround(static_cast<float>(window.height) / scale))};
  return settings;
}

void take_settings(const Settings& settings, ViewControl& view, WindowFrame& window,
                   RecentFiles& recent) {
  view.set_options(settings.view);
  if (settings.left_width > 0) window.layout.left_width = settings.left_width;
  if (settings.right_width > 0) window.layout.right_width = settings.right_width;
  if (settings.plot_height > 0) window.layout.plot_height = settings.plot_height;
  window.ui.folded() = settings.folded;
  view.space().set_views(settings.views);
  recent.set(settings.recent);
}

}  // namespace winslow::gui
