#pragma once

#include "gui/base/input.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/files/recent_files.h"
#include "gui/settings/settings.h"
#include "gui/shell/workbench/regions.h"
#include "gui/view/navigation/view_control.h"

/// What a workbench keeps from frame to frame beside the session and the view: keys that wait,
/// files that were opened, settings that outlive it.
namespace winslow::gui {

/// Has a key wait until the mesh that the key before it led to has been seen: the user answers to
/// what is in the picture. Meshes are told apart by LiveMesh::shape().
class KeyGate {
 public:
  /// Whether the next frame takes keys off the queue.
  InputQueue::Keys keys() const {
    return seen_ >= wanted_ ? InputQueue::Keys::take : InputQueue::Keys::hold;
  }
  /// After every frame. input: that it took. shape: of the open mesh; none: there is none. seen: of
  /// the mesh in the picture; none: there is no picture yet.
  void after_frame(const InputState& input, std::optional<std::uint64_t> shape,
                   std::optional<std::uint64_t> seen);

 private:
  std::bitset<512> down_;     // keys in the last frame
  std::uint64_t wanted_ = 0;  // the mesh when a key last went down
  std::uint64_t seen_ = 0;
};

/// The list of recent files in step with what is open, and files dropped on the window: one mesh at
/// a time, so of several the first is opened.
class OpenedFiles {
 public:
  const RecentFiles& recent() const { return recent_; }
  RecentFiles& recent() { return recent_; }

  /// Files that were dropped in this frame, if any: what opens the first of them.
  std::optional<Action> drop(const std::vector<std::filesystem::path>& files);
  /// In every frame. seconds: since the last one.
  void update(Session& session, double seconds);

 private:
  RecentFiles recent_;
  std::filesystem::path shown_;  // the mesh that stands in recent_
  std::size_t dropped_ = 0;      // files that the mesh being opened was dropped with
};

/// What of a workbench outlives it, as it would be kept now.
Settings settings_of(const ViewControl& view, const WindowFrame& window, const RecentFiles& recent);
/// The same, as it was kept from the last run.
void restore_settings(const Settings& settings, ViewControl& view, WindowFrame& window,
                      RecentFiles& recent);

}  // namespace winslow::gui
