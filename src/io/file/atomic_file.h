#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>

namespace winslow::io {

/// Writes a file whole or not at all: `write` fills a temporary file in the same folder, which is
/// then flushed and renamed to `path`. Throws OutputError; the temporary file is gone then, as it
/// is when `write` throws, and one that a killed program left is removed by the next write of the
/// same name. A symbolic link is followed and a target's permissions are kept. A file called
/// "....gz" is compressed.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(std::ostream&)>& write);

}  // namespace winslow::io
