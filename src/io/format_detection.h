#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/mesh_file.h"

namespace winslow::io {

/// Format that an extension stands for, in any case of letters.
std::optional<Format> format_of_extension(const std::filesystem::path& path);
/// Format that the first bytes (and the size) of a file speak for.
std::optional<Format> format_of_content(std::string_view content);
/// ".su2, .msh, ..." for messages.
std::string supported_extensions();

}  // namespace winslow::io
