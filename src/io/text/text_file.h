#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace winslow::io {

/// The bytes of a text file, such as a recipe or settings. Throws InputError for a folder, for a
/// device (/dev/zero has no end), and for more than `most_bytes`.
std::string read_text_file(const std::filesystem::path& path,
                           std::size_t most_bytes = std::size_t{1} << 30);

/// True if the arrays and objects of a JSON text lie in each other more than `deepest` levels deep.
/// A parser that calls itself for each level would run out of stack on "[[[[...".
bool nested_deeper(std::string_view json, int deepest);

}  // namespace winslow::io
