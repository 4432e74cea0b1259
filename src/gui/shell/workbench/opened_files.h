#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/files/recent_files.h"

namespace winslow::gui {

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

}  // namespace winslow::gui
