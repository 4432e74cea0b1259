#pragma once

#include "core/command/history.h"
#include "gui/document/history/document.h"
#include "gui/files/file_kinds.h"

namespace winslow::gui {

/// A folder that belongs to one running studio. The lock goes with the process, however that ends,
/// so a folder that can be locked has no owner.
class FolderLock {
 public:
  /// None where another studio (or this one) holds the folder, or it cannot be locked.
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

/// A session as it is to be written: shares the meshes with the document.
struct SessionRecord {
  std::uint64_t generation = 0;    ///< of the open mesh
  std::filesystem::path source;    ///< the file that was opened
  std::filesystem::path path;      ///< where it is saved
  std::filesystem::path mesh;      ///< what to copy the mesh as opened from
  std::optional<FileStamp> stamp;  ///< of that file as it was read
  History history;
  std::vector<EditHistory::Tag> tags;  ///< of each position
  int zone = 0;                        ///< of a file of several zones: the one that is open
};

/// Writes one running studio's session into a folder of its own: a copy of the mesh file as it was
/// opened (or the mesh itself, where that file is another one by now), a file for each step, and a
/// manifest that names them, written last and whole. Works on a thread other than the interface's,
/// one call at a time.
class SessionFolder {
 public:
  /// The folder is made by the first write, below this one.
  explicit SessionFolder(std::filesystem::path root) : root_(std::move(root)) {}

  /// Writes what is not there yet and removes what is no longer needed. Throws OutputError.
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

/// What the manifest of a folder says, for the question whether to restore it.
struct SessionSummary {
  std::string name;  ///< of the mesh file
  std::size_t commands = 0;
  std::string time;  ///< "2026-11-21 14:05"
};

constexpr const char* manifest_name = "session.json";

/// Throws InputError.
SessionSummary read_summary(const std::filesystem::path& folder);
/// What the mesh as it was opened is kept in. Throws InputError.
std::filesystem::path kept_mesh(const std::filesystem::path& folder);
/// Reads a session with all its meshes. Steps from the first damaged one on are left out, and
/// `damage` says so. Throws Error where nothing can be restored.
RestoredSession read_session(const std::filesystem::path& folder);

}  // namespace winslow::gui
