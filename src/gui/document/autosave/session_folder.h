#pragma once

#include "core/command/history.h"
#include "gui/document/history/document.h"
#include "gui/files/file_kinds.h"

namespace winslow::gui {

/// The lock of a folder that belongs to one running studio. The lock ends with the process, even
/// after a crash, so a folder that can be locked has no owner.
class FolderLock {
 public:
  /// None if a studio (this one included) already holds the folder, or if locking fails.
  static std::optional<FolderLock> acquire(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

/// A session to be written. Shares the meshes with the document.
struct SessionRecord {
  std::uint64_t generation = 0;    ///< of the open mesh
  std::filesystem::path source;    ///< the file that was opened
  std::filesystem::path path;      ///< the file to which it is saved
  std::filesystem::path mesh;      ///< file from which to copy the mesh as opened
  std::optional<FileStamp> stamp;  ///< of that file as it was read
  History history;
  std::vector<EditHistory::Tag> tags;  ///< of each position
  io::ReadOptions reading = {};  ///< of the mesh as opened; the open zone, if there are several
};

/// Writes the session of one running studio into a separate folder. The folder holds a copy of the
/// mesh file as opened, or the mesh itself if that file has changed since. It also holds a file per
/// step, and a manifest of all files, written last and atomically. For a thread other than the
/// interface's, one call at a time.
class SessionFolder {
 public:
  /// The first write creates the folder below `root`.
  explicit SessionFolder(std::filesystem::path root) : root_(std::move(root)) {}

  /// Writes missing files and removes files no longer needed. Throws OutputError.
  void write(const SessionRecord& session);
  /// Removes the folder: the session ended well.
  void remove();
  const std::filesystem::path& path() const { return path_; }

 private:
  void make();
  std::string keep_start(const SessionRecord& session);

  std::filesystem::path root_, path_;
  std::optional<FolderLock> lock_;
  std::set<std::string> written_;  // names of files
};

/// Summary of a folder's manifest, for the question whether to restore the session.
struct SessionSummary {
  std::string name;  ///< of the mesh file
  std::size_t commands = 0;
  std::string time;  ///< "2026-11-21 14:05"
};

constexpr const char* manifest_name = "session.json";

/// Throws InputError.
SessionSummary read_summary(const std::filesystem::path& folder);
/// The file that holds the mesh as opened. Throws InputError.
std::filesystem::path kept_mesh(const std::filesystem::path& folder);
/// Reads a session with all its meshes. Omits the first damaged step and all later ones, and
/// reports this in `damage`. Throws Error if nothing can be restored.
RestoredSession read_session(const std::filesystem::path& folder);

}  // namespace winslow::gui
