#include "gui/shell/workbench/opened_files.h"

#include "gui/base/text.h"

namespace winslow::gui {

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

}  // namespace winslow::gui
