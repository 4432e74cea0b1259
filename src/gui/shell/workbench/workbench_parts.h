#pragma once

#include "gui/base/input.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/files/recent_files.h"
#include "gui/settings/settings.h"
#include "gui/shell/workbench/regions.h"
#include "gui/view/navigation/view_control.h"

/// State of a workbench besides the session and the view: waiting keys, opened files, settings kept
/// between runs.
namespace winslow::gui {

/// Makes a key wait until the mesh resulting from the previous key was shown, since the user reacts
/// to the picture. LiveMesh::shape() identifies meshes.
class KeyGate {
 public:
  /// Whether the next frame takes keys from the queue.
  InputQueue::Keys keys() const {
    return seen_ >= wanted_ ? InputQueue::Keys::take : InputQueue::Keys::hold;
  }
  /// Call it after every frame. input: of that frame. shape: of the open mesh; none: no mesh. seen:
  /// shape of the mesh in the picture; none: no picture yet.
  void after_frame(const InputState& input, std::optional<std::uint64_t> shape,
                   std::optional<std::uint64_t> seen);

 private:
  std::bitset<512> down_;     // keys in the last frame
  std::uint64_t wanted_ = 0;  // shape when a key last went down
  std::uint64_t seen_ = 0;
};

/// Updates the list of recent files after files are opened, and handles files dropped on the
/// window. Of several dropped files only the first is opened.
class OpenedFiles {
 public:
  const RecentFiles& recent() const { return recent_; }
  RecentFiles& recent() { return recent_; }

  /// The action that opens the first of the files dropped in this frame; none without files.
  std::optional<Action> drop(const std::vector<std::filesystem::path>& files);
  /// Call it in every frame. seconds: since the last one.
  void update(Session& session, double seconds);

 private:
  RecentFiles recent_;
  std::filesystem::path shown_;  // the open mesh that is already in recent_
  std::size_t dropped_ = 0;      // number of files dropped together with the mesh being opened
};

/// The settings of a workbench to be kept between runs.
Settings settings_of(const ViewControl& view, const WindowFrame& window, const RecentFiles& recent);
/// Applies the settings kept from the last run.
void restore_settings(const Settings& settings, ViewControl& view, WindowFrame& window,
                      RecentFiles& recent);

}  // namespace winslow::gui
