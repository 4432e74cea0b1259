#include "core/mesh/place_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace winslow {

std::string place_text(const Vec2& p) {
  const double size = p.cwiseAbs().maxCoeff();
  constexpr int least = 6, most = 17, decimals = 4;
  int digits = least;
  if (std::isfinite(size) && size > 1)
    digits = std::clamp(static_cast<int>(std::log10(size)) + decimals, least, most);
  char text[80];
  std::snprintf(text, sizeof text, "(%.*g, %.*g)", digits, p.x(), digits, p.y());
  return text;
}

}  // namespace winslow
