#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace winslow::app {

/// What printf() would print, cut off after 199 characters.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 200> buffer;
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

}  // namespace winslow::app
