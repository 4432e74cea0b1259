#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace winslow::io {

/// The bytes of an input file, and how to name a place in it in an error message.
class Source {
 public:
  /// Reads a file whole; one that gzip compressed is unpacked, a byte order mark left out. Throws
  /// InputError: no such file, a directory, not readable, empty.
  static Source load(const std::filesystem::path& path);
  Source(std::string name, std::string bytes) : name_(std::move(name)), bytes_(std::move(bytes)) {}

  const std::string& name() const { return name_; }
  /// Reads another file, as load() does, behind what there is: a mesh may be in several. Views into
  /// text() are no longer good then.
  struct Range {
    std::size_t begin, end;
  };
  Range append(const std::filesystem::path& path);
  std::string_view text() const { return bytes_; }
  /// Offset in the file of a view into text().
  std::size_t offset_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - bytes_.data());
  }

  /// From this offset on the (first) file is binary: places are named by byte instead of by line.
  void set_binary_from(std::size_t offset) { binary_from_ = offset; }
  /// Of a file whose parts have names instead of lines ("/Base/Zone/ZoneBC" of CGNS): the one that
  /// is being read, by which places are named from now on.
  void set_part(std::string part) { part_ = std::move(part); }

  /// "FILE:LINE" (lines count from 1), "FILE: byte N" (bytes count from 0) or "FILE: PART".
  std::string where(std::size_t offset) const;
  /// Throws InputError "FILE:LINE: message".
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const;
  /// Throws InputError "FILE:LINE: found FOUND, expected EXPECTED".
  [[noreturn]] void fail(std::size_t offset, const std::string& found,
                         const std::string& expected) const;

 private:
  std::string name_;
  std::string bytes_;
  std::size_t binary_from_ = std::string::npos;
  struct Part {
    std::size_t begin;
    std::string name;
  };
  std::vector<Part> appended_;
  std::string part_;
};

/// A piece of a file fit for a message: quoted, shortened, without control characters.
std::string in_quotes(std::string_view text);

}  // namespace winslow::io
