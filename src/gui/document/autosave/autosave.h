#pragma once

#include "gui/base/background.h"
#include "gui/document/autosave/session_folder.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

/// Saves the session of a running studio in its profile, so that after a crash the next studio can
/// offer to restore it. All files are read and written on a separate thread.
class Autosave {
 public:
  /// profile: see WorkbenchOptions; empty: nothing is saved or offered.
  explicit Autosave(const std::filesystem::path& profile);

  /// Collects results of the thread, asks through the session about sessions left by earlier
  /// studios, and starts writing changes. Call once per frame. True if the session has news.
  bool update(Session& session);
  /// Files are being read or written, or tasks are pending.
  bool busy() const { return worker_.busy() || !tasks_.empty(); }

  void restore(const std::filesystem::path& folder);
  void discard(const std::filesystem::path& folder);
  /// For a regular exit: removes the saved session. Waits for the thread.
  void finish();

 private:
  /// The part of a task that runs on the thread of the interface.
  using Then = std::function<void(Session&)>;
  /// The session of a studio that no longer runs, locked by this studio.
  struct Orphan {
    std::filesystem::path folder;
    std::shared_ptr<FolderLock> lock;
    SessionSummary summary;
    std::string error;
  };
  /// The properties of a session that decide whether it must be written again.
  struct Mark {
    std::uint64_t generation = 0;
    std::size_t position = 0;
    std::vector<std::uint64_t> revisions;
    std::filesystem::path path;
    bool operator==(const Mark&) const = default;
  };

  void look_for_orphans();
  void ask_about_next(Session& session);
  void keep(const Session& session);
  void forget();
  static Mark mark_of(const Document& document, std::uint64_t generation);
  static std::vector<Orphan> find_orphans(const std::filesystem::path& root);

  std::filesystem::path root_;             // empty: off
  std::shared_ptr<SessionFolder> folder_;  // used only by tasks
  std::deque<Orphan> orphans_;             // newest first
  std::vector<Orphan> taken_over_;         // removed once saved in the folder of this studio
  std::uint64_t restored_generation_ = 0;  // of the mesh read from restored_mesh_
  std::filesystem::path restored_mesh_;
  Mark written_;
  bool complained_ = false;
  std::deque<std::function<Then()>> tasks_;
  Background<Then> worker_;
};

}  // namespace winslow::gui
