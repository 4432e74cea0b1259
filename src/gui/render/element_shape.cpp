#include "gui/render/element_shape.h"

#include <algorithm>

namespace winslow::gui {

bool is_inverted(const Coordinates& coordinates, std::span<const Index> corners) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const double area = twice_area(coordinates.xy(corners[k]), coordinates.xy(corners[(k + 1) % n]),
                                   coordinates.xy(corners[(k + n - 1) % n]));
    if (!(area > 0)) return true;
    if (n == 3) break;
  }
  return false;
}

std::array<int, 6> cut_quadrilateral(const Coordinates& coordinates,
                                     std::span<const Index> corners) {
  const std::array<Vec2, 4> p{coordinates.xy(corners[0]), coordinates.xy(corners[1]),
                              coordinates.xy(corners[2]), coordinates.xy(corners[3])};
  const double along_02 = std::min(twice_area(p[0], p[1], p[2]), twice_area(p[0], p[2], p[3]));
  const double along_13 = std::min(twice_area(p[0], p[1], p[3]), twice_area(p[1], p[2], p[3]));
  if (along_02 <= 0 && along_13 > along_02) return {0, 1, 3, 1, 2, 3};
  return {0, 1, 2, 0, 2, 3};
}

}  // namespace winslow::gui
