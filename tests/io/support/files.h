#pragma once

#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/error.h"
#include "io/format/mesh_file.h"

namespace winslow::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Like CHECK(contains(TEXT, PART)), but shows the text.
#define CHECK_CONTAINS(TEXT, PART)                         \
  do {                                                     \
    const std::string shown_text = TEXT;                   \
    CHECK_MESSAGE(contains(shown_text, PART), shown_text); \
  } while (false)

/// A folder that is gone when the test is over.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    // In memory where that is possible: writers flush to disk, which thousands of tests would feel.
    const std::filesystem::path memory = "/dev/shm";
    const auto parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    std::string name = (parent / "winslow_io_XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  REQUIRE(out.good());
}

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Reads a mesh from text as if it were a file of that name.
inline io::MeshFile read_from_text(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / name, text);
  return io::read_mesh(folder / name);
}

inline bool any_contains(const std::vector<std::string>& texts, const std::string& part) {
  for (const auto& text : texts) {
    if (contains(text, part)) return true;
  }
  return false;
}

/// What the InputError says when the text is read; without the folder. Fails if there is none.
inline std::string input_error(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  write_text(folder / name, text);
  try {
    io::read_mesh(folder / name);
  } catch (const InputError& error) {
    const std::string what = error.what();
    const std::string prefix = folder.path().string() + "/";
    REQUIRE(what.substr(0, prefix.size()) == prefix);
    return what.substr(prefix.size());
  }
  FAIL("no InputError for ", name, ":\n", text);
  return {};
}

/// The text with one part, which must be there, replaced by another.
inline std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const auto at = text.find(part);
  REQUIRE_MESSAGE(at != std::string::npos, part);
  return text.replace(at, part.size(), by);
}

}  // namespace winslow::test
