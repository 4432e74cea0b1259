#include "io/file/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "core/error.h"

namespace winslow::io {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw OutputError("no folder for temporary files: " + error.message());
  std::string name = (parent / "winslow-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw OutputError(parent.string() +
                      ": a temporary folder cannot be made: " + std::strerror(errno));
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace winslow::io
