#include "io/file/scratch_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace winslow::io {
namespace {

/// Errno of the first failure; 0: everything was written.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno != EINTR) return errno;
    if (n > 0) bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

}  // namespace

ScratchFile::ScratchFile(std::string_view bytes) : fd_(::memfd_create("winslow", MFD_CLOEXEC)) {
  const int error = fd_ < 0 ? errno : write_all(fd_, bytes);
  if (error == 0) return;
  if (fd_ >= 0) ::close(fd_);
  throw OutputError(std::string("a temporary file cannot be written: ") + std::strerror(error));
}

ScratchFile::~ScratchFile() { ::close(fd_); }

std::filesystem::path ScratchFile::path() const { return "/proc/self/fd/" + std::to_string(fd_); }

}  // namespace winslow::io
