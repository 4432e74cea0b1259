#include "gui/base/text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace winslow::gui {

namespace {

std::string formatted(const char* format, double value) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace

std::string grouped(long long value) {
  std::string digits = std::to_string(value < 0 ? -value : value);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, ",");
  return value < 0 ? "-" + digits : digits;
}

std::string short_number(double value) { return formatted("%.4g", value); }

std::string table_number(double value) {
  if (!std::isfinite(value)) return "-";
  return formatted(std::abs(value) < 1000 ? "%.3f" : "%.2e", value);
}

}  // namespace winslow::gui
