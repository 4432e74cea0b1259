#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace winslow::io {

/// A private temporary folder, for libraries that need a file name. Only this user can read it; the
/// destructor deletes the folder and its content.
class TemporaryFolder {
 public:
  /// Throws OutputError if the folder cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Writes a file whole or not at all: `write` fills a temporary file in the same folder, which is
/// then flushed and renamed to `path`. Throws OutputError. The temporary file is removed on any
/// error; one left by a killed program is removed by the next write of the same name. Follows a
/// symbolic link and keeps the target's permissions. Compresses a file called "....gz".
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write);

struct OutputFile {
  std::filesystem::path path;
  std::function<void(std::ostream&)> write;
  std::vector<std::filesystem::path> replaces = {};  ///< other files to remove, if they exist
};
/// The same for files that belong together: all are written before the first is renamed.
void write_atomically(std::span<const OutputFile> files);

}  // namespace winslow::io
