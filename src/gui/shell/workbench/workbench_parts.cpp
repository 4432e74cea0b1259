#include "gui/shell/workbench/workbench_parts.h"

#include "gui/base/text.h"

namespace winslow::gui {

void KeyGate::after_frame(const InputState& input, std::optional<std::uint64_t> shape,
                          std::optional<std::uint64_t> seen) {
  seen_ = seen.value_or(0);
  if (!shape)
    wanted_ = 0;
  else if ((input.keys & ~down_).any())
    wanted_ = *shape;
  down_ = input.keys;
}

std::optional<Action> OpenedFiles::drop(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return std::nullopt;
  dropped_ = files.size();
  return action::OpenMesh{files.front()};
}

void OpenedFiles::update(Session& session, double seconds) {
  recent_.update(seconds);
  const Document* document = session.document();
  const auto path = document ? document->path() : std::filesystem::path();
  if (path == shown_) return;
  shown_ = path;
  if (path.empty()) return;
  recent_.add(path);
  if (dropped_ > 1)
    session.messages().tell(Notice::Kind::warning,
                            "Opened " + document->name() + ", the first of " +
                                counted(dropped_, "file") +
                                " that were dropped: the studio shows one mesh at a time.");
  dropped_ = 0;
}

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
  // Use the screen's scale: the size of the window does not depend on the user's scale.
  settings.window = {static_cast<int>(std::lround(static_cast<float>(window.width) / scale)),
                     static_cast<int>(std::lround(static_cast<float>(window.height) / scale))};
  return settings;
}

void restore_settings(const Settings& settings, ViewControl& view, WindowFrame& window,
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
