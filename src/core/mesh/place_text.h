#pragma once

#include <string>

#include "core/types.h"

namespace winslow {

/// "(0.25, -1.5)": a point for messages, in six significant digits; far from the origin in more, so
/// that it can be found there.
std::string place_text(const Vec2& p);

}  // namespace winslow
