#include <algorithm>

#include "gui/base/text.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

/// One mesh at a time: of several files dropped together, the first.
void Workbench::take_dropped(const InputState& input) {
  if (input.dropped.empty()) return;
  dropped_ = input.dropped.size();
  actions_.emplace_back(action::OpenMesh{input.dropped.front()});
}

/// Keeps the list of recent files in step with what is open.
void Workbench::follow_files(double seconds) {
  recent_.update(seconds);
  const Document* document = session_.document();
  const auto path = document ? document->path() : std::filesystem::path();
  if (path == shown_path_) return;
  shown_path_ = path;
  if (path.empty()) return;
  recent_.add(path);
  if (dropped_ > 1)
    session_.messages().tell(Notice::Kind::warning,
                             "Opened " + document->name() + ", the first of " +
                                 counted(dropped_, "file") +
                                 " that were dropped: the studio shows one mesh at a time.");
  dropped_ = 0;
}

}  // namespace winslow::gui
