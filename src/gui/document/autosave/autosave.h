#pragma once

#include "gui/base/background.h"
#include "gui/document/autosave/session_folder.h"
#include "gui/document/session/session.h"

namespace winslow::gui {

/// Keeps the session of a running studio below its profile, so that after a crash the next one can
/// offer it back. All files are read and written on a thread of their own.
class Autosave {
 public:
  /// profile: see WorkbenchOptions; empty: nothing is kept and nothing offered.
  explicit Autosave(const std::filesystem::path& profile);

  /// Collects what the thread has done, asks through the session about what earlier studios left,
  /// and has written what has changed. Call once a frame. True if the session has news.
  bool update(Session& session);
  /// Files are being read or written, or are about to be.
  bool busy() const { return worker_.busy() || !tasks_.empty(); }

  void restore(const std::filesystem::path& folder);
  void discard(const std::filesystem::path& folder);
  /// The studio ends as it should: removes what was kept of its session. Waits for the thread.
  void finish();

 private:
  /// What a task leaves to be done on the thread of the interface.
  using Then = std::function<void(Session&)>;
  /// The session of a studio that is gone, locked by this one.
  struct Orphan {
    std::filesystem::path folder;
    std::shared_ptr<FolderLock> lock;
    SessionSummary summary;
    std::string error;
  };
  /// What of a session makes a difference to what is written.
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
  std::shared_ptr<SessionFolder> folder_;  // used by tasks alone
  std::deque<Orphan> orphans_;             // newest first
  std::vector<Orphan> taken_over_;         // to go when this studio has them in its own folder
  std::uint64_t restored_generation_ = 0;  // of the mesh that came from restored_mesh_
  std::filesystem::path restored_mesh_;
  Mark written_;
  bool complained_ = false;
  std::deque<std::function<Then()>> tasks_;
  Background<Then> worker_;
};

}  // namespace winslow::gui
