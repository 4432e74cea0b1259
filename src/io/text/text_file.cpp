#include "io/text/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace winslow::io {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw InputError(path.string() + ": cannot be read: " + reason);
}

/// Errno of the first failure; 0: the file was read to its end, or beyond `most_bytes`.
int read_all(int fd, std::size_t most_bytes, std::string& text) {
  std::array<char, 1 << 16> buffer;
  while (text.size() <= most_bytes) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n == 0) return 0;
    if (n < 0 && errno != EINTR) return errno;
    if (n > 0) text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return 0;
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, std::size_t most_bytes) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) fail(path, std::strerror(errno));
  struct stat status {};
  int error = ::fstat(fd, &status) != 0 ? errno : 0;
  const bool readable = S_ISREG(status.st_mode) || S_ISFIFO(status.st_mode);
  std::string text;
  if (error == 0 && readable) error = read_all(fd, most_bytes, text);
  ::close(fd);
  if (error != 0) fail(path, std::strerror(error));
  if (S_ISDIR(status.st_mode))
    throw InputError(path.string() + ": found a folder, expected a file");
  if (!readable) fail(path, "it is neither a file nor a pipe");
  if (text.size() > most_bytes)
    fail(path, "it has more than " + std::to_string(most_bytes) + " bytes");
  return text;
}

bool nested_deeper(std::string_view json, int deepest) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == ']' || c == '}') --depth;
    if ((c == '[' || c == '{') && ++depth > deepest) return true;
  }
  return false;
}

}  // namespace winslow::io
