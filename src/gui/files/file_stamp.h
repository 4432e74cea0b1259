#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace winslow::gui {

/// By what it is seen that a file was replaced or written to.
struct FileStamp {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t seconds = 0, nanoseconds = 0;  ///< of the last change of its content
  bool operator==(const FileStamp&) const = default;
};

/// Empty if there is no such file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path);

}  // namespace winslow::gui
