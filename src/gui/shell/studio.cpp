#include "gui/shell/studio.h"

#include <cstdlib>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "gui/settings/settings.h"
#include "gui/shell/window.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

namespace {

// Tooltips appear after a delay, so frames continue for a while after the last event.
constexpr double settle_seconds = 0.6;
constexpr double busy_wait = 1.0 / 60;
constexpr double idle_wait = 0.5;

/// Runs frames until the window is closed; draws only if something has changed.
class StudioLoop {
 public:
  StudioLoop(Window& window, Workbench& workbench) : window_(window), workbench_(workbench) {}

  void run() {
    while (!workbench_.session().files().quit_accepted()) {
      const bool lively =
          workbench_.session().working() || recording() || window_.time() < draw_until_;
      const bool events = window_.wait(lively ? busy_wait : idle_wait);
      if (window_.take_close_request()) workbench_.apply(action::Quit{});
      const bool news = workbench_.poll();
      if (events || news) draw_until_ = window_.time() + settle_seconds;
      if (window_.time() < draw_until_ || !workbench_.settled() || recording()) frame();
    }
  }

 private:
  bool recording() const {
    return workbench_.capture().recorder().state() != Recorder::State::idle;
  }

  void frame() {
    if (window_.width() <= 0 || window_.height() <= 0) return;  // minimised
    const double now = window_.time();
    workbench_.set_scale(window_.scale());
    window_.connect_clipboard();
    workbench_.update(window_.input(), window_.width(), window_.height(), now - last_frame_);
    last_frame_ = now;
    workbench_.paint();
    window_.set_title(workbench_.title());
    window_.set_cursor(workbench_.cursor());
    window_.show();
  }

  Window& window_;
  Workbench& workbench_;
  double draw_until_ = settle_seconds;
  double last_frame_ = 0;
};

/// The folder for the program's own files (XDG Base Directory Specification).
std::filesystem::path profile_folder() {
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name);
    return value && *value ? value : "";
  };
  if (auto given = variable("WINSLOW_PROFILE"); !given.empty()) return given;
  if (const auto config = variable("XDG_CONFIG_HOME"); config.is_absolute())
    return config / "winslow";
  const auto home = variable("HOME");
  return home.is_absolute() ? home / ".config" / "winslow" : std::filesystem::path();
}

/// The requested size, or that of the last run, or the default.
std::array<int, 2> window_size(const StudioOptions& options, const Settings& settings) {
  if (options.width > 0 && options.height > 0) return {options.width, options.height};
  if (settings.window[0] > 0) return settings.window;
  return {1440, 900};
}

}  // namespace

void run_studio(const StudioOptions& options) {
  return_freed_memory();
  const auto profile = profile_folder();
  const std::array<int, 2> size = window_size(options, SettingsFile(profile).initial());
  Window window(size[0], size[1], "winslow");
  Workbench workbench({window.scale(), profile});
  if (options.mesh) workbench.apply(action::OpenMesh{*options.mesh, false, options.reading});
  StudioLoop(window, workbench).run();
}

void return_freed_memory() {
#if defined(__GLIBC__)
  // A fixed threshold also keeps glibc from raising it to the size of freed arrays.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  mallopt(M_TRIM_THRESHOLD, 2 << 20);
#endif
}

}  // namespace winslow::gui
