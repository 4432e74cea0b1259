#include "gui/document/autosave/archive.h"

#include <cerrno>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace winslow::gui {

void ArchiveReader::fail(const std::string& found) const {
  throw InputError(path_.string() + ": found " + found + ", expected a saved step");
}

std::size_t ArchiveReader::length(std::size_t size) {
  std::uint64_t count = 0;
  number(count);
  if (count > left_.size() / size) fail("a length beyond its end");
  return count;
}

std::string_view ArchiveReader::next_bytes(std::size_t count) {
  if (count > left_.size()) fail("an early end");
  const std::string_view taken = left_.substr(0, count);
  left_.remove_prefix(count);
  return taken;
}

std::string checked_content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::uint64_t expected = 0;
  if (bytes.size() < sizeof expected)
    throw InputError(path.string() + ": found " + std::to_string(bytes.size()) +
                     " bytes, expected a saved step");
  const std::size_t size = bytes.size() - sizeof expected;
  std::memcpy(&expected, bytes.data() + size, sizeof expected);
  bytes.resize(size);
  Checksum sum;
  sum.add(bytes.data(), bytes.size());
  if (sum.value() != expected)
    throw InputError(path.string() + ": found another checksum than it had when it was written");
  return bytes;
}

}  // namespace winslow::gui
