#pragma once

#include <string>

#include "core/types.h"

namespace winslow {

/// "(0.25, -1.5)": a point for messages, in six significant digits; far from the origin in more, so
/// that it can be found there.
std::string place_text(const Vec2& p);
std::string place_text(const Vec3& p);
/// The same of a point whose last component is 0 in the plane.
std::string place_text(const Vec3& p, int dimension);

}  // namespace winslow
