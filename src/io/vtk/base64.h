#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace winslow::io::vtk {

/// Bytes of base64 text; white space is skipped, and several padded pieces may follow each other
/// (VTK encodes the header of an array apart from its data). Nothing if the text is malformed.
std::optional<std::string> decode_base64(std::string_view text);
std::string encode_base64(std::string_view bytes);

}  // namespace winslow::io::vtk
