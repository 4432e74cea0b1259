#include "gui/document/autosave/autosave.h"

#include <thread>

#include "core/error.h"
#include "gui/base/text.h"

namespace winslow::gui {

namespace fs = std::filesystem;

Autosave::Autosave(const fs::path& profile) {
  if (profile.empty()) return;
  root_ = profile / "autosave";
  folder_ = std::make_shared<SessionFolder>(root_);
  look_for_orphans();
}

std::vector<Autosave::Orphan> Autosave::find_orphans(const fs::path& root) {
  std::vector<std::pair<fs::file_time_type, Orphan>> found;
  std::error_code error;
  for (fs::directory_iterator it(root, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const fs::path manifest = it->path() / manifest_name;
    if (!fs::exists(manifest, ignored)) continue;
    auto lock = FolderLock::acquire(it->path());
    if (!lock) continue;  // its studio is running
    Orphan orphan{it->path(), std::make_shared<FolderLock>(std::move(*lock)), {}, {}};
    try {
      orphan.summary = read_summary(it->path());
    } catch (const Error& problem) {
      orphan.error = problem.what();
    }
    found.emplace_back(fs::last_write_time(manifest, ignored), std::move(orphan));
  }
  std::sort(found.begin(), found.end(),
            [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Orphan> orphans;
  for (auto& [time, orphan] : found) orphans.push_back(std::move(orphan));
  return orphans;
}

void Autosave::look_for_orphans() {
  tasks_.push_back([this, root = root_]() -> Then {
    return [this, found = find_orphans(root)](Session& session) {
      orphans_.assign(found.begin(), found.end());
      ask_about_next(session);
    };
  });
}

void Autosave::ask_about_next(Session& session) {
  if (orphans_.empty()) return;
  const Orphan& orphan = orphans_.front();
  if (!orphan.error.empty()) {
    session.messages().ask(
        {Prompt::Kind::error,
         "A session from before cannot be restored",
         "It was saved when the studio ended without being closed, but its files are "
         "damaged.\n" +
             orphan.error,
         {{"Delete it", {action::DiscardSession{orphan.folder}}, false}, {"Keep it", {}, true}}});
    return;
  }
  const SessionSummary& s = orphan.summary;
  session.messages().ask({Prompt::Kind::question,
                          "Restore the session?",
                          "The studio ended without being closed. Restore the session of " +
                              s.name + " (" + counted(s.commands, "command") + ", " + s.time + ")?",
                          {{"Restore", {action::RestoreSession{orphan.folder}}, true},
                           {"Discard", {action::DiscardSession{orphan.folder}}, false},
                           {"Not now", {}, false}}});
}

bool Autosave::update(Session& session) {
  if (root_.empty()) return false;
  bool news = false;
  if (auto then = worker_.poll()) {
    news = static_cast<bool>(*then);
    if (news) (*then)(session);
  }
  if (!busy()) keep(session);
  if (worker_.busy() || tasks_.empty()) return news;
  worker_.start(std::move(tasks_.front()));
  tasks_.pop_front();
  return news;
}

Autosave::Mark Autosave::mark_of(const Document& document, std::uint64_t generation) {
  Mark mark{generation, document.history().position(), {}, document.path()};
  for (const EditHistory::Tag& tag : document.edits().tags())
    mark.revisions.push_back(tag.revision);
  return mark;
}

/// Starts writing the session if it has changed.
void Autosave::keep(const Session& session) {
  const Document* document = session.document();
  if (!document) return forget();
  // While commands are rerun after an edit, the saved history remains the one before the edit.
  if (session.jobs().queue().active() && session.jobs().queue().plan().revision) return;
  Mark mark = mark_of(*document, session.generation());
  if (mark == written_) return;
  written_ = std::move(mark);
  const fs::path source = fs::absolute(document->source().path);
  const bool restored = session.generation() == restored_generation_;
  SessionRecord record{session.generation(),           source,
                       fs::absolute(document->path()), restored ? restored_mesh_ : source,
                       document->source().stamp,       document->history(),
                       document->edits().tags()};
  const auto details = document->source().details;
  record.reading = document->source().reading;
  if (details && !details->zones.empty()) record.reading.zone = details->zone;
  tasks_.push_back([this, folder = folder_, record = std::move(record),
                    done = std::exchange(taken_over_, {})]() -> Then {
    try {
      folder->write(record);
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what()), done](Session& s) {
        taken_over_.insert(taken_over_.end(), done.begin(), done.end());
        if (!std::exchange(complained_, true))
          s.messages().tell(Notice::Kind::warning,
                            "The session is not kept for the case of a crash: " + text);
      };
    }
    std::error_code ignored;
    for (const Orphan& orphan : done) fs::remove_all(orphan.folder, ignored);
    return {};
  });
}

/// Removes the saved session after the mesh was closed and its changes were saved or discarded.
void Autosave::forget() {
  if (written_ == Mark{}) return;
  written_ = {};
  tasks_.push_back([folder = folder_]() -> Then {
    folder->remove();
    return {};
  });
}

void Autosave::restore(const fs::path& folder) {
  const auto it = std::find_if(orphans_.begin(), orphans_.end(),
                               [&](const Orphan& o) { return o.folder == folder; });
  if (it == orphans_.end()) return;
  tasks_.push_back([this, orphan = *it]() -> Then {
    try {
      auto restored = std::make_shared<RestoredSession>(read_session(orphan.folder));
      return [this, orphan, restored, mesh = kept_mesh(orphan.folder)](Session& session) {
        session.files().restore(std::move(*restored));
        // The opened file may have been removed or changed since.
        restored_generation_ = session.generation();
        restored_mesh_ = mesh;
        taken_over_.push_back(orphan);
        std::erase_if(orphans_, [&](const Orphan& o) { return o.folder == orphan.folder; });
      };
    } catch (const std::exception& error) {
      return [orphan, text = std::string(error.what())](Session& session) {
        session.messages().ask({Prompt::Kind::error,
                                "The session of " + orphan.summary.name + " cannot be restored",
                                text,
                                {{"Delete it", {action::DiscardSession{orphan.folder}}, false},
                                 {"Keep it", {}, true}}});
      };
    }
  });
}

void Autosave::discard(const fs::path& folder) {
  const auto it = std::find_if(orphans_.begin(), orphans_.end(),
                               [&](const Orphan& o) { return o.folder == folder; });
  if (it == orphans_.end()) return;
  tasks_.push_back([this, orphan = *it]() -> Then {
    std::error_code ignored;
    fs::remove(orphan.folder / manifest_name, ignored);
    fs::remove_all(orphan.folder, ignored);
    return [this](Session& session) { ask_about_next(session); };
  });
  orphans_.erase(it);
}

void Autosave::finish() {
  if (root_.empty()) return;
  tasks_.clear();
  while (worker_.busy() && !worker_.poll())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  folder_->remove();
}

}  // namespace winslow::gui
