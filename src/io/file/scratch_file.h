#pragma once

#include <filesystem>
#include <string_view>

namespace winslow::io {

/// Bytes in a file that lies in memory and in no folder, for libraries that open files by name.
/// Nothing of it stays, however the program ends.
class ScratchFile {
 public:
  /// Throws OutputError if there is no memory for it.
  explicit ScratchFile(std::string_view bytes);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// A name by which this process can open the file; other processes cannot.
  std::filesystem::path path() const;

 private:
  int fd_;
};

}  // namespace winslow::io
