#pragma once

#include <filesystem>
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

}  // namespace winslow::io
