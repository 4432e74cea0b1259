#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/types.h"
#include "io/support/files.h"
#include "support/random.h"

/// Damage for files that readers have to survive.
namespace winslow::test {

/// How often each file is damaged: `usual`, or the number in WINSLOW_MUTATIONS for long runs.
inline std::uint64_t mutation_count(std::uint64_t usual) {
  const char* wanted = std::getenv("WINSLOW_MUTATIONS");
  return wanted ? std::strtoull(wanted, nullptr, 10) : usual;
}

/// Numbers that tend to break readers.
inline std::string nasty_number(Random& random) {
  static const std::vector<std::string> numbers{
      "-1",    "0",   "2147483648", "4294967296", "9223372036854775807",  "99999999999999999999",
      "1e308", "nan", "-inf",       "1e-400",     "18446744073709551615", "",
      "x",     "\"",  "0x7f"};
  return numbers[at(random.index(static_cast<Index>(numbers.size())))];
}

inline std::string mutated(std::string text, Random& random) {
  const Index times = 1 + random.index(4);
  for (Index k = 0; k < times && !text.empty(); ++k) {
    const auto size = static_cast<Index>(text.size());
    const auto place = at(random.index(size));
    switch (random.index(7)) {
      case 0:
        text[place] = static_cast<char>(random.index(256));
        break;
      case 1:
        text[place] = static_cast<char>(text[place] ^ (1 << random.index(8)));
        break;
      case 2:
        text.resize(place);
        break;
      case 3:
        text.insert(place, 1, static_cast<char>(random.index(256)));
        break;
      case 4:
        text.erase(place, at(random.index(20)));
        break;
      case 5:  // a piece moves to another place
        text.insert(at(random.index(size)), text.substr(place, at(random.index(40))));
        break;
      default: {  // a word becomes a nasty number
        const auto begin = text.find_first_of(" \n\"", place);
        if (begin == std::string::npos) break;
        const auto end = std::min(text.find_first_of(" \n\"", begin + 1), text.size());
        text.replace(begin + 1, end - begin - 1, nasty_number(random));
      }
    }
  }
  return text;
}

/// Reads a damaged mesh, and writes and reads what it gave. Returns false where it was refused.
/// root: what the error begins with.
inline bool survives(const std::filesystem::path& mesh, const std::filesystem::path& root,
                     const std::filesystem::path& again) {
  try {
    const io::MeshFile file = io::read_mesh(mesh);
    io::write_mesh(again, file.mesh, file.details.get());
    CHECK(io::read_mesh(again).mesh.topology->element_count() ==
          file.mesh.topology->element_count());
    return true;
  } catch (const InputError& error) {
    const std::string what = error.what();
    CHECK(what.find(root.string()) == 0);
    CHECK(what.size() < 1000);
    return false;
  }
}

}  // namespace winslow::test
