#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// Part of a line that lies inside a box; none if it misses it.
std::optional<std::array<Vec2, 2>> clip_line(const Vec2& a, const Vec2& b, const Bounds& box);

/// Part of a convex polygon that lies inside a box; fewer than three points if there is none.
std::vector<Vec2> clip_polygon(std::vector<Vec2> polygon, const Bounds& box);

}  // namespace winslow::gui
