#include "io/text/source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "io/file/gzip.h"
#include "io/text/numbers.h"

namespace winslow::io {
namespace {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail_open(const std::string& name, const std::string& reason) {
  throw InputError(name + ": cannot be read: " + reason);
}

std::string read_all(int fd, const std::string& name, std::size_t expected_size) {
  std::string bytes;
  bytes.reserve(expected_size);
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_open(name, std::strerror(errno));
    if (n == 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

/// Editors on Windows put a byte order mark before UTF-8 text. No binary format begins with its
/// bytes.
void remove_byte_order_mark(std::string& bytes, const std::string& name) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    throw InputError(name + ":1: found UTF-16 text, expected UTF-8 or ASCII");
  }
}

}  // namespace

Source Source::load(const std::filesystem::path& path) {
  const std::string name = path.string();
  const FileDescriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail_open(name, std::strerror(errno));
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_open(name, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail_open(name, "it is a directory, expected a mesh file");
  // A device such as /dev/zero has no end; a pipe is the user's own stream and has one.
  if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode)) {
    fail_open(name, "it is neither a file nor a pipe");
  }
  const auto size = S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0;
  std::string bytes = read_all(file.get(), name, size);
  if (is_gzip(bytes)) bytes = gunzip(bytes, name);
  remove_byte_order_mark(bytes, name);
  if (bytes.empty()) throw InputError(name + ":1: found an empty file, expected a mesh");
  return {name, std::move(bytes)};
}

Source::Range Source::append(const std::filesystem::path& path) {
  const Source other = load(path);
  // A separator, so that the end offset of one file differs from the begin of the next.
  if (!bytes_.empty()) bytes_ += '\n';
  const std::size_t begin = bytes_.size();
  bytes_ += other.bytes_;
  appended_.push_back({begin, other.name_, std::string::npos});
  return {begin, bytes_.size()};
}

void Source::set_binary(const Range& file, std::size_t offset) {
  for (Part& part : appended_)
    if (part.begin == file.begin) part.binary_from = offset;
}

std::string Source::where(std::size_t offset) const {
  if (!part_.empty()) return name_ + ": " + part_;
  offset = std::min(offset, bytes_.size());
  std::size_t begin = 0, binary_from = binary_from_;
  const std::string* name = &name_;
  for (const Part& part : appended_) {
    if (part.begin > offset) break;
    begin = part.begin;
    binary_from = part.binary_from;
    name = &part.name;
  }
  if (offset >= binary_from) return *name + ": byte " + std::to_string(offset - begin);
  // The end of a file that ends in a newline belongs to its last line.
  const bool at_end = offset == bytes_.size() || std::ranges::any_of(appended_, [&](const Part& p) {
                        return p.begin == offset + 1;
                      });
  if (at_end && offset > begin && bytes_[offset - 1] == '\n') --offset;
  const auto lines = std::count(bytes_.begin() + static_cast<std::ptrdiff_t>(begin),
                                bytes_.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
  return *name + ":" + std::to_string(lines + 1);
}

std::string Source::place(std::size_t offset) const {
  if (!part_.empty()) return part_;
  const std::string text = where(offset);
  const auto byte = text.rfind(": byte ");
  return byte != std::string::npos ? text.substr(byte + 2)
                                   : "line " + text.substr(text.rfind(':') + 1);
}

void Source::fail(std::size_t offset, const std::string& message) const {
  throw InputError(where(offset) + ": " + message);
}

void Source::fail(std::size_t offset, const std::string& found, const std::string& expected) const {
  fail(offset, "found " + found + ", expected " + expected);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown = "'";
  for (const char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return shown + (text.size() > longest ? "...'" : "'");
}

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

std::string Expected::text() const {
  std::string s = what;
  if (index >= 0) s += " " + std::to_string(index + 1);
  if (count >= 0) s += " of " + std::to_string(count);
  return s;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (is_blank(text.front()) || text.front() == '\n')) text.remove_prefix(1);
  while (!text.empty() && (is_blank(text.back()) || text.back() == '\n')) text.remove_suffix(1);
  return text;
}

std::size_t line_begin(std::string_view text, std::size_t offset) {
  const auto newline = text.rfind('\n', offset);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

std::string as_word(std::string name, std::string_view others) {
  std::ranges::replace(name, ' ', '_');
  return within_line(std::move(name), others);
}

std::string within_line(std::string name, std::string_view others) {
  const auto bad = [&](char c) {
    return static_cast<unsigned char>(c) < ' ' || others.find(c) != std::string_view::npos;
  };
  std::ranges::replace_if(name, bad, '_');
  return name;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return lower;
}

std::string_view Scanner::line() {
  const std::size_t begin = position_;
  std::size_t end = text_.find('\n', begin);
  position_ = end == std::string_view::npos ? text_.size() : end + 1;
  if (end == std::string_view::npos) end = text_.size();
  if (end > begin && text_[end - 1] == '\r') --end;
  return text_.substr(begin, end - begin);
}

void Scanner::skip_space() {
  while (position_ < text_.size() && (is_blank(text_[position_]) || text_[position_] == '\n')) {
    ++position_;
  }
}

std::string_view Scanner::word() {
  while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) && text_[position_] != '\n') {
    ++position_;
  }
  return text_.substr(begin, position_ - begin);
}

Index Scanner::index(const Expected& expected) {
  const auto found = word();
  const auto value = parse_integer(found);
  if (!value || *value < 0 || *value > std::numeric_limits<Index>::max()) fail(found, expected);
  return static_cast<Index>(*value);
}

Index Scanner::count(const Expected& expected, std::size_t bytes_each) {
  const auto found = word();
  const auto value = parse_integer(found);
  if (!value) fail(found, expected);
  return checked_count(source_, source_.offset_of(found), *value, bytes_each, bytes_left(),
                       expected);
}

void Scanner::end_line(const Expected& expected) {
  const auto extra = word();
  if (!extra.empty()) fail(extra, expected);
  if (!at_end()) ++position_;
}

void Scanner::fail(std::string_view found, const Expected& expected) const {
  fail(found, expected.text());
}

void Scanner::fail(std::string_view found, const std::string& expected) const {
  const std::size_t offset = source_.offset_of(found);
  if (!found.empty()) source_.fail(offset, in_quotes(found), expected);
  const char* end = offset >= source_.text().size() ? "the end of the file"
                    : offset >= text_.size()        ? "the end of the data"
                                                    : "the end of the line";
  source_.fail(offset, end, expected);
}

Index checked_count(const Source& source, std::size_t offset, std::int64_t count,
                    std::size_t bytes_each, std::size_t bytes_left, const Expected& expected) {
  if (count < 0) source.fail(offset, std::to_string(count), expected.text());
  // +1, because the last entry may lack its line end.
  const auto most = static_cast<std::int64_t>(bytes_left / bytes_each + 1);
  if (count > most) {
    source.fail(offset, std::to_string(count) + " as " + expected.text(),
                "no more than the " + std::to_string(most) +
                    " that the rest of the file can hold (a wrong count, or a truncated file)");
  }
  if (count > std::numeric_limits<Index>::max()) {
    source.fail(offset, std::to_string(count) + " as " + expected.text(), "at most 2147483647");
  }
  return static_cast<Index>(count);
}

}  // namespace winslow::io
