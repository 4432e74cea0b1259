#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

namespace winslow::io {

/// A folder of our own for libraries that want the name of a file: nobody else may look into it,
/// and it is gone with all that is in it when this object is.
class TemporaryFolder {
 public:
  /// Throws OutputError where it cannot be made.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Writes a file whole or not at all: `write` fills a temporary file in the same folder, which is
/// then flushed and renamed to `path`. Throws OutputError; the temporary file is gone then, as it
/// is when `write` throws, and one that a killed program left is removed by the next write of the
/// same name. A symbolic link is followed and a target's permissions are kept. A file called
/// "....gz" is compressed.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write);

struct OutputFile {
  std::filesystem::path path;
  std::function<void(std::ostream&)> write;
  std::filesystem::path replaces = {};  ///< another file that is removed, if it is there
};
/// The same for files that belong together: none takes its place before all are written.
void write_atomically(std::span<const OutputFile> files);

}  // namespace winslow::io
