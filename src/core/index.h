#pragma once

#include <cstdint>

namespace winslow {

/// Index of a node, an element, or an entry of a compressed row.
using Index = std::int32_t;

}  // namespace winslow
