#pragma once

#include <array>
#include <optional>
#include <vector>

#include "gui/base/screen.h"

namespace winslow::gui {

/// Part of a line that lies inside a box; none if it misses it.
std::optional<std::array<ScreenPoint, 2>> clip_line(const ScreenPoint& a, const ScreenPoint& b,
                                                    const ScreenBox& box);

/// Part of a convex polygon that lies inside a box; fewer than three points if there is none.
std::vector<ScreenPoint> clip_polygon(std::vector<ScreenPoint> polygon, const ScreenBox& box);

}  // namespace winslow::gui
