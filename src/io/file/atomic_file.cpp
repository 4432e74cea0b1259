#include "io/file/atomic_file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "io/file/gzip.h"

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

namespace {

namespace fs = std::filesystem;

/// A stream over a file descriptor that remembers why a write failed (std::ofstream forgets).
class DescriptorBuffer : public std::streambuf {
 public:
  explicit DescriptorBuffer(int fd) : fd_(fd) { setp(buffer_.data(), buffer_.data() + size); }
  int error() const { return error_; }

 protected:
  int_type overflow(int_type c) override {
    if (sync() != 0) return traits_type::eof();
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    return sputc(traits_type::to_char_type(c));
  }
  int sync() override {
    const char* from = pbase();
    while (from < pptr() && error_ == 0) {
      const ssize_t n = ::write(fd_, from, static_cast<std::size_t>(pptr() - from));
      if (n >= 0) {
        from += n;
      } else if (errno != EINTR) {
        error_ = errno;
      }
    }
    setp(buffer_.data(), buffer_.data() + size);
    return error_ == 0 ? 0 : -1;
  }

 private:
  static constexpr std::size_t size = 1 << 16;
  int fd_;
  int error_ = 0;
  std::array<char, size> buffer_{};
};

[[noreturn]] void fail(const fs::path& path, int error) {
  throw OutputError(path.string() + ": cannot be written: " + std::strerror(error));
}

/// Lets `write` fill a buffer; false if the buffer did not accept everything.
bool write_through(std::streambuf& buffer, const std::function<void(std::ostream&)>& write) {
  std::ostream out(&buffer);
  write(out);
  out.flush();
  return static_cast<bool>(out);
}

/// Fills the file behind `fd` and closes it. Throws OutputError, or what `write` throws.
void fill(int fd, const fs::path& path, bool flush_to_disk,
          const std::function<void(std::ostream&)>& write) {
  int error = 0;
  try {
    DescriptorBuffer buffer(fd);
    bool good = false;
    if (is_gzip_name(path)) {
      GzipBuffer gzip(buffer);
      good = write_through(gzip, write) && gzip.finish();
    } else {
      good = write_through(buffer, write);
    }
    error = buffer.error() != 0 ? buffer.error() : (good ? 0 : EIO);
    if (error == 0 && flush_to_disk && ::fsync(fd) != 0) error = errno;
  } catch (...) {
    ::close(fd);
    throw;
  }
  // Some file systems (network, quota) report only here that the data did not fit.
  if (::close(fd) != 0 && error == 0) error = errno;
  if (error != 0) fail(path, error);
}

/// The final target of a chain of symbolic links, which need not exist.
fs::path resolve(fs::path path) {
  constexpr int longest_chain = 40;
  std::error_code error;
  for (int i = 0; i < longest_chain && fs::is_symlink(path, error); ++i) {
    const fs::path next = fs::read_symlink(path, error);
    if (error) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

mode_t default_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

/// Prefix of the names of temporary files for a target. The target's name may have the maximum
/// length, so the prefix holds its hash (FNV-1a) instead.
std::string temporary_prefix(const fs::path& target) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : target.filename().string())
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), ".winslow-%016llx-",
                static_cast<unsigned long long>(hash));
  return text.data();
}

/// Removes abandoned temporary files of a target: those without the lock that a writer holds.
void remove_orphans(const fs::path& folder, const std::string& prefix) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!it->path().filename().string().starts_with(prefix)) continue;
    const int fd = ::open(it->path().c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0) continue;
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(it->path().c_str());
    ::close(fd);
  }
}

/// A temporary file, locked until it and `lock` are closed.
struct Temporary {
  std::string name;
  int fd = -1, lock = -1;
};

Temporary make_temporary(const fs::path& folder, const fs::path& target) {
  const std::string prefix = temporary_prefix(target);
  remove_orphans(folder, prefix);
  constexpr int attempts = 100;
  for (int i = 0; i < attempts; ++i) {
    Temporary file;
    file.name = (folder / (prefix + "XXXXXX")).string();
    file.fd = ::mkostemp(file.name.data(), O_CLOEXEC);
    if (file.fd < 0) fail(target, errno);
    // Another writer may hold the lock for a moment, to remove the file as an orphan: without
    // waiting for it, the file would vanish while it is written.
    while (::flock(file.fd, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat status {};
    if (::fstat(file.fd, &status) == 0 && status.st_nlink > 0) {
      file.lock = ::fcntl(file.fd, F_DUPFD_CLOEXEC, 0);
      return file;
    }
    ::close(file.fd);
  }
  fail(target, EBUSY);
}

/// A file that is written under a temporary name; commit() replaces its target.
class Replacement {
 public:
  Replacement(const fs::path& target, mode_t mode)
      : target_(target),
        folder_(target.has_parent_path() ? target.parent_path() : fs::path(".")),
        temporary_(make_temporary(folder_, target)) {
    if (::fchmod(temporary_.fd, mode) == 0) return;
    const int error = errno;
    ::close(temporary_.fd);
    discard();
    fail(target, error);
  }
  ~Replacement() {
    if (temporary_.lock >= 0) discard();
  }
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Call only once.
  void write(const std::function<void(std::ostream&)>& write) {
    fill(temporary_.fd, target_, true, write);
  }

  void commit() {
    if (::rename(temporary_.name.c_str(), target_.c_str()) != 0) fail(target_, errno);
    ::close(temporary_.lock);
    temporary_.lock = -1;
    // The renaming is safe only after the folder is flushed too. Not every file system supports
    // this, so errors are ignored.
    const int folder_fd = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder_fd >= 0) {
      ::fsync(folder_fd);
      ::close(folder_fd);
    }
  }

 private:
  void discard() {
    ::unlink(temporary_.name.c_str());
    ::close(temporary_.lock);
  }

  fs::path target_, folder_;
  Temporary temporary_;
};

/// The replacement for a path; null for a device or a pipe, which must be written directly. Throws
/// OutputError.
std::unique_ptr<Replacement> replacement_of(const fs::path& path) {
  const fs::path target = resolve(path);
  struct stat status {};
  if (::stat(target.c_str(), &status) != 0) {
    if (errno != ENOENT) fail(path, errno);
    if (target.filename().empty()) fail(path, EISDIR);
    return std::make_unique<Replacement>(target, default_mode());
  }
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  // A write-protected file in a writable folder could still be replaced, which no user expects.
  if (::access(target.c_str(), W_OK) != 0) fail(path, errno);
  if (!S_ISREG(status.st_mode)) return nullptr;
  return std::make_unique<Replacement>(target, status.st_mode & 07777);
}

}  // namespace

void write_atomically(const fs::path& path, const std::function<void(std::ostream&)>& write) {
  write_atomically(std::vector<OutputFile>{{path, write}});
}

void write_atomically(std::span<const OutputFile> files) {
  std::vector<std::unique_ptr<Replacement>> written;
  for (const OutputFile& file : files) {
    written.push_back(replacement_of(file.path));
    if (written.back()) {
      written.back()->write(file.write);
      continue;
    }
    const int fd = ::open(resolve(file.path).c_str(), O_WRONLY | O_CLOEXEC);
    if (fd < 0) fail(file.path, errno);
    fill(fd, file.path, false, file.write);
  }
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (written[k]) written[k]->commit();
    std::error_code ignored;
    for (const fs::path& other : files[k].replaces) fs::remove(other, ignored);
  }
}

}  // namespace winslow::io
