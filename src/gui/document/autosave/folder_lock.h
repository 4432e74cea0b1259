#pragma once

#include <filesystem>
#include <optional>

namespace winslow::gui {

/// A folder that belongs to one running studio. The lock goes with the process, however that ends,
/// so a folder that can be locked has no owner.
class FolderLock {
 public:
  /// None where another studio (or this one) holds the folder, or it cannot be locked.
  static std::optional<FolderLock> take(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace winslow::gui
