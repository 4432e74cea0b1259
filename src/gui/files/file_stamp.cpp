#include "gui/files/file_stamp.h"

#include <sys/stat.h>

namespace winslow::gui {

std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileStamp{
      static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino),
      static_cast<std::uint64_t>(found.st_size), static_cast<std::int64_t>(found.st_mtim.tv_sec),
      static_cast<std::int64_t>(found.st_mtim.tv_nsec)};
}

}  // namespace winslow::gui
