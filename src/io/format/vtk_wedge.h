#pragma once

#include <span>
#include <utility>

#include "core/types.h"

namespace winslow::io {

/// Turns the corners of a prism, as ElementShape numbers them, into those of VTK's wedge, and back:
/// its triangle 0 1 2 faces outwards.
inline void mirror_prism(std::span<Index> corners) {
  std::swap(corners[1], corners[2]);
  std::swap(corners[4], corners[5]);
}

}  // namespace winslow::io
