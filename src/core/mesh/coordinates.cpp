#include "core/mesh/coordinates.h"

#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace winslow {

Coordinates::Coordinates(int dimension, Index node_count) : dimension_(dimension) {
  if (dimension != 2 && dimension != 3) {
    throw UsageError("coordinates in " + std::to_string(dimension) +
                     " dimensions, expected 2 or 3");
  }
  values_.resize(offset(node_count, dimension), 0.0);
}

void Coordinates::refuse(int expected) const {
  const auto name = [](int dimension) { return dimension == 2 ? "the plane" : "space"; };
  throw UsageError(std::string("found points of ") + name(dimension_) + ", expected points of " +
                   name(expected));
}

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
