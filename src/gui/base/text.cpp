#include "gui/base/text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace winslow::gui {

std::string formatted(double value, const char* format) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

std::string grouped(long long value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return value < 0 ? "-" + digits : digits;
}

std::string joined(std::span<const std::string> texts, std::string_view between) {
  std::string all;
  for (const std::string& text : texts) all.append(all.empty() ? "" : between).append(text);
  return all;
}

std::string short_number(double value) { return formatted(value, "%.4g"); }

std::string table_number(double value) {
  if (!std::isfinite(value)) return "-";
  return formatted(value, std::abs(value) < 1000 ? "%.3f" : "%.2e");
}

}  // namespace winslow::gui
