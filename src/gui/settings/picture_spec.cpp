#include "gui/settings/picture_spec.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace winslow::gui {

namespace {

constexpr int smallest_side = 16;
constexpr double most_pixels = 268435456;  // 1 GiB of RGBA

}  // namespace

std::array<int, 2> picture_size(const PictureSpec& spec, double width, double height) {
  // Compared as double, since a large number must not be converted to int.
  const double w = spec.size ? (*spec.size)[0] : std::round(spec.scale * width);
  const double h = spec.size ? (*spec.size)[1] : std::round(spec.scale * height);
  const auto fits = [](double side) {
    return side >= smallest_side && side <= largest_picture_side;
  };
  if (!fits(w) || !fits(h) || w * h > most_pixels)
    throw UsageError("A picture has " + std::to_string(smallest_side) + " to " +
                     std::to_string(largest_picture_side) +
                     " pixels a side and at most 268 million in all.");
  return {static_cast<int>(w), static_cast<int>(h)};
}

int turntable_frames(const RecordingSpec& spec) {
  constexpr double most = 36000;  // 600 seconds at 60 a second
  return static_cast<int>(std::clamp(std::round(spec.turn_seconds * spec.rate), 2.0, most));
}

}  // namespace winslow::gui
