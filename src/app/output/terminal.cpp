#include "app/output/terminal.h"

#include <cstddef>
#include <iostream>

namespace winslow::app {

std::string printable(std::string_view text) {
  std::string safe;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F are C2 80 to C2 9F in UTF-8; terminals obey some of them as well.
    const bool c1 = byte == 0xc2 && i + 1 < text.size() &&
                    (static_cast<unsigned char>(text[i + 1]) & 0xe0) == 0x80;
    if (c1) {
      safe += formatted("\\x%02x", static_cast<unsigned char>(text[++i]));
    } else if ((byte < 0x20 && byte != '\n') || byte == 0x7f) {
      safe += formatted("\\x%02x", byte);
    } else {
      safe += text[i];
    }
  }
  return safe;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings)
    std::cerr << "winslow: warning: " << printable(text) << '\n';
}

}  // namespace winslow::app
