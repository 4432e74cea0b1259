#include "core/mesh/place_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace winslow {

namespace {

std::string text_of(std::span<const double> components) {
  double size = 0;
  for (const double value : components) size = std::max(size, std::abs(value));
  constexpr int least = 6, most = 17, decimals = 4;
  int digits = least;
  if (std::isfinite(size) && size > 1)
    digits = std::clamp(static_cast<int>(std::log10(size)) + decimals, least, most);
  std::string text;
  for (const double value : components) {
    char number[40];
    std::snprintf(number, sizeof number, "%.*g", digits, value);
    text += (text.empty() ? "(" : ", ") + std::string(number);
  }
  return text + ")";
}

}  // namespace

std::string place_text(const Vec2& p) { return text_of({p.data(), 2}); }

std::string place_text(const Vec3& p) { return text_of({p.data(), 3}); }

std::string place_text(const Vec3& p, int dimension) {
  return text_of({p.data(), static_cast<std::size_t>(dimension)});
}

}  // namespace winslow
