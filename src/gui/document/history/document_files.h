#pragma once

#include <set>
#include <utility>

#include "gui/files/file_kinds.h"
#include "io/format/mesh_file.h"

namespace winslow::gui {

/// The file that a mesh was opened from, as it was read.
struct SourceFile {
  std::filesystem::path path;
  std::optional<FileStamp> stamp;  ///< empty: no file is known that holds just that
  std::shared_ptr<const io::FormatDetails> details;
  std::vector<std::string> warnings;

  /// Numbers of its zones; empty: the file is one mesh.
  std::span<const int> zones() const;
  /// The one that is open; 0: the file is one mesh.
  int zone() const;
  /// "zone 2 of 3"; empty: the file is one mesh.
  std::string zone_text() const;
};

/// Where a mesh is saved, and which of its revisions (EditHistory::revision()) need no saving.
class SavedFile {
 public:
  explicit SavedFile(std::filesystem::path path) : path_(std::move(path)) {}

  /// Where the mesh is saved, or else came from.
  const std::filesystem::path& path() const { return path_; }
  /// Where to save it from now on; nothing is saved there yet.
  void set_path(std::filesystem::path path) { path_ = std::move(path); }
  /// This revision was written to that file, to which it is saved from now on.
  void mark_saved(const std::filesystem::path& path, std::uint64_t revision);
  /// This revision is no work of the user's: there is nothing to save.
  void mark_shown_only(std::uint64_t revision) { shown_only_.insert(revision); }

  /// This revision has changes of the user's that are saved nowhere.
  bool lacks(std::uint64_t revision) const {
    return revision != saved_revision_ && !shown_only_.contains(revision);
  }
  /// The mesh was written to that file before: it may be replaced without asking.
  bool wrote(const std::filesystem::path& path) const;

 private:
  std::filesystem::path path_;
  std::uint64_t saved_revision_ = 0;
  std::set<std::uint64_t> shown_only_;  // that a demo made
  std::set<std::filesystem::path> written_;
};

/// The file that holds all zones of a mesh: where it is saved if those went along, else its source.
const std::filesystem::path& zone_file(const SourceFile& source, const SavedFile& saved);

}  // namespace winslow::gui
