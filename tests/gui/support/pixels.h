#pragma once

#include <algorithm>
#include <cmath>

#include "gui/base/screen.h"
#include "gui/render/image.h"

namespace winslow::gui::test {

/// Mean of red, green and blue of a pixel, 0 to 1.
inline double brightness(const Image& image, const ScreenPoint& at) {
  const auto* p =
      image.pixel(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
  return (p[0] + p[1] + p[2]) / (3 * 255.0);
}

/// How many pixels of a box differ between two pictures.
inline int differing(const Image& a, const Image& b, const ScreenPoint& min,
                     const ScreenPoint& max) {
  int count = 0;
  for (int y = static_cast<int>(min.y()); y < static_cast<int>(max.y()); ++y)
    for (int x = static_cast<int>(min.x()); x < static_cast<int>(max.x()); ++x) {
      const auto* p = a.pixel(x, y);
      const auto* q = b.pixel(x, y);
      count += p[0] != q[0] || p[1] != q[1] || p[2] != q[2];
    }
  return count;
}

/// Number of pixels in a rectangle that differ from the ground in the corner of the picture.
inline int inked(const Image& image, int x0, int y0, int x1, int y1) {
  int count = 0;
  const auto* ground = image.pixel(0, 0);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      count += std::equal(ground, ground + 3, image.pixel(x, y)) ? 0 : 1;
  return count;
}

}  // namespace winslow::gui::test
